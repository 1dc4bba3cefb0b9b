"""Arguments that Python gives its own node, as `reverse.nodes.node_arguments` of C++."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.libraries import arguments
from rebsync.reverse.nodes.node_arguments import OWN_ARGUMENTS
from rebsync.reverse.python.values.py_asks import roles
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.python.values.py_worth import External, Items
from rebsync.reverse.syntax.py_index import Scope, arguments_of, last_name
from rebsync.reverse.syntax.py_tree import field, text_of

_NOTHING = frozenset({"None", "[]", "()"})
_OF_PROGRAM = re.compile(r"(?:sys\.)?argv(?:\[[^\]]*\])?")


def list_own_arguments(values: PyValues, findings: Findings) -> None:
    """Lists the calls that give nodes other arguments than the program's."""
    for call, scope in values.code.calls:
        is_beside = scope.py.is_beside
        if not is_beside and (_is_told(call) or any(_others(values, call, scope))):
            findings.unreadable(scope.py.source, Unread(scope.py.span(call), OWN_ARGUMENTS), "")


def _is_told(call: Node) -> bool:
    """Whether a keyword of a call says something of the arguments or parameters of a node."""
    words = arguments.own_in_python()
    _, keywords = arguments_of(call)
    return any(name in words and text_of(node) != words[name] for name, node in keywords.items())


def _others(values: PyValues, call: Node, scope: Scope) -> Iterator[bool]:
    """Of what a call starts the library with whether it is other than the program's arguments."""
    taking = arguments.taking_in_python()
    function = field(call, "function")
    if last_name(function) in {n.rpartition(".")[2] for n in taking}:
        for way in values.ways(function, scope):
            if isinstance(way, External) and way.name in taking:
                given = roles(taking[way.name], call).get("arguments")
                yield given is not None and _is_own(values, given, scope)


def _is_own(values: PyValues, node: Node, scope: Scope) -> bool:
    """Whether an argument is not nothing, nor the program's."""
    text = text_of(node)
    if text in _NOTHING or _OF_PROGRAM.fullmatch(text):
        return False
    if node.type != "identifier":
        return True
    around = scope.function
    is_parameter = around is not None and text in (p.name for p in around.parameters)
    return not is_parameter or any(isinstance(w, Items) for w in values.ways(node, scope))
