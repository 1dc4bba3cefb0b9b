"""Who has moved since model and code were in step (verdicts.toml)."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.difference import Comparison, Element, Undetermined
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.verdict.drift import Drift, Verdict, judge
from rebsync.source import Source

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

CASES: dict[str, Any] = tomllib.loads(
    Path(__file__).with_name("verdicts.toml").read_text(encoding="utf-8")
)
BASE = """\
env int e = 2;

reactiveclass Robot(3) {
  knownrebecs {
    Robot other;
  }
  statevars {
    int x;
    boolean on;
  }
  Robot(int x0) {
    x = x0;
    self.look();
  }
  msgsrv look() {
    x = x + 1;
    self.look() after(e);
    other.go() after(1);
  }
  msgsrv go() {
    delay(1);
    on = true;
    self.stop();
  }
  msgsrv stop() {
    on = false;
  }
}

reactiveclass Guard(2) {
  Guard() {
    self.watch();
  }
  msgsrv watch() {
    self.watch() after(9);
  }
}

main {
  Robot robot1(robot2):(1);
  Robot robot2(robot1):(2);
  Guard guard():();
}
"""


def given(path: str, edits: list[list[str]]) -> SourcedModel:
    text = BASE
    for old, new in edits:
        assert old in text, old
        text = text.replace(old, new)
    parsed = parse_model(Source(path, text))
    assert parsed.ok, parsed.diagnostics
    return SourcedModel(parsed.model, parsed.source)


def drift(case: dict[str, Any], *, base: bool = True) -> Drift:
    first = given("base.rebeca", [])
    model, code = given("model.rebeca", case["model"]), given("code.cpp", case["code"])
    if not base:
        return judge(compare(model, code), None, None)
    return judge(compare(model, code), compare(first, model), compare(first, code))


@pytest.mark.parametrize("name", CASES)
def test_the_verdict(name: str) -> None:
    case = CASES[name]
    found = drift(case)
    assert found.verdict.value == case["verdict"], found.differences
    assert [str(e) for e in found.conflicts] == case.get("conflicts", [])
    movers = {mover.value for _, mover in found.differences}
    match found.verdict:
        case Verdict.MODEL_AHEAD:
            assert movers == {"model"}
        case Verdict.CODE_AHEAD:
            assert movers == {"code"}
        case Verdict.BOTH_MOVED:
            assert movers <= {"model", "code"}
        case Verdict.CONFLICT:
            assert "conflict" in movers
        case _:
            assert movers == set()


@pytest.mark.parametrize("name", CASES)
def test_sides_are_alike(name: str) -> None:
    """With model and code exchanged the verdict is the mirrored one."""
    case = CASES[name]
    mirrored = {"model ahead": "code ahead", "code ahead": "model ahead"}
    found = drift({"model": case["code"], "code": case["model"]})
    assert found.verdict.value == mirrored.get(case["verdict"], case["verdict"])


@pytest.mark.parametrize("name", CASES)
def test_without_a_base_nobody_is_blamed(name: str) -> None:
    found = drift(CASES[name], base=False)
    whole = drift(CASES[name])
    assert (found.verdict is Verdict.IN_STEP) == (whole.verdict is Verdict.IN_STEP)
    assert found.verdict in (Verdict.IN_STEP, Verdict.APART)
    assert {mover.value for _, mover in found.differences} <= {"unknown"}


def test_nothing_is_in_step_over_something_unknown() -> None:
    unknown = Comparison((Undetermined(Element("msgsrv", "Robot.go"), "why", None, None),))
    same = Comparison(())
    assert judge(unknown, same, unknown).verdict is Verdict.UNDETERMINED
    assert judge(same, same, unknown).verdict is Verdict.UNDETERMINED
    assert judge(unknown, None, None).verdict is Verdict.UNDETERMINED
