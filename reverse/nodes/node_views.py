"""Units of packages whose programs have classes of the same name: each is read by itself."""

from __future__ import annotations

import re
from dataclasses import field, replace

from rebsync.records import dataclass
from rebsync.reverse.files.packages import HEADERS
from rebsync.reverse.graph import Graph
from rebsync.reverse.nodes.node_programs import Program
from rebsync.reverse.nodes.node_units import Start, Unit, UnitFacts, Units
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp

# The last part of the path of what a file includes.
_INCLUDE = re.compile(rb'#[ \t]*include[ \t]*["<](?:[^">\n]*/)?([^">\n/]+)[">]')
_HEADERS = tuple(HEADERS)


def all_units(
    code: Code,
    graph: Graph,
    programs: tuple[Program, ...],
    generated: bool,
    whole: bool = False,
) -> tuple[list[Unit], list[Start]]:
    """All units of some code, and where they start; the names of units are different.

    `whole` asks for all that ask ROS for anything.
    """
    facts = UnitFacts.of(graph)
    if not _is_ambiguous(code):
        return _renamed(*Units(code, facts, programs, generated, whole).all())
    units: list[Unit] = []
    starts: list[Start] = []
    included = _Included(code)
    for program in programs:
        seen = included.seen_by(program)
        view = code.view(cpp for cpp in code.files if cpp.source.path in seen)
        of_program, started = Units(view, facts, (program,), generated, whole).all()
        known = {id(u): _same(u, units) for u in of_program}
        used = {id(s.unit) for s in started}
        units += [u for u in of_program if known[id(u)] is u and id(u) in used]
        starts += [replace(s, unit=known[id(s.unit)]) for s in started]
    rest, more = Units(code, facts, (), generated, whole).all()
    places = {u.owner.cpp.source.path for u in units if u.owner is not None}
    units += [u for u in rest if u.owner is not None and u.owner.cpp.source.path not in places]
    return _renamed(units, [*starts, *(s for s in more if s.unit in units)])


@dataclass(slots=True)
class _Included:
    """Follows what files include to the headers of some code."""

    code: Code
    headers: dict[bytes, list[Cpp]] = field(default_factory=dict)
    by_path: dict[str, list[Cpp]] = field(default_factory=dict)
    _included: dict[int, list[bytes]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for cpp in self.code.files:
            self.by_path.setdefault(cpp.source.path, []).append(cpp)
        for cpp in filter(is_header, self.code.files):
            name = cpp.source.path.rpartition("/")[2].encode()
            self.headers.setdefault(name, []).append(cpp)

    def seen_by(self, program: Program) -> set[str]:
        """The paths of a program's sources, and of the headers that they include, however deep."""
        waiting = [cpp for path in program.sources for cpp in self.by_path.get(path, ())]
        found = {cpp.source.path for cpp in waiting}
        while waiting:
            for name in self._names(waiting.pop()):
                fresh = [h for h in self.headers[name] if h.source.path not in found]
                found |= {h.source.path for h in fresh}
                waiting += fresh
        return found

    def _names(self, cpp: Cpp) -> list[bytes]:
        """The names of the files of the code that a file includes."""
        if id(cpp) not in self._included:
            names = dict.fromkeys(_INCLUDE.findall(cpp.data))
            self._included[id(cpp)] = [name for name in names if name in self.headers]
        return self._included[id(cpp)]


def is_header(cpp: Cpp) -> bool:
    """Whether a file is one that others include."""
    return cpp.source.path.endswith(_HEADERS)


def _is_ambiguous(code: Code) -> bool:
    """Whether several classes, or functions of such, have one name."""
    return any(
        len({c.cpp.source.path for c in same if not c.outer}) > 1
        for same in code.all_classes.values()
    )


def _same(unit: Unit, units: list[Unit]) -> Unit:
    """The unit of the same class, if there is one already."""
    if unit.owner is None:
        return unit
    same = (u for u in units if u.owner is not None and u.owner.node.id == unit.owner.node.id)
    return next(same, unit)


def _renamed(units: list[Unit], starts: list[Start]) -> tuple[list[Unit], list[Start]]:
    """With names of units that are different."""
    names: set[str] = set()
    new: dict[int, Unit] = {}
    for unit in units:
        name, number = unit.name, 2
        while name in names:
            name, number = f"{unit.name}_{number}", number + 1
        names.add(name)
        new[id(unit)] = unit if name == unit.name else replace(unit, name=name)
    return list(new.values()), [replace(s, unit=new[id(s.unit)]) for s in starts]
