"""What is drawn of a computation graph: boxes and wires, the same for every format."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from enum import Enum

from rebsync.records import dataclass
from rebsync.reverse.graph import Place
from rebsync.reverse.policies import Policies
from rebsync.rosgraph.ends import SENDING, Channel, Role
from rebsync.rosgraph.graph import UNKNOWN, ComputationGraph, NodeEnd, RosNode


class Kind(Enum):
    """What a box stands for: CODE is run by nothing that was read, UNREAD has no code here."""

    NODE = "node"
    CODE = "code"
    UNREAD = "unread"
    TOPIC = "topic"
    SERVICE = "service"
    ACTION = "action"
    UNKNOWN = "unknown"


class Mark(Enum):
    """Of two graphs, which of them have something."""

    SAME = ""
    ADDED = "added"
    REMOVED = "removed"


_KINDS = {
    Channel.TOPIC: Kind.TOPIC,
    Channel.SERVICE: Kind.SERVICE,
    Channel.ACTION: Kind.ACTION,
}
# Of a node that hands itself to libraries which were not read.
MORE = "libraries that it uses may have more names"
NODES = frozenset({Kind.NODE, Kind.CODE, Kind.UNREAD})


@dataclass(frozen=True, slots=True)
class Box:
    """A node, or a name of the graph; `key` is its own, the same in another graph.

    `note` says of an unknown name why, of a node when it is started.
    """

    key: str
    kind: Kind
    name: str
    package: str = ""
    namespace: str = ""
    label: str = ""
    types: tuple[str, ...] = ()
    place: Place | None = None
    note: str = ""
    mark: Mark = Mark.SAME


@dataclass(frozen=True, slots=True)
class Wire:
    """An end of a node, from where messages, requests or goals come to where they go."""

    source: str
    target: str
    role: Role
    types: tuple[str, ...]
    certain: bool
    place: Place
    policies: Policies | None = None
    mark: Mark = Mark.SAME

    @property
    def key(self) -> tuple[object, ...]:
        """By what a wire is known again: all but its place."""
        return self.source, self.target, self.role, self.types, self.policies


@dataclass(frozen=True, slots=True)
class Picture:
    """All boxes and wires."""

    title: str
    boxes: tuple[Box, ...]
    wires: tuple[Wire, ...]


def picture_of(graph: ComputationGraph) -> Picture:
    """The boxes of all nodes and names, and the wires between them."""
    nodes = list(_nodes(graph))
    names: dict[str, Box] = {}
    wires: list[Wire] = []
    for box, node in nodes:
        for end in node.ends:
            other = _box_of(box, end)
            before = names.setdefault(other.key, other)
            types = tuple(dict.fromkeys((*before.types, *other.types)))
            names[other.key] = replace(before, types=types)
            wires.append(_wire(box, other, end))
    boxes = (*(box for box, _ in nodes), *(names[key] for key in sorted(names)))
    return Picture(graph.title, boxes, tuple(dict.fromkeys(wires)))


def _nodes(graph: ComputationGraph) -> Iterator[tuple[Box, RosNode]]:
    seen: dict[str, int] = {}
    for node in graph.nodes:
        plain = f"node {node.package} {node.label} {node.name}"
        seen[plain] = seen.get(plain, 0) + 1
        key = plain if seen[plain] == 1 else f"{plain} #{seen[plain]}"
        yield _node(key, node), node


def _node(key: str, node: RosNode) -> Box:
    kind = Kind.NODE if node.code is not None and node.code.is_node else Kind.CODE
    return Box(
        key=key,
        kind=Kind.UNREAD if node.code is None else kind,
        name=node.name if node.name != UNKNOWN else f"{UNKNOWN} {node.label}",
        package=node.package,
        namespace=node.namespace or "/",
        label=node.label,
        place=node.place,
        note="; ".join(_notes(node)),
    )


def _notes(node: RosNode) -> Iterator[str]:
    if node.when:
        yield f"if {' and '.join(node.when)}"
    if node.code is not None and node.code.is_node and not node.code.closed:
        yield MORE


def _box_of(node: Box, end: NodeEnd) -> Box:
    kind = _KINDS[end.channel]
    if end.name is not None:
        namespace = end.name.rpartition("/")[0] or "/"
        return Box(f"{kind.value} {end.name}", kind, end.name, "", namespace, types=end.types)
    name = UNKNOWN if end.pattern == "*" else f"{UNKNOWN} {end.pattern}"
    key = f"unknown {node.key} {end.end.role.value} {end.pattern} {' '.join(end.types)}"
    return Box(
        key, Kind.UNKNOWN, name, node.package, types=end.types, place=end.end.place, note=end.why
    )


def _wire(node: Box, name: Box, end: NodeEnd) -> Wire:
    sends = end.end.role in SENDING
    source, target = (node.key, name.key) if sends else (name.key, node.key)
    given = end.end
    return Wire(source, target, given.role, end.types, end.certain, given.place, given.policies)


def merged(before: Picture, after: Picture) -> Picture:
    """Both pictures in one, with marks on what only one of them has."""
    boxes = {b.key: b for b in after.boxes}
    old = {b.key: b for b in before.boxes}
    found = [b if b.key in old else replace(b, mark=Mark.ADDED) for b in after.boxes]
    found += [replace(b, mark=Mark.REMOVED) for b in before.boxes if b.key not in boxes]
    wires, earlier = {w.key for w in after.wires}, {w.key for w in before.wires}
    drawn = [w if w.key in earlier else replace(w, mark=Mark.ADDED) for w in after.wires]
    drawn += [replace(w, mark=Mark.REMOVED) for w in before.wires if w.key not in wires]
    return Picture(after.title, tuple(found), tuple(drawn))


def changes(picture: Picture) -> tuple[list[Box], list[Wire]]:
    """What is marked in a picture."""
    return (
        [box for box in picture.boxes if box.mark is not Mark.SAME],
        [wire for wire in picture.wires if wire.mark is not Mark.SAME],
    )
