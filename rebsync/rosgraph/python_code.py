"""The nodes of a package's Python: classes that are nodes, and programs."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from rebsync.records import dataclass
from rebsync.reverse.files.packages import BESIDE
from rebsync.reverse.graph import ClientFact, Graph, NodeFact, UnmodelledFact
from rebsync.reverse.python.bodies.body_scope import PyUnit
from rebsync.reverse.python.bodies.body_units import units_of
from rebsync.reverse.python.nodes.body_started import is_module, scripts_of
from rebsync.reverse.python.values.py_unmodelled import whole_graph
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse
from rebsync.reverse.values.cpp_values_names import one_of
from rebsync.rosgraph.closed import is_closed
from rebsync.rosgraph.ends import End, NodeCode
from rebsync.rosgraph.facts import distinct, end_of, ends_of_unmodelled, first_place, parameter_of
from rebsync.source import Source


def nodes_in_python(
    code: Mapping[str, Source], files: Mapping[str, Source], package: str
) -> Iterator[NodeCode]:
    """The nodes in some files of code; `files` are all of the package."""
    read = PyCode.of([parse(s, path.startswith(BESIDE)) for path, s in sorted(code.items())])
    values = PyValues(read)
    graph = whole_graph(values)
    # What has no place in a model is a fact here, so that it comes to the unit that it stands in.
    besides = [(ClientFact(u.site, u.name or "", u.type or ""), u) for u in graph.unmodelled]
    facts = Graph((*graph.facts, *(fact for fact, _ in besides)))
    units = units_of(values, facts, lambda _: True, whole=True)
    own = {package, *(path.rpartition("/")[2].removesuffix(".py") for path in code)}
    own |= {path.partition("/")[0] for path in code}
    reading = _Reading(package, scripts_of(files), besides, frozenset(own), code)
    for group in _groups(units):
        node = reading.node(group)
        if node is not None:
            yield node


@dataclass(frozen=True, slots=True, eq=False)
class _Reading:
    """Makes nodes of units; `own` are the names of the package's modules.

    `besides` are facts that stand for what has no place in a model.
    """

    package: str
    scripts: Mapping[str, str]
    besides: Sequence[tuple[ClientFact, UnmodelledFact]]
    own: frozenset[str]
    code: Mapping[str, Source]

    def node(self, group: Sequence[PyUnit]) -> NodeCode | None:
        """The node that some units are together, if it is one or asks for anything."""
        facts = [fact for unit in group for fact in unit.unit.facts]
        made = [f for f in facts if isinstance(f, NodeFact)]
        ends = tuple(distinct(e for unit in group for e in self._ends(unit)))
        uses = tuple(distinct(p for f in facts if (p := parameter_of(f)) is not None))
        if not ends and not made and not uses:
            return None
        names = [f.name for f in made if f.name is not None]
        return NodeCode(
            package=self.package,
            label=_label(group),
            name=one_of(names),
            executables=frozenset(self._executables(group)),
            ends=ends,
            parameters=uses,
            place=made[0].site.place if made else first_place(ends, uses),
            is_node=bool(made),
            is_flat=group[0].library.flat,
            closed=bool(made) and is_closed(_sources(group), self.own),
            anonymous=any(f.anonymous for f in made),
        )

    def _ends(self, unit: PyUnit) -> Iterator[End]:
        for fact in unit.unit.facts:
            found = next((u for known, u in self.besides if known is fact), None)
            if found is not None:
                yield from ends_of_unmodelled(found, unit.library.flat)
            elif (end := end_of(fact)) is not None:
                yield end

    def _executables(self, group: Sequence[PyUnit]) -> Iterator[str]:
        """The names of the file, and of the scripts whose module has or names the class."""
        for unit in group:
            path = unit.module.py.source.path
            yield path.rpartition("/")[2]
            yield path.rpartition("/")[2].removesuffix(".py")
            for script, module in self.scripts.items():
                if is_module(path, module) or self._is_named_in(module, unit):
                    yield script

    def _is_named_in(self, module: str, unit: PyUnit) -> bool:
        sources = (s for path, s in self.code.items() if is_module(path, module))
        return bool(unit.lineage) and any(_names(s, unit.lineage[0].name) for s in sources)


def _names(source: Source, word: str) -> bool:
    return re.search(rf"\b{re.escape(word)}\b", source.text) is not None


def _sources(group: Sequence[PyUnit]) -> list[Source]:
    found = [unit.module.py.source for unit in group]
    found += [scope.py.source for unit in group for scope in unit.lineage]
    return list({source.path: source for source in found}.values())


def _label(group: Sequence[PyUnit]) -> str:
    with_class = next((u for u in group if u.lineage), None)
    if with_class is not None:
        return with_class.lineage[0].name
    return group[0].module.py.source.path.rpartition("/")[2]


def _groups(units: Sequence[PyUnit]) -> Iterator[list[PyUnit]]:
    """The units by the nodes that they are of.

    What makes no node itself belongs to the one of its module, or else to the one whose module
    names its class. All of a module that is one node by its library belong together.
    """
    nodes: list[list[PyUnit]] = []
    loose: list[PyUnit] = []
    for unit in units:
        if not any(isinstance(f, NodeFact) for f in unit.unit.facts):
            loose.append(unit)
            continue
        same = (g for g in nodes if g[0].module is unit.module and not unit.library.flat)
        group = next(same, None)
        if group is None:
            nodes.append([unit])
        else:
            group.append(unit)
    for unit in loose:
        near = [g for g in nodes if g[0].module is unit.module]
        if not near and unit.lineage:
            name = unit.lineage[0].name
            near = [g for g in nodes if _names(g[0].module.py.source, name)]
        if len(near) == 1:
            near[0].append(unit)
        else:
            nodes.append([unit])
    yield from nodes
