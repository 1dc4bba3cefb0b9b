"""Least and greatest values: those of all states of the full search, the same in both engines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Extremes, Limits, Unavailable
from rebsync.checker.lowering import lower
from rebsync.checker.problem import Options, Problem
from rebsync.checker.program import Program
from rebsync.checker.search import Interpreted
from rebsync.checker.steps import Semantics
from rebsync.checker.verify import verify
from rebsync.model import Binary, Member, Name
from rebsync.properties import Measure
from tests.checker.comparing import System
from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import DRIVEN, TIMED, UNTIMED, WITHOUT_DELAY, Drawn, systems

LIMITS = Limits(states=300)
FAMILIES: dict[str, tuple[Features, Semantics]] = {
    "exact": (TIMED, "tts"),
    "floating": (WITHOUT_DELAY, "ftts"),
    "core": (UNTIMED, "core"),
}
WALKERS = """
reactiveclass Walker(2) {
  statevars { int place; boolean left; }
  Walker() { self.go(); }
  msgsrv go() {
    left = ?(true, false);
    if (left && place > -3) { place = place - 1; }
    if (!left && place < 4) { place = place + 1; }
    self.go() after(1);
  }
}
main { Walker first():(); Walker second():(); }
"""
WHOLE = ("byte", "short", "int", "boolean")


def _variables(system: System) -> list[tuple[int, int, Measure]]:
    """The rebec, the cell and the expression of each variable with one whole number."""
    return [
        (number, slot.offset, Measure(f"{rebec.name}.{slot.name}", _member(rebec.name, slot.name)))
        for number, rebec in enumerate(system.program.rebecs)
        for slot in rebec.state
        if slot.kind in WHOLE and not slot.type.dimensions
    ]


def _member(rebec: str, variable: str) -> Member:
    return Member(Name(rebec), variable)


def _numbers(system: System) -> list[tuple[int, int, Measure]]:
    kinds = {
        (number, slot.offset): slot.kind
        for number, rebec in enumerate(system.program.rebecs)
        for slot in rebec.state
    }
    return [each for each in _variables(system) if kinds[each[:2]] != "boolean"]


def _quotients(system: System) -> list[Measure]:
    """Quotients that have no value in some states."""
    numbers = [(m.text, m.value) for _, _, m in _numbers(system)]
    return [
        Measure(f"{a} / {b}", Binary("/", dividend, divisor))
        for (a, dividend), (b, divisor) in pairwise(numbers)
        if isinstance(dividend, Member) and isinstance(divisor, Member)
    ]


def _program(system: System, measures: Sequence[Measure]) -> Program:
    return lower(system.analysis, system.properties, measures=tuple(measures))[0]


def _of_values(values: Sequence[int | None]) -> Extremes:
    """What a measure is whose values in the states, in their order, are these."""
    known = [v for v in values if v is not None]
    undefined = values.index(None) if None in values else -1
    if not known:
        return Extremes(0, -1, 0, -1, undefined)
    least, greatest = min(known), max(known)
    return Extremes(least, values.index(least), greatest, values.index(greatest), undefined)


def _quotient(a: int, b: int) -> int | None:
    return None if b == 0 else abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


@pytest.mark.parametrize("family", FAMILIES)
@settings(max_examples=20)
@given(data=st.data())
def test_extremes_are_those_of_all_states(family: str, data: st.DataObject) -> None:
    features, view = FAMILIES[family]
    drawn = data.draw(systems(features))
    system = System.of(drawn.model, drawn.properties)
    variables, numbers = _variables(system), _numbers(system)
    measures = [m for _, _, m in variables] + _quotients(system)
    search = Interpreted(_program(system, measures), view, system.invariants())
    plain = Interpreted(system.program, view, system.invariants())
    found, full = search.run(LIMITS), plain.run(LIMITS)
    assert (found.states, found.transitions, found.events) == (
        full.states,
        full.transitions,
        full.events,
    )
    values: list[list[int | None]] = [
        [state[r].variables[cell] for state in plain.states] for r, cell, _ in variables
    ]
    values += [
        [_quotient(s[r].variables[a], s[q].variables[b]) for s in plain.states]
        for (r, a, _), (q, b, _) in pairwise(numbers)
    ]
    assert found.measured == tuple(map(_of_values, values))


@pytest.mark.parametrize("view", ["tts", "ftts"])
def test_the_compiled_engine_measures_the_same(view: Semantics) -> None:
    system = System.of(WALKERS)
    program = _program(system, [m for _, _, m in _variables(system)] + _quotients(system))
    expected = Interpreted(program, view).run(Limits())
    place, left, _, _, quotient = expected.measured
    assert (place.least, place.greatest, place.undefined) == (-3, 4, -1)
    assert (left.least, left.greatest) == (0, 1)
    assert quotient.undefined >= 0
    for compacted in (False, True):
        try:
            search = CompiledSearch(program, view, hash_compaction=compacted)
        except Unavailable as unavailable:
            pytest.skip(f"no compiled engine: {unavailable}")
        assert search.run(Limits()).measured == expected.measured


@settings(max_examples=6)
@given(drawn=systems(DRIVEN))
def test_runs_end_where_the_value_is(drawn: Drawn) -> None:
    system = System.of(drawn.model, drawn.properties)
    variables = _variables(system)
    problem = Problem(system.source, system.analysis, system.properties)
    problem = replace(problem, measures=tuple(m for _, _, m in variables))
    full = verify(problem, Options("tts", "interpreted", LIMITS))
    reduced = verify(problem, Options("tts", "interpreted", LIMITS, reduce=True))
    assert reduced.measures == full.measures
    for measure in full.measures:
        for extreme in (measure.least, measure.greatest):
            if extreme is None:
                continue
            rebec, name = measure.expression.split(".")
            shown = next(r for r in extreme.trace.steps[-1].rebecs if r.name == rebec)
            value = dict(shown.variables)[name]
            assert {"false": 0, "true": 1}.get(value, value) in (extreme.value, str(extreme.value))
