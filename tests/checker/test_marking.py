"""What stands beside a violated property: its formula, its definitions by step, fair runs."""

from __future__ import annotations

import pytest

from rebsync.checker.problem import Options, Problem
from rebsync.checker.result import Result
from rebsync.checker.show.pieces import plain
from rebsync.checker.show.text import result_lines
from rebsync.checker.verify import verify
from rebsync.source import Source
from tests.checker.comparing import System

TURNS = """\
reactiveclass A(3) {
    statevars { boolean on; int n; }
    A() { self.go(); }
    msgsrv go() { on = !on; n = (n + 1) % 3; self.go(); }
}
main { A a():(); A b():(); }
"""
DEFINES = "define { on = a.on; both = on && b.on; num = a.n; part = 6 / a.n > 2; }"


def answer(properties: str) -> Result:
    text = f"property {{ {DEFINES} {properties} }}"
    system = System.of(TURNS, text)
    source = Source("model.property", text)
    problem = Problem(system.source, system.analysis, system.properties, source)
    return verify(problem, Options("core", "interpreted"))


def test_each_step_has_the_definitions_that_are_true() -> None:
    (violation,) = answer("Assertion { few: num < 2 || !both; }").violations
    assert violation.formula == "num < 2 || !both"
    assert violation.true == ((), ("on",), (), ("on",), (), ("on",), ("both", "on"))
    shown = plain(result_lines(answer("Assertion { few: num < 2 ||\n !both; }"), "model.rebeca"))
    assert "  formula: num < 2 || !both\n" in shown
    assert "true: both, on\n" in shown
    assert shown.count("true: ") == 4


def test_what_has_no_value_is_not_true() -> None:
    (violation,) = answer("Assertion { p: a.n == 0 || !part || a.n == 1; }").violations
    assert violation.true == ((), ("part",), ("part",))


def test_without_definitions_nothing_is_marked() -> None:
    (violation,) = answer("Assertion { p: a.n != 1; }").violations
    assert (violation.formula, violation.true) == ("a.n != 1", ())


@pytest.mark.parametrize(
    ("formula", "fair"),
    [("G(F(on))", True), ("F(G(on))", False), ("G(!on)", False), ("G(both -> F(!both))", None)],
)
def test_a_formula_that_unfair_runs_alone_refute_is_named(formula: str, fair: bool | None) -> None:
    found = answer(f"LTL {{ live: {formula}; }}")
    assert found.verdict == ("satisfied" if fair is None else "violated")
    assert any("with --fairness weak it is satisfied" in c for c in found.caveats) is bool(fair)
