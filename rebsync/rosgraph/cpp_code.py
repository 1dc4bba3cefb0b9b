"""The nodes of a package's C++: objects of one program that share a node are one."""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace

from rebsync.records import dataclass
from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.files.packages import BESIDE, CODE
from rebsync.reverse.graph import Fact, NodeFact, UnmodelledFact
from rebsync.reverse.nodes.node_components import executables
from rebsync.reverse.nodes.node_programs import programs, with_nodes
from rebsync.reverse.nodes.node_units import Start, Unit
from rebsync.reverse.nodes.node_values import of_object
from rebsync.reverse.nodes.node_views import all_units
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.reverse.values.cpp_values_names import one_of
from rebsync.rosgraph.closed import is_closed
from rebsync.rosgraph.ends import End, NodeCode, ParameterUse
from rebsync.rosgraph.facts import distinct, end_of, ends_of_unmodelled, first_place, parameter_of
from rebsync.source import Source

_CODE = tuple(sorted(CODE))


def nodes_in_cpp(files: Mapping[str, Source], package: str) -> Iterator[NodeCode]:
    """The nodes; code that no program of the package runs comes as nodes that are none."""
    sources = sorted((path, s) for path, s in files.items() if path.endswith(_CODE))
    code = Code.of([parse(source, path.startswith(BESIDE)) for path, source in sources])
    asking = Asking(code)
    graph = asking.graph
    found = with_nodes(programs(code, files), graph)
    units, starts = all_units(code, graph, found, False, whole=True)
    reading = _Reading(code, package, executables(files), graph.unmodelled)
    yield from reading.started(starts)
    begun = {id(s.unit) for s in starts}
    for unit in units:
        if id(unit) not in begun:
            yield from reading.node([Start(unit, None, None)], is_node=False)
    yield from reading.rest(graph.facts)


@dataclass(slots=True)
class _Reading:
    """Makes nodes of units; `seen` are the facts that have their place in one."""

    code: Code
    package: str
    known_as: Mapping[str, frozenset[str]]
    unmodelled: Sequence[UnmodelledFact]
    seen: set[int] = field(default_factory=set)

    def started(self, starts: Sequence[Start]) -> Iterator[NodeCode]:
        """The nodes that programs, components and nodelets are."""
        processes: dict[Hashable, list[Start]] = {}
        for start in starts:
            processes.setdefault(start.process, []).append(start)
        for together in processes.values():
            for group in _groups(together):
                yield from self.node(group)

    def node(self, group: Sequence[Start], *, is_node: bool = True) -> Iterator[NodeCode]:
        """The node that some objects are together, if it is one or asks for anything."""
        ends = tuple(distinct(e for start in group for e in self._ends(start)))
        uses = tuple(distinct(p for start in group for p in _uses(start)))
        own = _own_nodes(group[0].unit)
        if not ends and not own and not uses:
            return
        program = group[0].program
        made = own or ([program.node] if program is not None and program.node is not None else [])
        names = [of_object(group[0], n.name) for n in made if n.name is not None]
        yield NodeCode(
            package=self.package,
            label=_label(group[0]),
            name=one_of(names),
            executables=frozenset(n for start in group for n in self._executables(start)),
            ends=ends,
            parameters=uses,
            place=made[0].site.place if made else first_place(ends, uses),
            is_node=is_node and bool(ends or own),
            is_flat=any(s.unit.flat for s in group),
            closed=is_node and is_closed(self._sources(group), [self.package]),
            anonymous=any(n.anonymous for n in made),
        )

    def _ends(self, start: Start) -> Iterator[End]:
        """The ends of an object, what is unmodelled by the functions that it stands in."""
        unit = start.unit
        self.seen |= {id(fact) for fact in unit.facts}
        for fact in unit.facts:
            if (end := end_of(fact)) is not None:
                yield _of_start(start, end)
        for each in self.unmodelled:
            owner, path = each.site.owner, each.site.place.source.path
            is_free = unit.owner is None and owner not in self.code.classes
            if (owner in unit.names) or (is_free and path in unit.files):
                self.seen.add(id(each))
                ends = ends_of_unmodelled(each, unit.flat)
                yield from (_of_start(start, end) for end in ends)

    def _executables(self, start: Start) -> Iterator[str]:
        unit, program = start.unit, start.program
        if program is not None:
            yield from (program.name, program.stem)
        for name in (start.nodelet, unit.owner.name if unit.owner is not None else None):
            if name is not None:
                yield from self.known_as.get(name, ())
        if start.nodelet is not None:
            yield start.nodelet

    def _sources(self, group: Sequence[Start]) -> Iterator[Source]:
        paths = {path for start in group for path in start.unit.files}
        paths |= {c.cpp.source.path for start in group for c in start.unit.lineage}
        paths |= {p for start in group if start.program for p in start.program.sources}
        yield from (cpp.source for cpp in self.code.files if cpp.source.path in paths)

    def rest(self, facts: Iterable[Fact]) -> Iterator[NodeCode]:
        """What stands in no unit, by its files."""
        left = [f for f in facts if id(f) not in self.seen]
        ends = [e for f in left if (e := end_of(f)) is not None]
        loose = (u for u in self.unmodelled if id(u) not in self.seen)
        ends += [end for each in loose for end in ends_of_unmodelled(each, False)]
        uses = [p for f in left if (p := parameter_of(f)) is not None]
        yield from loose_code(self.package, ends, uses)


