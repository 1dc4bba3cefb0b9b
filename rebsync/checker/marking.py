"""Which definitions of a property are true in the states of a run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rebsync.checker.formulas import Atom
from rebsync.checker.lowering import lower
from rebsync.checker.lowering.defines import values_named
from rebsync.checker.machine import Failed
from rebsync.checker.problem import Problem
from rebsync.checker.search import Interpreted
from rebsync.checker.state import State
from rebsync.checker.steps import Semantics
from rebsync.model import Name
from rebsync.properties import Define, Formula, Properties, Property, state_expressions
from rebsync.property_check import check_properties


def true_defines(
    problem: Problem, entry: Property, states: Sequence[State], semantics: Semantics
) -> tuple[tuple[str, ...], ...]:
    """For each state the names of those that the formula uses and that are true there.

    Numbers are left out, and what has no value is not true. Empty if there is nothing to mark.
    """
    names = {each.name: each for each in problem.properties.defines}
    truths = [each for each in _used(entry.formula, names) if is_truth(problem, each)]
    if not truths:
        return ()
    asked = tuple(Property(each.name, Name(each.name)) for each in truths)
    properties = Properties(problem.properties.defines, asked)
    program, formulas = lower(problem.analysis, properties)
    search = Interpreted(program, semantics)
    numbers = {f.name: f.formula.predicate for f in formulas if isinstance(f.formula, Atom)}
    return tuple(
        tuple(name for name, number in numbers.items() if _holds(search, state, number))
        for state in states
    )


def _used(formula: Formula, names: dict[str, Define]) -> Iterator[Define]:
    """The definitions in a formula, and those that they use, each once."""
    waiting: list[Formula] = [*state_expressions(formula)]
    seen: set[str] = set()
    for root in waiting:
        for name in values_named(root):
            if name in names and name not in seen:
                seen.add(name)
                yield names[name]
                waiting.append(names[name].value)


def is_truth(problem: Problem, define: Define) -> bool:
    """Whether a definition is a truth value: it could be a property by itself."""
    alone = Properties(problem.properties.defines, (Property(define.name, Name(define.name)),))
    found = check_properties(alone, problem.analysis)
    return not any(d.severity.value == "error" for d in found)


def _holds(search: Interpreted, state: State, predicate: int) -> bool:
    try:
        return search.holds(state, predicate)
    except Failed:
        return False
