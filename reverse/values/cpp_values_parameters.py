"""Values of parameters that code looks up by name."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, Unresolved
from rebsync.reverse.values.cpp_evaluator import CppEvaluator
from rebsync.reverse.values.cpp_values_names import name_under, resolved
from rebsync.reverse.values.cpp_values_plain import (
    Found,
    Frame,
    Handle,
    Value,
    each,
)


def from_parameter(
    values: CppEvaluator, handle: Value, name: Value, default: Value, node: Node, frame: Frame
) -> Value:
    """The value of a parameter that a handle looks up."""
    namespace = handle.namespace if isinstance(handle, Handle) else ""

    def one(text: Value) -> Value:
        unknown = values.unknown("the name of the parameter is not known", node, frame)
        stands = resolved(default, unknown)
        if isinstance(stands, Unresolved):
            stands = None
        if isinstance(text, Found):
            return FromParameter(text.name, stands, search=True)
        full = resolved(text, unknown)
        return FromParameter(name_under(namespace, full if full is not None else unknown), stands)

    return each(one, name)
