"""What the markers within bodies of generated Python promise, and when they do not hold."""

from __future__ import annotations

import pytest

from rebsync.grammars.parser import parse_model
from rebsync.printing import print_model
from rebsync.source import Source
from tests.reverse.python.laws import assert_says, extracted, python_files

_MODEL = """reactiveclass Robot(3) {
  statevars { int n; int cell; }
  Robot() { }
  msgsrv go(int id) {
    while (n < 9) {
      switch (id) { case 1: n = 1; break; case 2: case 3: n = 2; break; default: n = 3; }
      n++;
    }
    for (int i = 9; i > n; i--) { cell = i; }
  }
}
main { Robot r():(); }
"""
_CHAIN = """            # rebsync: switch
            if id == 1:
                self._n = 1
            elif id in (2, 3):
                self._n = 2
            else:
                self._n = 3
"""
_LOOP = """        i: int = 9
        while i > self._n:
            self._cell = i
            # rebsync: step
            i = int32.subtract(i, 1)
"""
_SWITCH = """      switch (id) {
        case 1:
          n = 1;
          break;
        case 2:
        case 3:
          n = 2;
          break;
        default:
          n = 3;
      }
"""


def edited(old: str, new: str, target: str) -> str:
    """The model that is read after an edit of the generated code."""
    files = python_files(parse_model(Source("robot.rebeca", _MODEL)).model, target)
    (path,) = (p for p in files if p.endswith("/robot.py"))
    assert _CHAIN in files[path]
    assert _LOOP in files[path]
    assert old in files[path]
    files[path] = files[path].replace(old, new)
    found = extracted(files)
    assert [f.text for f in found.findings] == []
    return print_model(found.model)


@pytest.mark.parametrize("target", ["ros1-py", "ros2-py"])
def test_a_chain_with_the_marker_is_a_switch(target: str) -> None:
    assert _SWITCH in edited("self._n = 1", "self._n = 1", target)
    assert _SWITCH.replace("n = 2", "n = 7") in edited("self._n = 2", "self._n = 7", target)
    assert "case -1:" in edited("if id == 1", "if id == -1", target)


@pytest.mark.parametrize(
    ("old", "new", "read"),
    [
        ("if id == 1:", "if id == 1 or self._n > 4:", "if (id == 1 || n > 4)"),
        ("if id == 1:", "if id == 2:", "if (id == 2)"),
        ("if id == 1:", "if self._cell == 1:", "if (cell == 1)"),
        ("if id == 1:", "if id != 1:", "if (id != 1)"),
        ("self._n = 2\n", "self._n = 2\n                break\n", "break;"),
        ("            # rebsync: switch\n", "", "if (id == 1)"),
    ],
    ids=["another condition", "twice", "two subjects", "unequal", "break", "no marker"],
)
def test_what_is_no_switch_any_more_is_read_as_it_is(old: str, new: str, read: str) -> None:
    """A `break` leaves the loop around a chain, and would leave only the switch."""
    found = edited(old, new, "ros1-py")
    assert "switch" not in found
    assert read in found


def test_what_a_loop_does_behind_the_marker_is_its_step() -> None:
    assert "for (int i = 9; i > n; i--) {\n" in edited(
        "self._cell = i", "self._cell = i", "ros2-py"
    )
    more = "            i = int32.subtract(i, 1)\n"
    both = edited(more, f"{more}            self._cell = 4\n", "ros2-py")
    assert "for (int i = 9; i > n; i--, cell = 4) {\n" in both


def test_a_continue_skips_the_step() -> None:
    """It would do it in a `for`."""
    skipping = (
        "            if self._n == 4:\n                continue\n            self._cell = i\n"
    )
    found = edited("            self._cell = i\n", skipping, "ros2-py")
    assert "for" not in found
    assert "while (i > n) {\n      if (n == 4) {\n        continue;" in found


def test_what_is_no_store_is_no_step() -> None:
    step = "            i = int32.subtract(i, 1)\n"
    found = edited(step, "            if self._n == 4:\n                i = 3\n", "ros1-py")
    assert "for" not in found
    assert "while (i > n) {\n      cell = i;\n      if (n == 4) {" in found


@pytest.mark.parametrize(
    ("body", "helper"),
    [
        ("switch (id) { case 1: n = 1; case 2: n = 2; break; default: n = 3; }", "in switch(id):"),
        ("switch (id) { case 1: n = 1; break; case 2: default: n = 3; }", "in switch(id):"),
        (
            "switch (id) { case 1: if (n > 3) break; n = 1; break; default: n = 3; }",
            "in switch(id):",
        ),
        ("switch (id) { case 1: return; break; default: n = 3; }", "in switch(id):"),
        ("switch (id) { default: n = 3; }", "in switch(id):"),
        ("switch (id + 1) { case 1: n = 1; break; default: n = 3; }", "in switch("),
        ("for (int i = 9; i > n; i--) { if (n == 4) continue; cell = i; }", "in rounds():"),
        ("for (int i = 9; ; i--) { if (i < 4) break; cell = i; }", "in rounds():"),
    ],
    ids=[
        "falls through",
        "default beside a case",
        "break within",
        "break that nothing reaches",
        "default alone",
        "expression",
        "continue",
        "no condition",
    ],
)
def test_what_a_chain_or_while_would_not_say_keeps_its_helper(body: str, helper: str) -> None:
    start, end = _MODEL.index("    while"), _MODEL.index("  }\n}\nmain")
    model = parse_model(Source("robot.rebeca", f"{_MODEL[:start]}{body}\n{_MODEL[end:]}")).model
    files = python_files(model, "ros1-py")
    (path,) = (p for p in files if p.endswith("/robot.py"))
    assert helper in files[path]
    assert_says(files, model)
