"""The values of objects that code makes: texts, node handles, spans of time, and others."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, Under, Unresolved
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.values.cpp_evaluator import CppEvaluator
from rebsync.reverse.values.cpp_values_names import name_under, spoken, tidy
from rebsync.reverse.values.cpp_values_numbers import converted, used
from rebsync.reverse.values.cpp_values_plain import (
    NUMBERS,
    Found,
    Frame,
    Handle,
    Length,
    Made,
    Nothing,
    Use,
    Value,
    choice,
    each,
    pairs,
)
from rebsync.reverse.values.cpp_values_ros2 import made, unset

_TEXTS = frozenset({"string", "String"})


def constructed(values: CppEvaluator, type_: str, use: Use, frame: Frame) -> Value:
    """An object of a type, made of arguments in a frame."""
    name = type_.rpartition("::")[2]
    given = use.arguments
    if name in libraries.handles():
        return _handle(values, given, frame)
    if (of_ros2 := made(values, type_, use, frame)) is not None:
        return of_ros2
    if name in libraries.spans():
        return _span(values, given, frame)
    if name in libraries.rates():
        return each(_cycle, values.value(given[0], frame)) if given else Nothing()
    if name in _TEXTS and type_ in ("std::string", "string"):
        if not given:
            return ""
        return values.value(given[0], frame) if len(given) == 1 else _part(values, use, frame)
    if name == "vector" and given:
        return _vector(values, use, frame)
    if name == "function" and len(given) == 1:
        return values.value(given[0], frame)
    if name in NUMBERS:
        return converted(values.value(given[0], frame), name) if len(given) == 1 else Nothing()
    if len(given) == 1:
        copied = values.value(given[0], frame)
        if isinstance(copied, Made) and copied.type == type_:
            return copied
    return Made(type_, use, frame)


def _vector(values: CppEvaluator, use: Use, frame: Frame) -> Value:
    """`std::vector<T>(count, element)`, or one of elements in braces."""
    found = [values.value(g, frame) for g in use.arguments]
    if use.node.type == "call_expression":
        match found:
            case [int() as count, (bool() | int() | float() | str()) as element] if count < 1000:
                return (element,) * count
            case [tuple() as copied]:
                return copied
            case _:
                return values.unknown("a list that is not known", use.node, frame)
    plain = [v for v in found if isinstance(v, (bool, int, float, str, tuple))]
    if len(plain) == len(found):
        return tuple(plain)
    return values.unknown("a list that is not known", use.node, frame)


def _part(values: CppEvaluator, use: Use, frame: Frame) -> Value:
    return values.unknown("a text made of others", use.node, frame)


def default_of(values: CppEvaluator, type_: str, node: Node, frame: Frame) -> Value:
    """What a variable of a type holds that is declared without a value."""
    if type_.rpartition("::")[2] in libraries.handles():
        return Handle("")
    if not type_ or type_ in NUMBERS or type_ in ("std::string", "string"):
        return Nothing()
    if (quality := unset(type_)) is not None:
        return quality
    name = type_.rpartition("::")[2]
    if values.texts.class_near(name, frame.cpp) is None and not name.endswith("Options"):
        return Nothing()
    return Made(type_, Use(frame.cpp, node, (), frame.function), frame)


# --- node handles -------------------------------------------------------------------------------


def _handle(values: CppEvaluator, given: tuple[Node, ...], frame: Frame) -> Value:
    if not given:
        return Handle("")
    first = values.value(given[0], frame)
    if len(given) == 1:
        return each(_handle_of, first)
    second = values.value(given[1], frame)
    return pairs(_nested, first, second)


def _handle_of(value: Value) -> Value:
    match value:
        case Handle() | Nothing():
            return value
        case str():
            return Handle(tidy(spoken(value)))
        case Found(name):
            return Handle(name)
        case FromParameter() | Unresolved() | Under():
            return Handle(name_under("", value))
        case _:
            return Nothing()


def _nested(first: Value, second: Value) -> Value:
    match first, second:
        case Handle(namespace), (str() | FromParameter() | Unresolved() | Under()):
            return Handle(name_under(namespace, second)) if second != "" else first
        case Handle(), _:
            return first
        case _:
            return _handle_of(first)


# --- time ---------------------------------------------------------------------------------------


def _span(values: CppEvaluator, given: tuple[Node, ...], frame: Frame) -> Value:
    if not given:
        return Length(0.0)
    found = each(_seconds, values.value(given[0], frame))
    if len(given) == 1:
        return found
    return pairs(_with_nanoseconds, found, values.value(given[1], frame))


def _seconds(value: Value) -> Value:
    match value:
        case Length() | Nothing():
            return value
        case bool() | int() | float():
            return Length(float(value))
        case FromParameter():
            seconds = converted(value, "double")
            return Length(seconds if isinstance(seconds, FromParameter) else value)
        case Unresolved():
            return Length(value)
        case _:
            return Nothing()


def _with_nanoseconds(span: Value, nanoseconds: Value) -> Value:
    match span, nanoseconds:
        case Length(float() as seconds), (int() | float()):
            return Length(seconds + nanoseconds * 1e-9)
        case _:
            return span


def _cycle(value: Value) -> Value:
    """The cycle of a rate that is given in hertz, or as a span of time."""
    match value:
        case Length() | Nothing():
            return value
        case int() | float() if value:
            return Length(1 / value, each=True)
        case FromParameter():
            return Length(used(value, "1/value", _inverse), each=True)
        case Unresolved():
            return Length(value, each=True)
        case _:
            return choice([])


def _inverse(value: Value) -> Value:
    return 1 / value if isinstance(value, (int, float)) and value else Nothing()
