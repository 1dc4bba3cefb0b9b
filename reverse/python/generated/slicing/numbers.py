"""Numbers of a class of generated Python that people added to tell them to people."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.libraries.python import log_words
from rebsync.reverse.python.generated.py_types import markers_at
from rebsync.reverse.python.generated.roles import PyRoles
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import field, text_of


def numbers_for_people(roles: PyRoles) -> frozenset[str]:
    """The variables that no marker says are the model's, and that something logs or publishes.

    Whether nothing else asks them is for the caller to tell.
    """
    py = roles.owner.py
    added = {
        name
        for name, (_, _, statement) in roles.state.items()
        if name not in roles.own
        and not any(x.startswith("statevar ") for x in markers_at(py, statement))
    }
    nodes = nodes_in(roles.owner.node) if added else ()
    asked = (n for n in nodes if n.type == "attribute" and text_of(field(n, "object")) == "self")
    told = {text_of(field(n, "attribute")) for n in asked if any(map(_tells, ancestors(n)))}
    return frozenset(added & told)


def _tells(node: Node) -> bool:
    """Whether something is a call that logs or publishes what it is given."""
    called = text_of(field(node, "function")) if node.type == "call" else ""
    return log_words().match(called) is not None or called.endswith("_pub.publish")
