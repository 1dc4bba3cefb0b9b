"""Nodes of ROS 2 that put themselves into a namespace: `Node("door", "left")`.

The names of their topics are read as if they had none, so that they may lead elsewhere.
"""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import NodeFact
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.cpp_tree import named, text_of

_WHY = "the node puts itself into a namespace here: its topics are read without"
_OPTIONS = re.compile(r"NodeOptions|[Oo]ptions\b")
_NOWHERE = frozenset({"", "/", "None"})


def note_namespaces(unit: Unit, findings: Findings) -> None:
    """Lists where nodes of a unit say the namespace that they are in."""
    for fact in (f for f in unit.facts if isinstance(f, NodeFact) and unit.flat):
        if _says_namespace(fact):
            place = fact.site.place
            findings.unreadable(place.source, Unread(place.span, _WHY), unit.name)


def _says_namespace(fact: NodeFact) -> bool:
    call = fact.site.call
    given = next((c for c in call.named_children if c.type == "argument_list"), None)
    arguments = named(given) if given is not None else []
    keywords = [a for a in arguments if a.type == "keyword_argument"]
    names = (a.child_by_field_name("name") for a in keywords)
    values = [
        a.child_by_field_name("value")
        for a, n in zip(keywords, names, strict=True)
        if n is not None and text_of(n) == "namespace"
    ]
    second = arguments[1] if len(arguments) > 1 and not keywords else None
    if second is not None and not _is_options(fact, second):
        values.append(second)
    return any(v is not None and text_of(v).strip("'\"") not in _NOWHERE for v in values)


def _is_options(fact: NodeFact, argument: Node) -> bool:
    """Whether an argument is one of options of a node, by its text or the type of its variable."""
    text = text_of(argument)
    declared = re.compile(rf"NodeOptions\s*(?:const\s*)?&?\s*{re.escape(text)}\b")
    return bool(_OPTIONS.search(text) or declared.search(fact.site.place.source.text))
