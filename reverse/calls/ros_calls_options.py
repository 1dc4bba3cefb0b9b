"""The arguments that code gathers in an object before a call: `SubscribeOptions` and others."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries.routines import Options
from rebsync.reverse.syntax.cpp_calls import call_around
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.values.cpp_flow import declaration_of, made_of
from rebsync.reverse.values.cpp_flow_types import unscoped_member
from rebsync.reverse.values.cpp_values import Values
from rebsync.reverse.values.cpp_values_plain import Frame


@dataclass(frozen=True, eq=False)
class Given:
    """An argument, and the frame that it is asked for in."""

    node: Node
    frame: Frame


def options_of(values: Values, node: Node, frame: Frame, roles: Options) -> dict[str, Given]:
    """What the options that a node stands for hold, by roles; `type` is the message's."""
    if node.type == "call_expression":
        return _created(node, frame, roles)
    variable = values.types.variable(frame.cpp, node)
    if variable is None or frame.function is None or variable.cpp is not frame.cpp:
        return {}
    start = frame.function.node.start_byte
    found: dict[str, Given] = {}
    for place in values.texts.within(frame.cpp, variable.text, start, node.start_byte):
        found |= _at(place, frame, roles)
    return found


def _created(call: Node, frame: Frame, roles: Options) -> dict[str, Given]:
    """`Options::create<T>(...)`, `ops.init<T>(...)`, or a constructor."""
    function = part(call, "function")
    while function.type in ("qualified_identifier", "field_expression"):
        field = "name" if function.type == "qualified_identifier" else "field"
        function = part(function, field)
    name = unscoped_member(function)
    order = (
        roles.made if name in ("create", "init", "initByFullCallbackType") else roles.constructed
    )
    found = _ordered(tuple(named(part(call, "arguments"))), order, frame)
    if function.type in ("template_method", "template_function"):
        types = named(part(function, "arguments"))
        if types:
            found["type"] = Given(types[0], frame)
    return found


def _ordered(arguments: tuple[Node, ...], order: tuple[str, ...], frame: Frame) -> dict[str, Given]:
    return {r: Given(a, frame) for r, a in zip(order, arguments, strict=False) if r}


def _at(place: Node, frame: Frame, roles: Options) -> dict[str, Given]:
    """What one use of the object gives it."""
    if declaration_of(place) is not None:
        given = made_of(place)
        if given and len(given) == 1 and given[0].type == "call_expression":
            return _created(given[0], frame, roles)
        return _ordered(given or (), roles.constructed, frame)
    above = place.parent
    if above is None:
        return {}
    if above.type == "assignment_expression" and part(above, "left") == place:
        right = part(above, "right")
        return _created(right, frame, roles) if right.type == "call_expression" else {}
    if above.type != "field_expression" or part(above, "argument") != place:
        return {}
    holder = above.parent
    if holder is not None and holder.type == "assignment_expression":
        role = roles.fields.get(text_of(part(above, "field")))
        if role and role != "type" and part(holder, "left") == above:
            return {role: Given(part(holder, "right"), frame)}
    call = call_around(place)
    if call is not None and part(call, "function") == above:
        return _created(call, frame, roles)
    return {}
