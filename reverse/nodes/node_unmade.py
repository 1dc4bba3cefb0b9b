"""Lists what talks to ROS in code, and is in no node that was found."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import Graph
from rebsync.reverse.nodes.node_units import CONNECTS, Start, Unit
from rebsync.reverse.syntax.cpp_tree import Cpp

_BESIDE = "a function of another package asks for this: what comes of it is not in the model"
_UNMADE = "objects of this class may be made where it is not seen: they are not in the model"


def list_beside(graph: Graph, units: Sequence[Unit], findings: Findings) -> None:
    """Lists what functions of other packages ask for that is in no unit."""
    known = {id(fact) for unit in units for fact in unit.facts}
    for fact in graph.facts:
        site = fact.site
        if site.cpp.is_beside and isinstance(fact, CONNECTS) and id(fact) not in known:
            unread = Unread(site.cpp.span(site.call), _BESIDE)
            findings.unreadable(site.cpp.source, unread, site.owner or "")


def list_unmade(
    units: Sequence[Unit], starts: Sequence[Start], files: Sequence[Cpp], findings: Findings
) -> None:
    """Lists the classes that talk to ROS and that code names, if no object of them was found.

    Where other nodes start, these may be made in a way that is not looked for.
    """
    begun = {id(start.unit) for start in starts}
    for unit in units if starts else ():
        owner = unit.owner
        if owner is not None and id(unit) not in begun and _is_named(owner.name, files):
            name = owner.node.child_by_field_name("name") or owner.node
            unread = Unread(owner.cpp.span(name), _UNMADE)
            findings.unreadable(owner.cpp.source, unread, unit.name)


def _is_named(name: str, files: Iterable[Cpp]) -> bool:
    """Whether the name of a class stands anywhere for more than to declare and define it."""
    word = name.encode()
    behind = rb"\b(?!\s*(?:::|\(|\{|:|;|final\b))"
    plain = rb"(?<!class )(?<!struct )(?<![~\w])" + word + behind
    made = rb"(?:\bnew\b|\breturn\b|[=,(<?]|[)]\s*:)\s*(?:\w+::)*" + word + rb"\s*[({]"
    pattern = re.compile(made + rb"|" + plain)
    return any(word in each.words and pattern.search(each.data) is not None for each in files)
