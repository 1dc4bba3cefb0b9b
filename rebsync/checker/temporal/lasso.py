"""Runs that show why a property is violated."""

from __future__ import annotations

from rebsync.checker.graph import Graph
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Lasso:
    """A run: a prefix, then a cycle for ever.

    `prefix[0]` is a position in `graph.initial`; all other numbers, of `cycle` too, are ordinals:
    the edge that is taken, counted from the first one of its state. An empty cycle stays in the
    last state for ever. A cycle of None means that the prefix alone decides, whatever follows it;
    what is shown may then lie within the last step, while its time passes.
    """

    prefix: tuple[int, ...]
    cycle: tuple[int, ...] | None


def lasso(graph: Graph, start: int, prefix: list[int], cycle: list[int] | None) -> Lasso:
    """The shortest way to write a run given by the numbers of its edges, not ordinals.

    `start` is the position of its first state in `graph.initial`.
    """
    if cycle:
        prefix, cycle = _shortened(prefix, cycle)
    state = graph.initial[start]
    ordinals = [start]
    for edge in [*prefix, *(cycle or ())]:
        ordinals.append(edge - graph.first[state])
        state = graph.target[edge]
    split = len(prefix) + 1
    return Lasso(tuple(ordinals[:split]), None if cycle is None else tuple(ordinals[split:]))


def _shortened(prefix: list[int], cycle: list[int]) -> tuple[list[int], list[int]]:
    """The same run with its cycle gone through once, and entered as early as can be."""
    size = len(cycle)
    period = next(p for p in range(1, size + 1) if size % p == 0 and cycle[p:] == cycle[:-p])
    cycle = cycle[:period]
    shared = 0
    while shared < len(prefix) and prefix[-1 - shared] == cycle[-1 - shared % period]:
        shared += 1
    kept, turn = len(prefix) - shared, shared % period
    return prefix[:kept], cycle[period - turn :] + cycle[: period - turn]
