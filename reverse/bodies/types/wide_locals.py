"""The variables of a body that hold more than the model's `int`, and whether they ever do."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from rebsync import model as m
from rebsync.intervals import ANY, Interval, unsigned
from rebsync.reverse.analysis.intervals.interval_analysis import IntervalAnalysis
from rebsync.reverse.bodies.scope import Meaning, Record, Scope, Variable


def variables_in(meaning: Meaning) -> Iterator[Variable]:
    """The variables that a name stands for: those of a message are several."""
    match meaning:
        case Variable():
            yield meaning
        case Record(fields):
            yield from fields.values()
        case _:
            pass


def widths_of(variables: Iterable[Variable], others: Collection[str]) -> dict[str, int]:
    """The bits of wide variables by their names, without `others`."""
    return {v.name: v.wide for v in variables if v.wide and v.name not in others}


def ranges_of(variables: Iterable[Variable]) -> dict[str, Interval]:
    """What small unsigned variables hold."""
    return {v.name: unsigned(v.bits) for v in variables if v.bits}


def broken_locals(
    statements: Sequence[m.Statement], wide: Mapping[str, int], scope: Scope
) -> set[str]:
    """The locals of a body that may get numbers which no `int` holds; `wide` are their bits.

    All, where a literal is none that an `int` holds: the model has only its lower bits.
    """
    if not wide or scope.lowered:
        return set(wide)
    variables = [v for x in scope.members.values() for v in variables_in(x)]
    analysis = IntervalAnalysis(
        {
            **widths_of(variables, scope.overflowing),
            **{n: b for n, b in wide.items() if n not in scope.overflowing},
        },
        {v.name: v.type for v in variables if v.type is not None},
        always={**ranges_of(variables), **dict.fromkeys(scope.overflowing, ANY)},
        called={v.name for v in variables},
    )
    analysis.body(statements)
    return analysis.broken & wide.keys()
