"""A layered drawing of a directed graph (Sugiyama, Tagawa, Toda 1981), parts beside each other.

Edges that close a cycle are turned round, layers are those of longest paths, the order within a
layer is by barycentres, and boxes are moved towards the middle of their neighbours.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from rebsync.records import dataclass

_GAP = 14.0  # between boxes of a layer
_BETWEEN = 70.0  # between layers
_APART = 40.0  # between parts of the graph
_SWEEPS = 8
_WIDTH = 2400.0  # at which another row of small parts begins
Edge = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Spot:
    """Where a box is: its left upper corner."""

    x: float
    y: float


@dataclass(frozen=True, slots=True)
class Layout:
    """The places of all boxes, by their numbers, and the size of the whole."""

    spots: tuple[Spot, ...]
    width: float
    height: float


def layout(sizes: Sequence[tuple[float, float]], edges: Iterable[Edge]) -> Layout:
    """Places boxes of some sizes so that edges go from left to right."""
    listed = [e for e in dict.fromkeys(edges) if e[0] != e[1]]
    spots: list[Spot] = [Spot(0, 0)] * len(sizes)
    x = y = row = width = 0.0
    for part in _parts(len(sizes), listed):
        inside = set(part)
        placed = _placed(part, sizes, [e for e in listed if e[0] in inside])
        right = max(placed[n].x + sizes[n][0] for n in part)
        down = max(placed[n].y + sizes[n][1] for n in part)
        if x and x + right > _WIDTH:
            x, y, row = 0.0, y + row + _APART, 0.0
        for n in part:
            spots[n] = Spot(x + placed[n].x, y + placed[n].y)
        x, row = x + right + _APART, max(row, down)
        width = max(width, x - _APART)
    return Layout(tuple(spots), width, y + row)


def _parts(count: int, edges: Iterable[Edge]) -> list[list[int]]:
    """The connected parts, the largest first."""
    near: list[list[int]] = [[] for _ in range(count)]
    for a, b in edges:
        near[a].append(b)
        near[b].append(a)
    seen: set[int] = set()
    parts = []
    for first in range(count):
        waiting, part = [first], []
        while waiting:
            n = waiting.pop()
            if n not in seen:
                seen.add(n)
                part.append(n)
                waiting += near[n]
        if part:
            parts.append(sorted(part))
    return sorted(parts, key=lambda part: (-len(part), part[0]))


def _placed(
    part: Sequence[int], sizes: Sequence[tuple[float, float]], edges: Sequence[Edge]
) -> dict[int, Spot]:
    layers = _ordered(_layers(part, _acyclic(part, edges)), edges)
    x, left = 0.0, []
    for layer in layers:
        left.append(x)
        x += max(sizes[n][0] for n in layer) + _BETWEEN
    heights = _heights(layers, sizes, edges)
    return {n: Spot(left[i], heights[n]) for i, layer in enumerate(layers) for n in layer}


# --- layers -------------------------------------------------------------------------------------


def _acyclic(part: Sequence[int], edges: Sequence[Edge]) -> list[Edge]:
    """The edges, those turned round that lead back to where a search in depth came from."""
    after: dict[int, list[int]] = {n: [] for n in part}
    entered = dict.fromkeys(part, 0)
    for a, b in edges:
        after[a].append(b)
        entered[b] += 1
    done: set[int] = set()
    open_: set[int] = set()
    found: list[Edge] = []
    for first in sorted(part, key=lambda n: (entered[n], n)):
        waiting = [(first, iter(after[first]))] if first not in done else []
        done.add(first)
        open_.add(first)
        while waiting:
            n, rest = waiting[-1]
            to = next(rest, None)
            if to is None:
                waiting.pop()
                open_.discard(n)
                continue
            found.append((to, n) if to in open_ else (n, to))
            if to not in done:
                done.add(to)
                open_.add(to)
                waiting.append((to, iter(after[to])))
    return found


def _layers(part: Sequence[int], edges: Sequence[Edge]) -> list[list[int]]:
    """Each box one layer behind the last of those that it comes after."""
    before: dict[int, list[int]] = {n: [] for n in part}
    after: dict[int, list[int]] = {n: [] for n in part}
    for a, b in dict.fromkeys(edges):
        before[b].append(a)
        after[a].append(b)
    left = {n: len(before[n]) for n in part}
    ready = [n for n in part if not left[n]]
    depth: dict[int, int] = {}
    while ready:
        n = ready.pop()
        depth[n] = max((depth[b] + 1 for b in before[n]), default=0)
        for to in after[n]:
            left[to] -= 1
            if not left[to]:
                ready.append(to)
    for n in part:  # what has nothing before it goes next to what comes after it
        if not before[n] and after[n]:
            depth[n] = min(depth[to] for to in after[n]) - 1
    layers: list[list[int]] = [[] for _ in range(max(depth.values()) + 1)]
    for n in part:
        layers[depth[n]].append(n)
    return [layer for layer in layers if layer]


def _ordered(layers: list[list[int]], edges: Sequence[Edge]) -> list[list[int]]:
    """The layers with their boxes in the order of the barycentres of their neighbours."""
    near = _neighbours(layers, edges)
    place = {n: float(i) for layer in layers for i, n in enumerate(layer)}
    for sweep in range(_SWEEPS):
        for layer in layers if sweep % 2 == 0 else reversed(layers):
            wanted = {n: _mean([place[o] for o in near[n]], place[n]) for n in layer}
            layer.sort(key=lambda n: (wanted[n], n))
            scale = max(len(layer), 1)
            place |= {n: (i + 0.5) * 1000 / scale for i, n in enumerate(layer)}
    return layers


def _neighbours(layers: Sequence[Sequence[int]], edges: Sequence[Edge]) -> dict[int, list[int]]:
    near: dict[int, list[int]] = {n: [] for layer in layers for n in layer}
    for a, b in edges:
        near[a].append(b)
        near[b].append(a)
    return near


def _mean(values: Sequence[float], otherwise: float) -> float:
    return sum(values) / len(values) if values else otherwise


# --- coordinates --------------------------------------------------------------------------------


def _heights(
    layers: Sequence[Sequence[int]], sizes: Sequence[tuple[float, float]], edges: Sequence[Edge]
) -> dict[int, float]:
    near = _neighbours(layers, edges)
    y: dict[int, float] = {}
    for layer in layers:
        at = 0.0
        for n in layer:
            y[n] = at
            at += sizes[n][1] + _GAP
    for sweep in range(_SWEEPS):
        for layer in layers if sweep % 2 == 0 else reversed(layers):
            middle = {o: y[o] + sizes[o][1] / 2 for n in layer for o in near[n]}
            wanted = {
                n: _mean([middle[o] for o in near[n]], y[n] + sizes[n][1] / 2) - sizes[n][1] / 2
                for n in layer
            }
            y |= _without_overlap(layer, wanted, sizes)
    top = min(y.values())
    return {n: at - top for n, at in y.items()}


def _without_overlap(
    layer: Sequence[int], wanted: Mapping[int, float], sizes: Sequence[tuple[float, float]]
) -> dict[int, float]:
    """The wished places moved apart: the middle of pushing all down and pushing all up."""
    down: dict[int, float] = {}
    at = float("-inf")
    for n in layer:
        at = max(at, wanted[n])
        down[n] = at
        at += sizes[n][1] + _GAP
    up: dict[int, float] = {}
    at = float("inf")
    for n in reversed(layer):
        at = min(at - sizes[n][1] - _GAP, wanted[n]) if at != float("inf") else wanted[n]
        up[n] = at
    return {n: (down[n] + up[n]) / 2 for n in layer}
