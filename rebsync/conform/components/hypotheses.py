"""What may have happened in a component so far, and what may happen next."""

from __future__ import annotations

from typing import NamedTuple

from rebsync.conform.components.component import Cells, Input


class Posted(NamedTuple):
    """A message that the rebec has posted to itself, due between two times."""

    server: int
    cells: Cells
    low: float
    high: float


class Hypothesis(NamedTuple):
    """What may have happened so far.

    The last body began at `low` at the earliest and at `high` at the latest; `free` says when
    the rebec is done with it. `base` inputs were taken or missed, and so were those in `taken`.
    `matched` outputs of each topic fit; `connected` are the lanes of which an input came.
    """

    low: float
    high: float
    free: tuple[float, float]
    variables: Cells
    pending: tuple[Posted, ...]
    base: int
    taken: frozenset[int]
    matched: tuple[int, ...]
    connected: frozenset[int] = frozenset()
    last: int = -1


class Candidate(NamedTuple):
    """A message that may be served next, in an interval of time: what the rebec has posted to
    itself, or an input, by its number, too; neither for the constructor."""

    server: int
    cells: Cells
    low: float
    high: float
    posted: Posted | None = None
    number: int = -1
    input: Input | None = None


def missed(before: Hypothesis, number: int) -> Hypothesis:
    """The state once an input has not come."""
    base, taken = advanced(before, number)
    return before._replace(base=base, taken=taken)


def advanced(before: Hypothesis, number: int) -> tuple[int, frozenset[int]]:
    """The inputs that were taken with one more."""
    if number > before.base:
        return before.base, before.taken | {number}
    base = number + 1
    while base in before.taken:
        base += 1
    return base, frozenset(n for n in before.taken if n > base)
