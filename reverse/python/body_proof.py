"""Whether whole numbers of Python stay where the model's `int` has the same numbers.

Python's have no bounds. What each state variable can hold is found from all bodies together;
with it each expression that must be within bounds is looked at.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rebsync import model as m
from rebsync.intervals import INT32, Interval, exactly
from rebsync.records import dataclass
from rebsync.reverse.analysis.interval_analysis import IntervalAnalysis
from rebsync.reverse.analysis.invariants import limits_in
from rebsync.reverse.analysis.needs import Mark, Need
from rebsync.reverse.analysis.writes import written

_BITS = 63
_PLAIN_ROUNDS = 3
_MOST_ROUNDS = 40


@dataclass(frozen=True, slots=True)
class Proved:
    """What following all bodies shows: needs that may not hold, and variables beyond an `int`."""

    failed: frozenset[Mark]
    broken: frozenset[str]
    counted: frozenset[str]


@dataclass(frozen=True, slots=True)
class ClassBodies:
    """All bodies of a class: the constructor's, and those of servers with their parameters.

    `sure` are the state variables that the constructor gives a value before anything is served.
    """

    constructor: Sequence[m.Statement]
    servers: Sequence[tuple[Sequence[m.Statement], Mapping[str, Interval]]]
    state: frozenset[str]
    wide: frozenset[str]
    types: Mapping[str, m.Type]
    needs: Mapping[int, list[Need]]


def proved(bodies: ClassBodies) -> Proved:
    """Looks at all bodies until it is known what their state variables can hold."""
    thresholds = sorted({*limits_in(_nodes(bodies)), INT32.low, INT32.high, 0, -1, 1})
    ranges = _first(bodies)
    repeated = _repeated(bodies)
    for number in range(_MOST_ROUNDS):
        analysis = _followed(bodies, ranges, repeated)
        wider = _wider(bodies, ranges, analysis, repeated)
        if number >= _PLAIN_ROUNDS:
            wider = {n: ranges[n].widen(r, thresholds) for n, r in wider.items()}
        if wider == ranges:
            break
        ranges = wider
    else:
        analysis = _followed(bodies, {}, frozenset())
    failed, broken, counted = analysis.failed, analysis.broken, analysis.counted
    return Proved(frozenset(failed), frozenset(broken), frozenset(counted))


def _wider(
    bodies: ClassBodies,
    ranges: Mapping[str, Interval],
    analysis: IntervalAnalysis,
    repeated: frozenset[str],
) -> dict[str, Interval]:
    """What state variables hold between bodies; of `repeated` each value counts."""
    found = {n: r.join(analysis.left.get(n, r)) for n, r in ranges.items()}
    for name in repeated & found.keys():
        found[name] = found[name].join(analysis.stored.get(name, found[name]))
    return found


def _first(bodies: ClassBodies) -> dict[str, Interval]:
    """What state variables hold before anything is served: 0 where nothing has set them."""
    analysis = _analysis(bodies, {}, frozenset())
    analysis.body(bodies.constructor)
    sure = set(_surely(bodies.constructor))
    found = {}
    for name in bodies.state & bodies.wide:
        stored = analysis.stored.get(name, exactly(0))
        found[name] = stored if name in sure else stored.join(exactly(0))
    return found


def _surely(statements: Sequence[m.Statement]) -> Iterator[str]:
    """The variables that get a value before the node sends, waits or chooses."""
    for statement in statements:
        for node in m.walk(statement):
            match node:
                case m.Choice():
                    return
                case m.Call(target, name) if name == "delay" or target is not None:
                    return
        match statement:
            case m.ExpressionStatement(m.Assign("=", m.Name(name))):
                yield name


def _followed(
    bodies: ClassBodies, ranges: Mapping[str, Interval], repeated: frozenset[str]
) -> IntervalAnalysis:
    """All bodies; of the constructor each value counts, as others may run in the middle of it."""
    analysis = _analysis(bodies, ranges, repeated)
    analysis.body(bodies.constructor)
    for name, values in analysis.stored.items():
        analysis.left[name] = values.join(analysis.left.get(name, values))
    for statements, known in bodies.servers:
        analysis.known = {**ranges, **known}
        analysis.body(statements)
    return analysis


def _analysis(
    bodies: ClassBodies, ranges: Mapping[str, Interval], repeated: frozenset[str]
) -> IntervalAnalysis:
    return IntervalAnalysis(
        dict.fromkeys(bodies.wide, _BITS),
        bodies.types,
        ranges,
        {n: r for n, r in ranges.items() if n in repeated},
        bodies.state,
        needs=bodies.needs,
        wraps=False,
    )


def _repeated(bodies: ClassBodies) -> frozenset[str]:
    """The variables that loops and the cases of switches write: each value counts there."""
    several = (n for n in _nodes(bodies) if isinstance(n, m.While | m.For | m.Switch))
    return frozenset(name for node in several for name in written(node))


def _nodes(bodies: ClassBodies) -> Iterator[m.Node]:
    for statements in (bodies.constructor, *(s for s, _ in bodies.servers)):
        for statement in statements:
            yield from m.walk(statement)
