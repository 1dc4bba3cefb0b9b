"""Where the states of a small state space go: in levels, in an order with few crossings."""

from __future__ import annotations

from collections import Counter, defaultdict

from rebsync.checker.show import words
from rebsync.checker.show.chart_rows import cut
from rebsync.checker.show.space import SpaceEdge, StateSpace, edge_label, levels
from rebsync.checker.show.space_routes import LOOP, MARGIN, Line, Node, route
from rebsync.checker.trace import ShownRebec
from rebsync.records import dataclass

_SPACE = 30.0  # between the nodes of a level
_LONGEST = 30
_SHOWN = 4  # changes that a node tells
_SWEEPS = 8


@dataclass(frozen=True, slots=True)
class Drawing:
    """A laid out state space."""

    nodes: list[Node]
    lines: list[Line]
    width: float
    height: float


def drawing_of(space: StateSpace) -> Drawing:
    """Lays out a state space."""
    nodes, lines = _parts(space)
    rows: list[list[Node]] = [[] for _ in range(max((node.level for node in nodes), default=0) + 1)]
    for node in nodes:
        rows[node.level].append(node)
    _order(rows, lines)
    _spread(rows, lines)
    width, height = route(rows, lines)
    return Drawing(nodes, lines, width, height)


# --- nodes and lines ---------------------------------------------------------------------------


def _parts(space: StateSpace) -> tuple[list[Node], list[Line]]:
    """A node for each state and each failure of it; a line for each different edge."""
    depth, before = levels(space)
    nodes = []
    for number, rebecs in enumerate(space.states):
        previous = before[number]
        old = space.states[previous] if previous is not None else None
        nodes.append(Node(number, depth[number], (str(number), *_news(rebecs, old))))
    failures: dict[tuple[int, str], Node] = {}
    merged: dict[tuple[int, int | None, str], list[SpaceEdge]] = defaultdict(list)
    for edge in space.edges:
        merged[edge.source, edge.target, f"{edge_label(edge)}{edge.failure or ''}"].append(edge)
    lines = []
    for edges in merged.values():
        edge = edges[0]
        if edge.target is not None:
            target = nodes[edge.target]
        else:
            key = (edge.source, edge.failure or "failure")
            said = (cut(key[1], _LONGEST),)
            target = failures.setdefault(key, Node(None, depth[edge.source] + 1, said))
        times = f" (x{len(edges)})" if len(edges) > 1 else ""
        label = cut(edge_label(edge), _LONGEST) + times
        lines.append(Line(edge, nodes[edge.source], target, label))
    every = [*nodes, *failures.values()]
    leaving = Counter(id(line.source) for line in lines if not line.loops)
    entering = Counter(id(line.target) for line in lines if not line.loops)
    for node in every:
        node.ports = max(leaving[id(node)], entering[id(node)], 1)
    return every, lines


def _news(rebecs: tuple[ShownRebec, ...], old: tuple[ShownRebec, ...] | None) -> list[str]:
    """What is new in a state; of an initial state, all variables."""
    if old is None:
        news = [words.values(rebec) for rebec in rebecs if rebec.variables]
    else:
        news = [
            f"{rebec.name}.{name} = {value}"
            for rebec, last in zip(rebecs, old, strict=True)
            for (name, value), was in zip(rebec.variables, last.variables, strict=True)
            if (name, value) != was
        ]
    more = [f"and {len(news) - _SHOWN + 1} more"] if len(news) > _SHOWN else []
    return [cut(text, _LONGEST) for text in news[: _SHOWN - len(more)]] + more


# --- order and places from left to right -------------------------------------------------------


def _neighbours(lines: list[Line]) -> tuple[dict[int, list[Node]], dict[int, list[Node]]]:
    """For each node, by its `id`, those above it and those below it that lines join to it."""
    above: dict[int, list[Node]] = defaultdict(list)
    below: dict[int, list[Node]] = defaultdict(list)
    for line in lines:
        if line.falls:
            above[id(line.target)].append(line.source)
            below[id(line.source)].append(line.target)
    return above, below


def _order(rows: list[list[Node]], lines: list[Line]) -> None:
    """Orders each level by the middle of the neighbours of its nodes, down and up again."""
    above, below = _neighbours(lines)
    for sweep in range(_SWEEPS):
        near = below if sweep % 2 else above
        place = {id(n): i / len(row) for row in rows for i, n in enumerate(row)}
        for row in reversed(rows) if sweep % 2 else rows:
            middles = {
                id(n): _middle([place[id(m)] for m in near[id(n)]], place[id(n)]) for n in row
            }
            row.sort(key=lambda node: middles[id(node)])
            place.update({id(node): i / len(row) for i, node in enumerate(row)})


def _spread(rows: list[list[Node]], lines: list[Line]) -> None:
    """Gives nodes room, then draws each towards its neighbours as far as there is room."""
    above, below = _neighbours(lines)
    right = {id(node): node.width / 2 for row in rows for node in row}
    for line in lines:
        if line.loops:
            node = line.source
            right[id(node)] = max(right[id(node)], node.width / 2 + LOOP + line.wide)
    for row in rows:
        _place(row, [0.0] * len(row), right)
    for sweep in range(_SWEEPS):
        near = below if sweep % 2 else above
        for row in reversed(rows) if sweep % 2 else rows:
            wished = [_middle([m.x for m in near[id(n)]], n.x) for n in row]
            _place(row, wished, right)
    left = min((node.x - node.width / 2 for row in rows for node in row), default=0.0)
    for row in rows:
        for node in row:
            node.x += MARGIN - left


def _place(row: list[Node], wished: list[float], right: dict[int, float]) -> None:
    """Places nodes side by side as near to their wishes as their order allows."""
    groups: list[tuple[float, int, list[float]]] = []  # where it begins, its size, offsets
    offset = 0.0
    offsets = []
    for node in row:
        offset += node.width / 2
        offsets.append(offset)
        offset += right[id(node)] + _SPACE
    for wish, at in zip(wished, offsets, strict=True):
        groups.append((wish - at, 1, [at]))
        while len(groups) > 1 and groups[-2][0] > groups[-1][0]:
            (start, size, first), (other, count, more) = groups[-2:]
            mean = (start * size + other * count) / (size + count)
            groups[-2:] = [(mean, size + count, first + more)]
    places = [start + at for start, _, members in groups for at in members]
    for node, x in zip(row, places, strict=True):
        node.x = x


def _middle(values: list[float], otherwise: float) -> float:
    return sum(values) / len(values) if values else otherwise
