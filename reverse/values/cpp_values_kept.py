"""What variables make of what they are given: lists, defaults of parameters, pointers."""

from __future__ import annotations

from functools import partial

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, OneOf
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.values.cpp_evaluator import CppEvaluator
from rebsync.reverse.values.cpp_flow_definitions import Definition
from rebsync.reverse.values.cpp_flow_types import Variable
from rebsync.reverse.values.cpp_values_names import name_under, resolved
from rebsync.reverse.values.cpp_values_numbers import converted
from rebsync.reverse.values.cpp_values_plain import (
    MOST,
    Choice,
    Found,
    Frame,
    Handle,
    Nothing,
    Value,
    choice,
    each,
    ways,
)


def listed(values: CppEvaluator, type_: str, definition: Definition, frame: Frame) -> Value:
    """The elements of an array or vector that is made of them."""
    given = [values.value(g, frame) for g in definition.arguments]
    found = [converted(value, type_) for value in given]
    holder = part(definition.node, "value") if definition.node.type == "init_declarator" else None
    braces = holder is not None and holder.type == "initializer_list"
    match found:
        case [tuple() as copied]:
            return copied
        case [_, (bool() | int() | float() | str()) as element] if not braces:
            count = given[0]
            if type(count) is int and 0 <= count < MOST:
                return (element,) * count
        case _ if braces and all(isinstance(v, (bool, int, float, str)) for v in found):
            return tuple(v for v in found if isinstance(v, (bool, int, float, str)))
        case _:
            pass
    return values.unknown("a list that is not known", definition.place, frame)


def with_default(value: Value, default: Value) -> Value:
    """The value of a parameter with what the code puts in its place where it is not set."""
    if isinstance(default, Nothing) and not isinstance(value, (Choice, OneOf)):
        return value
    return each(partial(_with_default, default=default), value)


def _with_default(value: Value, default: Value) -> Value:
    match default:
        case Nothing():
            return value
        case bool() | int() | float() | str() | FromParameter() if isinstance(value, FromParameter):
            return FromParameter(value.name, default, value.expression, value.search, value.within)
        case _:
            return choice([default, value])


def found_by(values: CppEvaluator, handle: Value, key: Value, call: Node, frame: Frame) -> Value:
    """The full name of a parameter that a search upwards finds."""

    def one(name: Value) -> Value:
        unknown = values.unknown("the name that is searched for", call, frame)
        text = resolved(name, unknown)
        namespaces = [h.namespace for h in ways(handle) if isinstance(h, Handle)] or [""]
        return choice(
            Found(name_under(n, text if text is not None else unknown)) for n in namespaces
        )

    return each(one, key)


def is_pointer(variable: Variable) -> bool:
    """Whether a variable is a pointer, plain or shared."""
    above = variable.name.parent
    if above is not None and above.type == "pointer_declarator":
        return True
    if variable.field is not None:
        for declarator in variable.field.node.children_by_field_name("declarator"):
            if declarator.type == "pointer_declarator" and variable.text in text_of(declarator):
                return True
    text = text_of(variable.type) if variable.type is not None else ""
    return "_ptr<" in text or text.endswith("Ptr")


def on_this(call: Node) -> bool:
    """Whether a call is one of a method of the same object."""
    if call.type != "call_expression":
        return call.type == "field_initializer"
    function = part(call, "function")
    return function.type != "field_expression" or part(function, "argument").type == "this"


def root_of(node: Node) -> tuple[Node, str]:
    """The name that `a.b.c`, `this->a` or `(*a).b` begins with, and the fields after it."""
    root, path = node, ""
    while root.type in ("field_expression", "parenthesized_expression", "pointer_expression"):
        if root.type == "field_expression":
            inner = part(root, "argument")
            name = text_of(part(root, "field"))
            if inner.type == "this":
                root = part(root, "field")
                break
            path = f"{name}.{path}" if path else name
            root = inner
        else:
            inside = named(root)
            root = inside[-1] if inside else root.children[0]
    return root, path
