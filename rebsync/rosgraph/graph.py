"""The computation graph: nodes, and by which topics, services and actions they are joined."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fnmatch import fnmatchcase

from rebsync.records import dataclass
from rebsync.reverse.graph import OneOf, Place, Resolved
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.unknowns import Open, Text
from rebsync.rosgraph.ends import CHANNEL_OF, Channel, End, NodeCode, PackageCode
from rebsync.rosgraph.naming import KnownName, Naming, UnknownName

UNKNOWN = "?"


@dataclass(frozen=True, slots=True)
class NodeEnd:
    """An end of a node: its name in the graph, or None with the reason and what is known of it.

    `certain` says that it is this name whatever parameters are set. `types` are those that it may
    have; empty where they are not known. `pattern` is what the code tells of the name, `reach` the
    absolute names that it may be.
    """

    end: End
    name: str | None
    certain: bool
    types: tuple[str, ...]
    why: str = ""
    pattern: str = "*"
    reach: str = "*"

    @property
    def channel(self) -> Channel:
        """What its name stands for."""
        return CHANNEL_OF[self.end.role]

    def may_be(self, name: str) -> bool:
        """Whether its name, which is not known for certain, may be this one."""
        if self.name is not None:
            return self.name == name or not self.certain
        return fnmatchcase(name, self.reach)


@dataclass(frozen=True, slots=True)
class RosNode:
    """A node of the graph. `name` is absolute; `code` is None for one that was not read.

    `namespace` has no slash at its end. `launched` is the tag that starts it, if a launch file was
    asked for; `when` are the conditions of it that are not decided.
    """

    name: str
    namespace: str
    package: str
    label: str
    code: NodeCode | None
    ends: tuple[NodeEnd, ...]
    naming: Naming
    place: Place | None
    launched: LaunchedNode | None = None
    when: tuple[str, ...] = ()

    @property
    def is_read(self) -> bool:
        """Whether all that it asks of ROS is here, as far as the code tells."""
        return self.code is not None


@dataclass(frozen=True, slots=True)
class ComputationGraph:
    """All nodes of a launch file, or of all that was read where `launch` is None."""

    title: str
    nodes: tuple[RosNode, ...]
    launch: Launch | None = None

    def channels(self) -> dict[tuple[Channel, str], list[tuple[RosNode, NodeEnd]]]:
        """What has a name, with all of its ends."""
        found: dict[tuple[Channel, str], list[tuple[RosNode, NodeEnd]]] = {}
        for node in self.nodes:
            for end in node.ends:
                if end.name is not None:
                    found.setdefault((end.channel, end.name), []).append((node, end))
        return dict(sorted(found.items(), key=lambda item: (item[0][1], item[0][0].value)))

    def unknown(self) -> Iterator[tuple[RosNode, NodeEnd]]:
        """The ends whose names are not known."""
        for node in self.nodes:
            yield from ((node, end) for end in node.ends if end.name is None)


def graph_of_code(packages: Sequence[PackageCode], title: str) -> ComputationGraph:
    """The graph of all nodes that were read, each once, under the names that the code gives."""
    nodes = [_node_of_code(code) for package in packages for code in package.nodes]
    return ComputationGraph(title, tuple(nodes))


def graph_of_launch(
    packages: Sequence[PackageCode], launch: Launch, title: str
) -> ComputationGraph:
    """The graph of the nodes that a launch file starts."""
    by_package: dict[str, list[NodeCode]] = {}
    for package in packages:
        by_package.setdefault(package.name, []).extend(package.nodes)
    nodes = [n for each in launch.nodes for n in started(each, launch, by_package)]
    return ComputationGraph(title, tuple(_alternatives(nodes)), launch)


def _alternatives(nodes: Iterable[RosNode]) -> Iterator[RosNode]:
    """The nodes, those once that are the same on different conditions."""
    found: dict[tuple[object, ...], RosNode] = {}
    for number, node in enumerate(nodes):
        same: tuple[object, ...] = node.name, node.package, node.label, node.ends
        key = same if node.when else (number,)
        before = found.get(key)
        if before is None:
            found[key] = node
        else:
            both = " and ".join(before.when), " and ".join(node.when)
            found[key] = replace(before, when=(" or ".join(dict.fromkeys(both)),))
    yield from found.values()


# --- nodes --------------------------------------------------------------------------------------


def _node_of_code(code: NodeCode) -> RosNode:
    own = own_name(code)
    naming = Naming(own, code.is_flat)
    name = f"/{own}" if own is not None else UNKNOWN
    return RosNode(
        name=name,
        namespace=name.rpartition("/")[0],
        package=code.package,
        label=code.label,
        code=code,
        ends=tuple(_ends(code.ends, naming)),
        naming=naming,
        place=code.place,
    )


def loose_ends(packages: Sequence[PackageCode]) -> tuple[NodeEnd, ...]:
    """The ends of code of which it is not known what runs it, as plugins are."""
    loose = (c for package in packages for c in package.nodes if not c.is_node)
    return tuple(end for code in loose for end in _node_of_code(code).ends)


def own_name(code: NodeCode) -> str | None:
    """The name that the code gives its node."""
    found = list(Naming(None, code.is_flat).values(code.name)) if code.name is not None else []
    names = {n.text.strip("/") for n in found if isinstance(n, KnownName)}
    return names.pop() if len(found) == 1 and len(names) == 1 else None


def started(
    node: LaunchedNode, launch: Launch, packages: dict[str, list[NodeCode]]
) -> Iterator[RosNode]:
    """The nodes that a tag of a launch file starts: those of a program, or one that is not read."""
    found: list[NodeCode | None] = [
        code for code in packages.get(_text(node.package), []) if _runs(node, code)
    ]
    if node.nodelet is not None:
        found = [c for codes in packages.values() for c in codes if _runs(node, c)]
    place = Place(node.source, node.span)
    for code in found or [None]:
        given = node.name if isinstance(node.name, str) else None
        own = given or (own_name(code) if code is not None else None)
        naming = Naming(own, code.is_flat if code is not None else True, node, launch)
        path = naming.before_remapping("~")
        name = path.rstrip("/") if isinstance(path, str) else UNKNOWN
        yield RosNode(
            name=name,
            namespace=name.rpartition("/")[0],
            package=_text(node.package) or UNKNOWN,
            label=code.label if code is not None else _text(node.type) or UNKNOWN,
            code=code,
            ends=tuple(_ends(code.ends, naming)) if code is not None else (),
            naming=naming,
            place=place,
            launched=node,
            when=node.only_if,
        )


def _text(text: Text) -> str:
    return "" if isinstance(text, Open) else text


def _runs(node: LaunchedNode, code: NodeCode) -> bool:
    if node.nodelet is not None:
        name = node.nodelet.class_name or ""
        return name.replace("::", "/").rpartition("/")[2] in code.executables
    return isinstance(node.type, str) and node.type in code.executables


# --- ends ---------------------------------------------------------------------------------------


def _ends(ends: Iterable[End], naming: Naming) -> Iterator[NodeEnd]:
    for end in ends:
        types = tuple(types_of(end.type))
        for name in naming.names(end.name):
            match name:
                case KnownName(text, certain):
                    yield NodeEnd(end, text, certain, types)
                case UnknownName(why, place, pattern):
                    here = replace(end, place=place) if place is not None and not why else end
                    reach = _reach(pattern, naming)
                    yield NodeEnd(here, None, False, types, why, pattern, reach)


def _reach(pattern: str, naming: Naming) -> str:
    """The absolute names that a name of some pattern may be; what is remapped may be any."""
    if naming.launched is not None and naming.launched.remaps:
        return "*"
    if pattern.startswith(("/", "*")):
        return pattern
    return f"*/{pattern.removeprefix('~').lstrip('/')}"


def types_of(value: Resolved) -> Iterator[str]:
    """The types that an end may have; none where one of them is not known."""
    match value:
        case str():
            yield value
        case OneOf(values) if all(isinstance(v, str) for v in values):
            yield from (str(v) for v in values)
        case _:
            return
