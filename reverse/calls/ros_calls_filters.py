"""The callbacks of subscriptions through message filters, which are registered apart from them."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from tree_sitter import Node

from rebsync.reverse.calls.ros_calls_callbacks import Callbacks, Called
from rebsync.reverse.calls.ros_calls_sites import kept
from rebsync.reverse.graph import Site
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_flow_types import unscoped_member
from rebsync.reverse.values.cpp_values import Values

_FURTHEST = 4


def registered(values: Values, callbacks: Callbacks, site: Site) -> list[Called]:
    """What is called for messages that come through the object a call makes.

    The object may be handed to others, a synchronizer or a filter by frames: then it is what is
    registered with these.
    """
    found: list[Called] = []
    waiting, seen = [_last(site.kept)], set[str]()
    while waiting and len(seen) < _FURTHEST:
        name = waiting.pop(0)
        if not name or name in seen:
            continue
        seen.add(name)
        for cpp, place in _places(values, name, site):
            argument = _given_to(place, "registerCallback")
            if argument is not None:
                frame = values.open_frame(cpp, argument)
                for called in values.settle(frame, partial(callbacks.of, argument)):
                    found += called
            else:
                waiting += _handed_to(place)
    return found


def _places(values: Values, name: str, site: Site) -> Iterator[tuple[Cpp, Node]]:
    """Where a name stands in the function around a site, or in functions of the same class."""
    for cpp, place in values.texts.everywhere(name):
        function = values.texts.function_around(cpp, place)
        if function is None:
            continue
        same = site.function is not None and function.node == site.function.node
        if same or (function.owner and function.owner == site.owner):
            yield cpp, place


def _given_to(place: Node, method: str) -> Node | None:
    """The first argument of a method that is called on a name."""
    above = place.parent
    if above is not None and above.type == "field_expression" and part(above, "field") == place:
        above = above.parent  # `this->name`
    call = above.parent if above is not None else None
    if above is None or above.type != "field_expression" or call is None:
        return None
    if call.type != "call_expression" or unscoped_member(part(above, "field")) != method:
        return None
    arguments = named(part(call, "arguments"))
    return arguments[0] if arguments else None


def _handed_to(place: Node) -> Iterator[str]:
    """The name of the object that another is handed to."""
    arguments = climb(place, lambda n: n.type in ("argument_list", "compound_statement"))
    holder = arguments.parent if arguments is not None else None
    if arguments is None or arguments.type != "argument_list" or holder is None:
        return
    match holder.type:
        case "call_expression":
            function = part(holder, "function")
            if function.type == "field_expression" and text_of(part(function, "field")) in (
                *("connectInput", "add"),
            ):
                yield _last(text_of(part(function, "argument")))
            yield _last(kept(holder))
        case "field_initializer":
            yield text_of(holder.named_children[0])
        case "init_declarator":
            yield _last(text_of(part(holder, "declarator")))
        case "new_expression":
            yield _last(kept(holder))
        case _:
            return


def _last(text: str) -> str:
    """The last name in an expression: `sub_` of `this->sub_`."""
    return text.replace("->", ".").rpartition(".")[2].strip("*&() ")
