"""What keeps an object of ROS alive in C++, and what of it the middleware calls."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.graph import PublisherFact
from rebsync.reverse.syntax.cpp_tree import inside, text_of

_NUMBERS = frozenset({"true", "false", "number_literal"})
_WRITTEN = _NUMBERS | {"identifier"}  # where it is known to be whether it latches
_LATCHED = 2  # the place where `advertise` takes whether it latches, or else functions


def is_kept(body: Node, made: Node, name: str) -> bool:
    """Whether a body may keep the local that a declarator makes: to call it does not.

    What stands within the declarator has names of its own, or ends with the local.
    """
    return any(
        text_of(node) == name and not _is_called(node)
        for node in inside(body, "identifier")
        if not made.start_byte <= node.start_byte < made.end_byte
    )


def _is_called(node: Node) -> bool:
    """Whether a name is only that of an object of which a part is named: `timer->reset()`."""
    above = node.parent
    return above is not None and above.type == "field_expression"


def called_by_listeners(fact: PublisherFact) -> Node | None:
    """The first argument of `advertise` that is a function, called as subscribers come and go."""
    call = fact.site.call
    function, given = (call.child_by_field_name(n) for n in ("function", "arguments"))
    if function is None or given is None or "advertise" not in text_of(function):
        return None
    arguments = [n for n in given.named_children if n.type != "comment"]
    found = arguments[_LATCHED : _LATCHED + 1]
    flags = _WRITTEN if isinstance(fact.latched, bool) else _NUMBERS
    return next((n for n in found if n.type not in flags), None)
