"""Elements that code takes without a look at the index: whether that is ever out of range.

The model ends with an error there, as `.at()` does for the code that is generated; what `[]` of
C++ does is undefined ([array.undef], [expr.add]).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rebsync import model as m
from rebsync.intervals import Interval
from rebsync.reverse.analysis.intervals.interval_analysis import IntervalAnalysis
from rebsync.reverse.bodies.scope import Scope
from rebsync.reverse.bodies.shared import Shared
from rebsync.reverse.bodies.types.wide_locals import ranges_of, variables_in
from rebsync.reverse.findings import Unread
from rebsync.source import Span

_WHY = "an index out of range may do anything here; the model ends with an error"
_HINT = "write `.at(...)`, or test the index before"


def out_of_range(body: m.Block, shared: Shared, scope: Scope) -> Iterator[Unread]:
    """The elements of a body, read with what `shared` has, that may not be there.

    `scope` has the names of the class and the parameters.
    """
    elements = {n.span for n in m.walk(body) if isinstance(n, m.Index)}
    lengths = {s: n for s, n in shared.subscripts.items() if s in elements}
    if lengths:
        seen = _indices(body, shared, scope)
        for span, length in lengths.items():
            if span not in seen or not Interval(0, length - 1).includes(seen[span]):
                yield Unread(span, _WHY, _HINT)


def _indices(body: m.Block, shared: Shared, scope: Scope) -> Mapping[Span, Interval]:
    members = [v for x in scope.members.values() for v in variables_in(x)]
    variables = [*members, *(v for x in scope.locals.values() for v in variables_in(x))]
    analysis = IntervalAnalysis(
        shared.wide,
        {v.name: v.type for v in variables if v.type is not None},
        always=ranges_of(variables),
        called={v.name for v in members},
    )
    analysis.body(body.statements)
    return analysis.indices


def untested(lengths: Mapping[Span, int]) -> None:
    """Refuses an expression of which nobody knows when it is evaluated, with such an index."""
    for span in lengths:
        raise Unread(span, _WHY, _HINT)
