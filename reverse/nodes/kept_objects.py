"""What keeps an object of ROS alive in C++, and what of it the middleware calls."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.graph import PublisherFact
from rebsync.reverse.syntax.cpp_tree import inside, part, text_of

_NUMBERS = frozenset({"true", "false", "number_literal"})
_WRITTEN = _NUMBERS | {"identifier"}  # where it is known to be whether it latches
_JOINING = re.compile(r"\bcreate_\w+(<.*>)?\Z", re.DOTALL)
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


def is_local_group(call: Node, body: Node | None) -> bool:
    """Whether only a local has a group of callbacks: those who are in it do not keep it."""
    made = call.parent
    name = made.child_by_field_name("declarator") if made is not None else None
    if made is None or made.type != "init_declarator" or name is None or body is None:
        return False
    uses = (n for n in inside(body, "identifier") if text_of(n) == text_of(name))
    return all(n == name or _is_called(n) or _is_joined(n) for n in uses)


def _is_joined(node: Node) -> bool:
    """Whether something becomes part of the group that is named: `options.callback_group = g`."""
    above = node.parent
    if above is None:
        return False
    if above.type == "assignment_expression":
        return text_of(part(above, "left")).endswith("callback_group")
    call = above.parent if above.type == "argument_list" else None
    function = call.child_by_field_name("function") if call is not None else None
    return function is not None and _JOINING.search(text_of(function)) is not None


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
