"""Bounds hold before the search, too; where work is needless it is counted, not timed."""

from __future__ import annotations

import time

import pytest

from rebsync.checker.exploration import Limits
from rebsync.checker.formulas import Atom, Formula, Temporal
from rebsync.checker.look import Stopped
from rebsync.checker.lowering import lower
from rebsync.checker.problem import Options, Problem
from rebsync.checker.temporal.buchi import translate
from rebsync.checker.verify import verify
from rebsync.checker.views import Floating
from rebsync.grammars.parser import parse_model
from rebsync.grammars.properties import parse_properties
from rebsync.property_check import check_properties
from rebsync.source import Source
from rebsync.static import analyse

COUNTER = """
reactiveclass A(3) {
    statevars { int x; }
    A() { self.go(); }
    msgsrv go() { x = (x + 1) % 5; self.go() after(1); }
}
main { A r():(); }
"""
LOOP = COUNTER.replace("A() {", "A() { int i = 0; while (i < 2000000000) { i = i + 1; }")


def problem(model: str, properties: str = "property { }") -> Problem:
    source, text = Source("a.rebeca", model), Source("a.property", properties)
    analysis = analyse(parse_model(source).model)
    read = parse_properties(text).properties
    assert not check_properties(read, analysis)
    return Problem(source, analysis, read, text)


def doubling(count: int, first: str, operator: str = "&&") -> str:
    """Definitions of which each stands twice in the next one."""
    names = [f"d{i} = d{i - 1} {operator} d{i - 1};" for i in range(1, count)]
    return f"define {{ d0 = {first}; {' '.join(names)} }}"


def test_a_definition_is_computed_once() -> None:
    text = f"property {{ {doubling(60, 'r.x < 5')} Assertion {{ p: d59; }} }}"
    found = problem(COUNTER, text)
    program, _ = lower(found.analysis, found.properties)
    assert len(program.code) < 1000
    assert verify(found, Options(engine="interpreted")).verdict == "satisfied"


@pytest.mark.parametrize("engine", ["interpreted", "compiled"])
def test_a_shared_definition_says_what_it_said(engine: str) -> None:
    text = "property { define { n = r.x + 1; low = n < 4; }" + (
        " Assertion { p: low || n == 4 || n == 5; q: low && n > 0; } LTL { l: G(low || F(low)); } }"
    )
    options = Options(engine=engine)  # type: ignore[arg-type]
    found = verify(problem(COUNTER, text), options)
    assert dict(found.properties) == {"p": "satisfied", "q": "violated", "l": "satisfied"}


def test_a_definition_may_be_called_as_a_rebec_is() -> None:
    """In `r.x` the rebec is meant."""
    text = "property { define { r = r.x < 5; } Assertion { p: r || r; q: !r || r.x == 0; } }"
    found = verify(problem(COUNTER, text), Options(engine="interpreted"))
    assert dict(found.properties) == {"p": "satisfied", "q": "violated"}


def test_what_may_have_no_value_is_computed_only_where_it_counts() -> None:
    text = "property { define { q = 10 / r.x; } Assertion { p: r.x == 0 || q > 1 && q < 11; } }"
    assert verify(problem(COUNTER, text), Options(engine="interpreted")).verdict == "satisfied"


def test_definitions_that_blow_up_are_bounded() -> None:
    text = f"property {{ {doubling(60, '10 / (r.x + 1) > 0')} Assertion {{ p: d59; }} }}"
    found = problem(COUNTER, text)
    started = time.perf_counter()
    result = verify(found, Options(limits=Limits(seconds=0.2)))
    assert time.perf_counter() - started < 20
    assert (result.verdict, result.reason) == (
        "undetermined",
        "the bound of 0.2 seconds was reached",
    )
    assert result.properties == (("p", "undetermined"),)


def test_nested_formulas_are_bounded() -> None:
    formula: Formula = Atom(0)
    for number in range(1, 12):
        formula = Temporal("U", (Atom(number), formula))
    looks = 0

    def look() -> None:
        nonlocal looks
        looks += 1
        if looks > 10_000:
            raise Stopped("enough")

    with pytest.raises(Stopped):
        translate(Temporal("G", (formula,)), wanted=False, look=look)


def test_constructors_are_bounded() -> None:
    options = Options(engine="interpreted", limits=Limits(seconds=0.2))
    result = verify(problem(LOOP), options)
    assert result.reason == "the bound of 0.2 seconds was reached"
    assert result.states == 0


def test_only_the_step_that_is_taken_is_made(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 300 rebecs that can act each could; their states would have 300 * 300 rebecs."""
    many = COUNTER.replace("A r():();", " ".join(f"A r{i}():();" for i in range(300)))
    view = Floating(lower(problem(many).analysis)[0])
    made = 0
    real = Floating._later

    def counted(self: Floating, *arguments: object) -> object:
        nonlocal made
        made += 1
        return real(self, *arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(Floating, "_later", counted)
    (start,) = view.initial_states()
    assert isinstance(start.result, tuple)
    steps = view.steps(start.result)
    assert len(steps) == 300
    assert made == 1
    assert steps[7].action.actor == 7
    assert made == 2
