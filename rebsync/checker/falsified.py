"""Which assertions of a property file are false in the states of a run."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from rebsync.checker.formulas import Atom
from rebsync.checker.lowering import lower
from rebsync.checker.machine import Failed
from rebsync.checker.problem import Problem
from rebsync.checker.search import Interpreted
from rebsync.checker.simulate import next_step
from rebsync.checker.state import State
from rebsync.checker.steps import Failure, Semantics
from rebsync.checker.trace import Trace

Falsified: TypeAlias = Callable[[Trace], tuple[tuple[str, ...], ...]]
"""For each step of a run what is wrong in the state that it leads to, each in a few words."""


def unasserted(_: Trace) -> tuple[tuple[str, ...], ...]:
    """Of a run of which nothing is asserted."""
    return ()


def falsified_in(problem: Problem, semantics: Semantics) -> Falsified:
    """What tells the assertions of a problem that are false, or have no value, in runs of a view.

    Properties in LTL and TCTL are about more than one run, and are not looked at.
    """
    program, formulas = lower(problem.analysis, problem.properties)
    search = Interpreted(program, semantics)
    count = len(problem.properties.assertions)
    predicates = [
        (each.name, each.formula.predicate)
        for each in formulas[:count]
        if isinstance(each.formula, Atom)
    ]
    assert len(predicates) == count
    if not predicates:
        return unasserted

    def wrong_in(state: State) -> tuple[str, ...]:
        told = ((name, _wrong(search, state, predicate)) for name, predicate in predicates)
        return tuple(f"property {name} {wrong}" for name, wrong in told if wrong)

    def falsified(trace: Trace) -> tuple[tuple[str, ...], ...]:
        state: State = ()
        found: list[tuple[str, ...]] = []
        for each in trace.steps:
            step = next_step(search.view, state, each.action)
            if step is None or isinstance(step.result, Failure):
                break
            state = step.result
            found.append(wrong_in(state))
        return tuple(found)

    return falsified


def _wrong(search: Interpreted, state: State, predicate: int) -> str:
    try:
        return "" if search.holds(state, predicate) else "is false here"
    except Failed:
        return "has no value here"
