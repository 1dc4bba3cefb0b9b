"""When an until is fulfilled: for each node, the times at which runs from it reach their end.

In all of these `left` and `right` are the truth of `left U right`'s operands at each node. A run is
*fulfilled* at a point where `right` holds, when `left` holds at all points before; the elapsed time
counts from the node. An edge of time d > 0 has the points 0 to d - 1 after its source.
"""

from __future__ import annotations

from array import array
from collections import deque
from heapq import heapify, heappop, heappush

from rebsync.checker.look import Stopped
from rebsync.checker.temporal.components import components
from rebsync.checker.temporal.timeline import Timeline

FOREVER = 2**62  # later than everything
NEVER = -1  # earlier than everything
_MOST_BITS = 2**34  # 2 GiB of sets of times


def earliest(line: Timeline, left: bytearray, right: bytearray) -> array[int]:
    """The least time at which some run is fulfilled; FOREVER if none is."""
    values = array("q", [FOREVER]) * len(line)
    _spread(line, values, {0: [n for n, holds in enumerate(right) if holds]}, left)
    return values


def latest(line: Timeline, left: bytearray, right: bytearray) -> array[int]:
    """The most that a run takes until it is fulfilled first; FOREVER if some run never is."""
    first, edges = line.before()
    source, time = line.source, line.time
    values = array("q", bytes(8 * len(line)))
    open_edges = array("q", (len(line.edges(node)) for node in range(len(line))))
    reached = [n for n, holds in enumerate(right) if holds]
    for number, node in enumerate(reached):  # grows
        if not number & 4095:
            line.look()
        for edge in edges[first[node] : first[node + 1]]:
            before = source[edge]
            if left[before] and not right[before]:
                values[before] = max(values[before], values[node] + time[edge])
                open_edges[before] -= 1
                if not open_edges[before]:
                    reached.append(before)
    known = bytearray(len(line))
    for node in reached:
        known[node] = 1
    return array("q", (v if k else FOREVER for v, k in zip(values, known, strict=True)))


def longest(line: Timeline, left: bytearray, right: bytearray) -> array[int]:
    """The supremum of the times at which some run is fulfilled; NEVER if none is."""
    component = _components(line, left, zero=False)
    values = array("q", (0 if holds else NEVER for holds in right))
    inner = sorted((n for n, holds in enumerate(left) if holds), key=lambda n: -component[n])
    start = 0
    while start < len(inner):
        if not start & 255:
            line.look()
        end, own = start, component[inner[start]]
        best, advances = NEVER, False
        while end < len(inner) and component[inner[end]] == own:
            node = inner[end]
            for edge in line.edges(node):
                target, time = line.target[edge], line.time[edge]
                if right[node]:
                    best = max(best, time - 1, 0)
                if left[target] and component[target] == own:
                    advances = advances or time > 0
                elif values[target] >= 0:
                    best = max(best, time + values[target])
            end += 1
        best = FOREVER if advances and best >= 0 else min(best, FOREVER)
        for node in inner[start:end]:
            values[node] = best
        start = end
    return values


def surest(line: Timeline, left: bytearray, right: bytearray) -> array[int]:
    """The least, of all runs, of the supremum of the times at which the run is fulfilled.

    NEVER if some run is not fulfilled at all.
    """
    failing = bytearray(v == FOREVER for v in latest(line, left, right))
    inner = bytearray(a and not b for a, b in zip(left, failing, strict=True))
    component = _components(line, inner, zero=True)
    last: dict[int, list[int]] = {0: []}  # from then on the run is not fulfilled any more
    for node, failed in enumerate(failing):
        if failed:
            continue
        if not left[node]:
            last[0].append(node)
            continue
        for edge in line.edges(node):
            target, time = line.target[edge], line.time[edge]
            if failing[target]:
                last.setdefault(max(time - 1, 0), []).append(node)
            elif time == 0 and left[target] and component[target] == component[node]:
                last[0].append(node)
    values = array("q", [FOREVER]) * len(line)
    _spread(line, values, last, inner)
    for node, failed in enumerate(failing):
        if failed:
            values[node] = NEVER
    return values


def exact(line: Timeline, left: bytearray, right: bytearray, limit: int, on_all: bool) -> list[int]:
    """All times up to a limit at which some run, or every run, is fulfilled, as bits.

    Raises Stopped when there are too many to keep.
    """
    mask = (1 << limit + 1) - 1
    first, edges = line.before()
    values = [0] * len(line)
    waiting = deque(n for n, holds in enumerate(right) if holds)
    queued = bytearray(right)
    size = 0
    while waiting:
        line.look()
        node = waiting.popleft()
        queued[node] = 0
        value = int(right[node])
        if left[node]:
            met = mask if on_all else 0
            for edge in line.edges(node):
                time = min(line.time[edge], limit + 1)
                way = values[line.target[edge]] << time & mask
                if right[node]:
                    way |= (1 << time) - 1
                met = met & way if on_all else met | way
            value |= met
        if value == values[node]:
            continue
        size += value.bit_length() - values[node].bit_length()
        if size > _MOST_BITS:
            raise Stopped(f"too many times up to {limit} had to be told apart")
        values[node] = value
        for edge in edges[first[node] : first[node + 1]]:
            before = line.source[edge]
            if left[before] and not queued[before]:
                queued[before] = 1
                waiting.append(before)
    return values


def _spread(
    line: Timeline, values: array[int], starts: dict[int, list[int]], inner: bytearray
) -> None:
    """Lowers values to the least time from a start, backwards over the inner nodes.

    `starts` are nodes by their time; so are all that wait (Dijkstra's search with few times).
    """
    first, edges = line.before()
    source, duration = line.source, line.time
    times = list(starts)
    heapify(times)
    while times:
        now = heappop(times)
        for number, node in enumerate(starts[now]):  # grows
            if not number & 4095:
                line.look()
            if values[node] <= now:
                continue
            values[node] = now
            for edge in edges[first[node] : first[node + 1]]:
                before, then = source[edge], now + duration[edge]
                if inner[before] and then < values[before]:
                    if then not in starts:
                        starts[then] = []
                        heappush(times, then)
                    starts[then].append(before)
        del starts[now]


def _components(line: Timeline, inner: bytearray, zero: bool) -> array[int]:
    """Components of the inner nodes, over all edges or only those without time."""
    first, target = array("q", [0]), array("q")
    for node, is_inner in enumerate(inner):
        if is_inner:
            for edge in line.edges(node):
                if inner[line.target[edge]] and not (zero and line.time[edge]):
                    target.append(line.target[edge])
        first.append(len(target))
    return components(first, target, line.look)
