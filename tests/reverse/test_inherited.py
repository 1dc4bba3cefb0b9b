"""Edits of C++ between a class and the one above it: what is not as in the model is listed."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from rebsync import model as m
from rebsync.config import Config
from tests.forward.compiling import generated
from tests.reverse.laws import extracted

CPP = ["ros1-cpp", "ros2-cpp"]
MODEL = """\
env double limit = 0.35;
reactiveclass Base(5) {
  statevars { int battery; }
  Base() { }
  void drain(int amount) { battery = battery - amount; battery = battery + 1; }
}
reactiveclass Guard extends Base(5) {
  statevars { int steps; boolean full; }
  Guard() { self.go(); }
  msgsrv go() { drain(7); full = battery > limit; self.go() after(1); }
}
main { Guard guard():(); }
"""


def _edited(target: str, edits: Mapping[str, list[tuple[str, str]]]) -> dict[str, str]:
    """A package with texts of files replaced, the files by their names without an ending."""
    files = generated(MODEL, "g", Config(target=target))
    for name, pairs in edits.items():
        end = name if target == "ros1-cpp" or not name.endswith(".h") else f"{name}pp"
        path = next(p for p in files if p.endswith(f"/{end}"))
        for old, new in pairs:
            assert old in files[path]
            files[path] = files[path].replace(old, new)
    return files


def _whys(files: dict[str, str]) -> list[str]:
    return [f.why for f in extracted(files).findings]


@pytest.mark.parametrize("target", CPP)
def test_a_function_of_the_base_that_is_not_virtual(target: str) -> None:
    edits = {
        "base.h": [("void drain(int32_t amount);", "void drain(int32_t amount);\n  bool low();")],
        "base.cpp": [
            ("battery_ = battery_ + 1;", "battery_ = battery_ + (low() ? 1 : 2);"),
            (
                "void Base::drain",
                "bool Base::low() {\n  return battery_ < 3;\n}\n\nvoid Base::drain",
            ),
        ],
        "guard.h": [("void go();", "void go();\n  bool low();")],
        "guard.cpp": [
            ("void Guard::go", "bool Guard::low() {\n  return battery_ < 9;\n}\n\nvoid Guard::go")
        ],
    }
    assert _whys(_edited(target, edits)) == ['"Base" calls its own "low", which is not virtual']
    edits["base.h"][0] = (
        edits["base.h"][0][0],
        edits["base.h"][0][1].replace("bool", "virtual bool"),
    )
    assert _whys(_edited(target, edits)) == []


@pytest.mark.parametrize("target", CPP)
@pytest.mark.parametrize(("passed", "is_listed"), [("battery_", True), ("7", False)])
def test_a_reference_to_what_the_base_changes(target: str, passed: str, is_listed: bool) -> None:
    edits = {
        "base.h": [("drain(int32_t amount)", "drain(const int32_t& amount)")],
        "base.cpp": [("drain(int32_t amount)", "drain(const int32_t& amount)")],
        "guard.cpp": [("drain(7);", f"drain({passed});")],
    }
    whys = _whys(_edited(target, edits))
    assert ["refers to a member" in why for why in whys] == [True] * is_listed


@pytest.mark.parametrize("target", CPP)
def test_a_constant_that_is_rounded_is_no_state(target: str) -> None:
    edits = {"guard.h": [("double limit_", "float limit_")]}
    found = extracted(_edited(target, edits))
    assert found.findings
    declared = [n.name for n in m.walk(found.model) if isinstance(n, m.Declarator)]
    assert declared.count("limit") == 1, declared  # that of the env