def loose_code(
    package: str, ends: Iterable[End], uses: Iterable[ParameterUse]
) -> Iterator[NodeCode]:
    """Code of which it is not known what runs it, by its files."""
    ends, uses = list(ends), list(uses)
    places = [e.place for e in ends] + [u.place for u in uses]
    for path in dict.fromkeys(place.source.path for place in places):
        of_file = tuple(e for e in ends if e.place.source.path == path)
        own = tuple(p for p in uses if p.place.source.path == path)
        yield NodeCode(
            package=package,
            label=path.rpartition("/")[2],
            name=None,
            executables=frozenset(),
            ends=of_file,
            parameters=own,
            place=first_place(of_file, own),
            is_node=False,
            is_flat=False,
            closed=False,
        )


def _of_start(start: Start, end: End) -> End:
    """The end with the name that it has in one of several objects of a class."""
    return replace(end, name=of_object(start, end.name))


def _uses(start: Start) -> Iterator[ParameterUse]:
    for fact in start.unit.facts:
        if (use := parameter_of(fact)) is not None:
            yield replace(use, name=of_object(start, use.name))


def _own_nodes(unit: Unit) -> list[NodeFact]:
    """The nodes that the functions of a unit make themselves."""
    return [f for f in unit.facts if isinstance(f, NodeFact) and f.nodelet is None]


def _label(start: Start) -> str:
    unit = start.unit
    if unit.owner is not None:
        return unit.owner.name
    return start.program.name if start.program is not None else unit.name


def _groups(together: Sequence[Start]) -> Iterator[list[Start]]:
    """The objects of a program by the nodes that they are of: those with one first."""
    nodes = [s for s in together if _own_nodes(s.unit)]
    groups = [[s] for s in nodes]
    apart: list[Start] = []
    for start in together:
        if start in nodes:
            continue
        near = groups if len(groups) == 1 else [g for g in groups if _makes(g[0], start)]
        if len(near) == 1:
            near[0].append(start)
        else:
            apart.append(start)
    yield from groups
    if apart:
        yield apart


def _makes(node: Start, part: Start) -> bool:
    """Whether the code of a node makes objects of the class of another."""
    if part.unit.owner is None:
        return False
    name = re.escape(part.unit.owner.name.encode())
    made = re.compile(rb"(?:make_(?:shared|unique)\s*<[^;(]*|new\s+[\w:]*)\b" + name + rb"\b")
    files = [f.cpp for f in node.unit.functions] + [c.cpp for c in node.unit.lineage]
    return any(made.search(cpp.data) is not None for cpp in files)
