"""Units of packages whose programs have classes of the same name: each is read by itself."""

from __future__ import annotations

import re
from dataclasses import replace

from rebsync.reverse.files.packages import HEADERS
from rebsync.reverse.graph import Graph
from rebsync.reverse.nodes.node_programs import Program
from rebsync.reverse.nodes.node_units import Facts, Start, Unit, Units
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp

# The last part of the path of what a file includes.
_INCLUDE = re.compile(rb'#[ \t]*include[ \t]*["<](?:[^">\n]*/)?([^">\n/]+)[">]')
_HEADERS = tuple(HEADERS)


def all_units(
    code: Code, graph: Graph, programs: tuple[Program, ...], generated: bool
) -> tuple[list[Unit], list[Start]]:
    """All units of some code, and where they start; the names of units are different."""
    facts = Facts.of(graph)
    if not _is_ambiguous(code):
        return _renamed(*Units(code, facts, programs, generated).all())
    units: list[Unit] = []
    starts: list[Start] = []
    for program in programs:
        seen = _seen_by(code, program)
        view = code.view(cpp for cpp in code.files if cpp.source.path in seen)
        of_program, started = Units(view, facts, (program,), generated).all()
        known = {id(u): _same(u, units) for u in of_program}
        used = {id(s.unit) for s in started}
        units += [u for u in of_program if known[id(u)] is u and id(u) in used]
        starts += [replace(s, unit=known[id(s.unit)]) for s in started]
    rest, more = Units(code, facts, (), generated).all()
    places = {u.owner.cpp.source.path for u in units if u.owner is not None}
    units += [u for u in rest if u.owner is not None and u.owner.cpp.source.path not in places]
    return _renamed(units, [*starts, *(s for s in more if s.unit in units)])


def _seen_by(code: Code, program: Program) -> set[str]:
    """The paths of a program's sources, and of the headers that they include, however deep."""
    headers: dict[bytes, list[Cpp]] = {}
    for cpp in filter(is_header, code.files):
        name = cpp.source.path.rpartition("/")[2].encode()
        headers.setdefault(name, []).append(cpp)
    waiting = [cpp for cpp in code.files if program.has(cpp)]
    found = {cpp.source.path for cpp in waiting}
    while waiting:
        for name in _INCLUDE.findall(waiting.pop().data):
            fresh = [h for h in headers.get(name, ()) if h.source.path not in found]
            found |= {h.source.path for h in fresh}
            waiting += fresh
    return found


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
