"""The node handle or node that a call goes through, and what it says of the call."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from tree_sitter import Node

from rebsync.reverse.calls.ros_calls_shapes import Asked
from rebsync.reverse.graph import Resolved, Under
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.values.cpp_values import Values
from rebsync.reverse.values.cpp_values_names import one_of
from rebsync.reverse.values.cpp_values_plain import Frame, Handle, Made, Value, ways


def namespace_of(values: Values, asked: Asked, frame: Frame) -> Resolved:
    """The namespace of the node handle that a call goes through."""
    if asked.ask.flat:
        return ""
    target = asked.target
    if "handle" in asked.ask.arguments:
        target = _handed(asked)
        if asked.ask.kind is Kind.SINGLE and target is not None:
            type_ = values.types.type_of(frame.cpp, target).rpartition("::")[2]
            target = target if type_ in libraries.handles() else None
    if target is None or _is_node(values, target, frame):
        return ""
    namespace = one_of(h.namespace for h in _handles(values, values.value(target, frame)))
    return namespace if namespace is not None else Under("")


def usual_depth(values: Values, asked: Asked, frame: Frame) -> Resolved | None:
    """The queue of a filter that is made of a node of ROS 2 without a quality of service."""
    target = _handed(asked) if "handle" in asked.ask.arguments else None
    if target is None or not _is_node(values, target, frame):
        return None
    return libraries.profiles()["rmw_qos_profile_default"]


def _handed(asked: Asked) -> Node | None:
    """The node or node handle among the arguments."""
    index = asked.ask.arguments.index("handle")
    given = asked.arguments[index : index + 1]
    return given[0] if given else None


def _is_node(values: Values, target: Node, frame: Frame) -> bool:
    """Whether an expression is a node, under which names are not looked up."""
    if values.types.type_of(frame.cpp, target) in libraries.node_names():
        return True
    class_ = values.types.class_of(frame.cpp, target)
    return any(c.roots for c in values.texts.lineage(class_))


def _handles(values: Values, value: Value) -> Iterator[Handle]:
    for way in ways(value):
        if isinstance(way, Handle):
            yield way
        elif isinstance(way, Made) and way.type.rpartition("::")[2] in libraries.made_of_handles():
            yield from _made_of(values, way)


def _made_of(values: Values, made: Made) -> Iterator[Handle]:
    """The handles that an object is made of."""
    for argument in made.use.arguments[:1]:
        for inner in values.settle(made.frame, partial(values.value, argument)):
            yield from _handles(values, inner)
