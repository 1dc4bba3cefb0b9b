"""Methods of the standard library's values: containers, texts, optionals, pointers, atomics."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.assignments import assign, compound
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value, lower_value
from rebsync.reverse.ir.cpp.functions_called import library_arguments, stored_result
from rebsync.reverse.ir.cpp.initialisation import by_arguments, element_value
from rebsync.reverse.ir.cpp.library import is_pure, library_class, method_result
from rebsync.reverse.ir.cpp.objects import class_of, dereferenced
from rebsync.reverse.ir.cpp.types import SIZE, Declared
from rebsync.reverse.ir.operators import Conversion
from rebsync.source import Span

_PUTTING = frozenset({"push_back", "push_front", "push", "insert", "assign", "resize", "append"})
# What all fields of messages give alike, whichever message it is.
_OF_FIELDS: dict[str, t.Type] = {"size": SIZE, "empty": t.Truth()}
_EMPTYING = frozenset({"pop_back", "pop_front", "pop", "clear", "reserve", "shrink_to_fit"})


def library_method(
    context: Context, of: Value, name: str, nodes: Sequence[Node], place: Span
) -> Value:
    """A method of an object of a library, or of a class that is not known."""
    match of.type:
        case t.Integer() | t.Float() | t.Truth() | t.Enumeration():
            return _atomic(context, of, name, nodes, place)
        case t.Optional(inner):
            result = _optional(context, of, inner, name, nodes, place)
        case t.Reference():
            result = _pointer(context, of, of.type, name, nodes, place)
        case t.Container() | t.Text() | t.Array():
            result = _container(context, of, name, nodes, place)
        case _:
            result = None
    return result or _called(context, of, name, nodes, place)


def _called(context: Context, of: Value, name: str, nodes: Sequence[Node], place: Span) -> Value:
    class_name = _library_base(context, of.type) or library_class(of.type)
    given = method_result(of.type, name)
    if class_name is None and name in _OF_FIELDS and _is_field(of.expression):
        class_name, given = "std::vector", _OF_FIELDS[name]
    if class_name is None:
        arguments = library_arguments(context, nodes, place, is_pure=False)
        method = s.MethodCallee(of.expression, name)
        return stored_result(context, method, arguments, Declared(t.UNKNOWN), place)
    full = f"{class_name}::{name}"
    arguments = library_arguments(context, nodes, place, is_pure(full))
    callee = s.LibraryCallee(full, of.expression)
    return stored_result(context, callee, arguments, Declared(given), place)


def _is_field(value: e.Expression) -> bool:
    """Whether a value is a field of a message; one that has methods is a container, or a text."""
    return isinstance(value, e.Attribute) and isinstance(
        getattr(value.object, "type", None), t.RosMessage
    )


def _library_base(context: Context, type_: t.Type) -> str | None:
    """The class of a library that a class of the program is derived from."""
    owner = class_of(context, type_)
    if owner is None:
        return None
    for class_ in context.world.symbols.lineage(owner.name):
        for name, base in context.world.symbols.bases(class_):
            if base is None:
                return context.world.types.imported(class_.cpp, name)
    return None


# --- containers -----------------------------------------------------------------------------------


def _container(
    context: Context, of: Value, name: str, nodes: Sequence[Node], place: Span
) -> Value | None:
    element = _element_type(of.type)
    is_sequence = isinstance(of.type, t.Array | t.Text) or (
        isinstance(of.type, t.Container) and of.type.kind is t.ContainerKind.SEQUENCE
    )
    if name == "at" and len(nodes) == 1:
        return _at(context, of, nodes[0], place)
    if name == "front" and not nodes:
        return _indexed(of, 0, element, place)
    if name == "back" and not nodes and is_sequence:
        return _indexed(of, -1, element, place)
    if name == "size" and isinstance(of.type, t.Array):
        return Value(e.Literal(of.type.length, SIZE, place=place), SIZE)
    if name in ("emplace_back", "emplace", "emplace_front") and is_sequence:
        return _emplaced(context, of, element, name, nodes, place)
    if name in _PUTTING and element is not None:
        return _put(context, of, element, name, nodes, place)
    if name in _EMPTYING and (not nodes or name == "reserve"):
        callee = s.LibraryCallee(f"{library_class(of.type)}::{name}", of.expression)
        arguments = library_arguments(context, nodes, place, is_pure=True)
        return stored_result(context, callee, arguments, Declared(t.NOTHING), place)
    return None


def _element_type(type_: t.Type) -> t.Type | None:
    match type_:
        case t.Container(t.ContainerKind.MAPPING):
            return None
        case t.Container(_, (element, *_)) | t.Array(element, _):
            return element
        case t.Text():
            return t.Integer(8)
        case _:
            return None


def _indexed(of: Value, index: int, element: t.Type | None, place: Span) -> Value | None:
    if element is None:
        return None
    at = e.Literal(index, t.Integer(64), place=place)
    found = e.Index(of.expression, at, element, False, index < 0, False, place)
    return Value(found, element, of.is_lvalue)


def _at(context: Context, of: Value, node: Node, place: Span) -> Value | None:
    """`v.at(i)`, which fails where there is no such element."""
    index = lower_value(context, node)
    if isinstance(of.type, t.Container) and of.type.kind is t.ContainerKind.MAPPING:
        element = of.type.elements[1]
        at = element_value(context, of.type.elements[0], node)
    else:
        found = _element_type(of.type)
        if found is None or not isinstance(index.type, t.Integer):
            return None
        element, at = found, index.expression
    entry = e.Index(of.expression, at, element, False, False, True, place)
    return Value(entry, element, of.is_lvalue)


def _put(
    context: Context, of: Value, element: t.Type, name: str, nodes: Sequence[Node], place: Span
) -> Value | None:
    """Elements that are put into a container are copies."""
    if isinstance(of.type, t.Text) and name != "push_back":
        return None
    is_set = isinstance(of.type, t.Container) and of.type.kind is t.ContainerKind.SET
    if len(nodes) != 1 or (name == "insert" and not is_set) or name in ("assign", "resize"):
        return None
    value = element_value(context, element, nodes[0])
    callee = s.LibraryCallee(f"{library_class(of.type)}::{name}", of.expression)
    arguments = (s.CallArgument(value),)
    return stored_result(context, callee, arguments, Declared(t.NOTHING), place)


def _emplaced(
    context: Context,
    of: Value,
    element: t.Type | None,
    name: str,
    nodes: Sequence[Node],
    place: Span,
) -> Value | None:
    """`v.emplace_back(a, b)`: an element that is constructed of the arguments."""
    if element is None:
        return None
    made = context.temporary(element, place)
    by_arguments(context, made, element, nodes, place)
    put = name.replace("emplace", "push")
    callee = s.LibraryCallee(f"{library_class(of.type)}::{put}", of.expression)
    context.emit(s.Call(None, callee, (s.CallArgument(made),), place))
    at_end = Value(of.expression, of.type, is_lvalue=True)
    return _indexed(at_end, -1 if put.endswith("back") else 0, element, place)


# --- optionals, pointers, atomics -----------------------------------------------------------------


def _optional(
    context: Context, of: Value, inner: t.Type, name: str, nodes: Sequence[Node], place: Span
) -> Value | None:
    match name:
        case "has_value":
            test = e.Convert(Conversion.TRUTH, of.expression, t.TRUTH, False, place)
            return Value(test, t.TRUTH)
        case "value":
            return dereferenced(of.expression, inner, place)
        case "reset":
            return assign(context, of, Value(e.Literal(None, t.NOTHING), t.NOTHING), place)
        case "emplace":
            made = context.temporary(inner, place)
            by_arguments(context, made, inner, nodes, place)
            return assign(context, of, Value(made, inner), place)
        case _:
            return None


def _pointer(
    context: Context, of: Value, type_: t.Reference, name: str, nodes: Sequence[Node], place: Span
) -> Value | None:
    """Methods of smart pointers."""
    if type_.ownership is t.Ownership.NONE:
        if name == "get" and not nodes:  # a pointer has no members: it is a `reference_wrapper`
            return dereferenced(of.expression, type_.to, place)
        raise Unlowered("a member function of a pointer")
    if name == "get" and not nodes:
        raw = t.Reference(type_.to, True)
        return Value(e.Convert(Conversion.CAST, of.expression, raw, False, place), raw)
    owns = class_of(context, type_.to) is not None
    if name == "reset" and not nodes and not owns:
        return assign(context, of, Value(e.Literal(None, t.NOTHING), t.NOTHING), place)
    return None


def _atomic(context: Context, of: Value, name: str, nodes: Sequence[Node], place: Span) -> Value:
    """Methods of `std::atomic`, which is lowered as the value that it holds."""
    operator: dict[str, str] = {
        "fetch_add": "+",
        "fetch_sub": "-",
        "fetch_or": "|",
        "fetch_and": "&",
    }
    if name == "load" and not nodes:
        return Value(of.expression, of.type)
    if name == "store" and nodes:
        assign(context, of, lower_value(context, nodes[0]), place)
        return Value(e.Literal(None, t.NOTHING, place=place), t.NOTHING)
    if name in operator or name == "exchange":
        value = lower_value(context, nodes[0])
        before = context.temporary(of.type, place)
        context.emit(s.Assign(before, of.expression, place))
        if name == "exchange":
            assign(context, of, value, place)
        else:
            compound(context, operator[name], of, value, place)
        return Value(before, of.type)
    if name == "get" and not nodes and of.is_lvalue:
        return of  # what a `reference_wrapper` in a pair refers to
    raise Unlowered("a member function of a number")
