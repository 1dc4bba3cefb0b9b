"""Facts of calls with several parameters at once, and types of messages given as texts."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.calls.ros_calls_shapes import Asked
from rebsync.reverse.graph import Fact, ParameterFact, Resolved, Unresolved
from rebsync.reverse.libraries.routines import Access, Kind
from rebsync.reverse.syntax.cpp_tree import named
from rebsync.reverse.values.cpp_flow import made_of
from rebsync.reverse.values.cpp_values import Values
from rebsync.reverse.values.cpp_values_names import resolved
from rebsync.reverse.values.cpp_values_plain import Frame

_EACH = "all parameters whose names begin so"
_KINDS = ("msg", "srv", "action")


def several(values: Values, asked: Asked) -> Iterator[Fact] | None:
    """The facts of a call that asks for several parameters; None for other calls."""
    match asked.ask.kind:
        case Kind.DECLARED:
            return _declared_together(values, asked)
        case Kind.READ:
            return _read_together(values, asked)
        case Kind.SET:
            return _set_one(values, asked)
        case _:
            return None


def _declared_together(values: Values, asked: Asked) -> Iterator[Fact]:
    """What `declare_parameters("prefix", {{"x", 1}, {"y", 2}})` declares, one by one."""
    site = asked.site
    frame = Frame(site.cpp, site.function, outside=True)
    prefix = _text(values, asked.arguments[0], frame) if asked.arguments else None
    pairs = _pairs(values, asked.arguments[1], frame) if len(asked.arguments) > 1 else []
    if prefix is None or not pairs:
        yield ParameterFact(site, _beginning(asked, prefix), Access.DECLARE)
        return
    for key, value in pairs:
        name = _text(values, key, frame)
        unknown = Unresolved("the name is not known", site.place)
        whole: Resolved = unknown
        if name is not None:
            whole = f"{prefix}.{name}" if prefix else name
        default = resolved(values.value(value, frame), unknown)
        yield ParameterFact(site, whole, Access.DECLARE, default)


def _read_together(values: Values, asked: Asked) -> Iterator[Fact]:
    """What `get_parameters("prefix", map)` or `get_parameters({"a", "b"})` reads."""
    site = asked.site
    frame = Frame(site.cpp, site.function, outside=True)
    first = asked.arguments[0] if asked.arguments else None
    if first is not None and first.type == "initializer_list":
        for node in named(first):
            name = _text(values, node, frame)
            unknown = Unresolved("the name is not known", site.place)
            yield ParameterFact(site, name if name is not None else unknown, Access.GET)
        return
    prefix = _text(values, first, frame) if first is not None else None
    yield ParameterFact(site, _beginning(asked, prefix), Access.GET)


def _set_one(values: Values, asked: Asked) -> Iterator[Fact]:
    """What `set_parameter(rclcpp::Parameter("x", 1))` sets."""
    site = asked.site
    frame = Frame(site.cpp, site.function, outside=True)
    unknown = Unresolved("the parameter is not known", site.place)
    given = _arguments(asked.arguments[0]) if asked.arguments else []
    if len(given) != 2:
        yield ParameterFact(site, unknown, Access.SET)
        return
    name = resolved(values.value(given[0], frame), unknown)
    value = resolved(values.value(given[1], frame), unknown)
    yield ParameterFact(site, name if name is not None else unknown, Access.SET, None, value)


def interface_of(value: Resolved) -> Resolved:
    """`std_msgs/String` for `std_msgs/msg/String`."""
    parts = value.split("/") if isinstance(value, str) else []
    return f"{parts[0]}/{parts[2]}" if len(parts) == 3 and parts[1] in _KINDS else value


def _beginning(asked: Asked, prefix: str | None) -> Unresolved:
    partial = f"{prefix}.*" if prefix else None
    return Unresolved(_EACH, asked.site.place, partial)


def _text(values: Values, node: Node, frame: Frame) -> str | None:
    found = values.value(node, frame)
    return found if isinstance(found, str) else None


def _pairs(values: Values, node: Node, frame: Frame) -> list[tuple[Node, Node]]:
    """The keys and values of a map that is written out, where it is used or declared."""
    listed = tuple(named(node)) if node.type == "initializer_list" else ()
    if not listed:
        variable = values.types.variable(frame.cpp, node)
        listed = (made_of(variable.name) or ()) if variable is not None else ()
    if len(listed) == 1 and listed[0].type == "initializer_list":
        inner = named(listed[0])
        listed = tuple(inner) if inner and inner[0].type == "initializer_list" else listed
    found = [named(n) for n in listed]
    if any(n.type != "initializer_list" for n in listed) or any(len(p) < 2 for p in found):
        return []
    return [(p[0], p[1]) for p in found]


def _arguments(node: Node) -> list[Node]:
    """The arguments of an object that is made where it is handed over."""
    given = node.child_by_field_name("arguments") or node.child_by_field_name("value")
    if given is None:
        return named(node) if node.type == "initializer_list" else []
    return named(given)
