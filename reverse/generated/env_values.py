"""Values that constants of the model have: in launch files, and as defaults in C++."""

from __future__ import annotations

import re
from math import prod

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import INTEGERS
from rebsync.package import Value
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.syntax.cpp_numerals import numeral
from rebsync.reverse.syntax.cpp_tree import named, text_of
from rebsync.static.values import converted

_ENV_MARKER = re.compile(r"# *rebsync: env (?P<type>[a-z]+)(?P<lengths>(?:\[\d+\])*) (?P<name>\S+)")

_NAME = re.compile(r"[./]")


def plain_value(parameter: Parameter) -> Value | None:
    """The value of a parameter, if the model has such values."""
    return _listed(parameter.value)


def _listed(value: object) -> Value | None:
    match value:
        case bool() | int() | float() | str():
            return value
        case tuple():
            inner = [_listed(v) for v in value]
            return None if None in inner else tuple(v for v in inner if v is not None)
        case _:
            return None


def constant(node: Node) -> Value | None:
    """A constant of C++: a number, a truth value, or nested braces."""
    text = text_of(node)
    match node.type:
        case "true" | "false":
            return text == "true"
        case "number_literal":
            number = numeral(text)
            return number.value if number is not None else None
        case "initializer_list":
            values = named(node)
            if len(values) == 1 and values[0].type == "initializer_list":
                values = named(values[0])
            inner = [constant(v) for v in values]
            return None if None in inner else tuple(v for v in inner if v is not None)
        case _:
            return -0x80000000 if text == "INT32_MIN" else None


def shaped(value: Value, lengths: tuple[int, ...]) -> Value:
    """An array of several dimensions whose values stand one after the other, as in ROS 2."""
    if not isinstance(value, tuple) or len(lengths) < 2 or any(isinstance(v, tuple) for v in value):
        return value
    step = prod(lengths[1:])
    rows = (value[i : i + step] for i in range(0, len(value), step))
    return tuple(shaped(row, lengths[1:]) for row in rows)


def as_type(value: Value, type_: m.Type) -> Value:
    """A value as one of a declared type."""
    match value:
        case tuple():
            inner = m.Type(type_.name, type_.dimensions[1:])
            return tuple(as_type(v, inner) for v in value)
        case str():
            return value
        case _:
            return converted(value, type_)


def value_in_all(key: str, default: Value | None, launch: Launch) -> Value | None:
    """What a constant is in all nodes that a launch file starts; None where that is not known."""
    common = [p for p in launch.parameters if p.name.lstrip("/").removeprefix("env/") == key]
    every = (*launch.parameters, *(p for node in launch.nodes for p in node.parameters))
    found = {plain_value(p) for p in every if _NAME.split(p.name)[-1] == _NAME.split(key)[-1]}
    if not common:
        found.add(default)
    return found.pop() if len(found) == 1 and not launch.unknowns else None


def is_taken(value: Value, type_: m.Type, widens: bool) -> bool:
    """Whether code that asks for a type takes a value as it is.

    roscpp gives the fallback for a value of another type, or rounds it, a node of rclcpp or rclpy
    dies by it. `widens`: a whole number is taken where a decimal one is asked for, as in ROS 1.
    """
    match value:
        case tuple():
            return all(is_taken(v, type_, widens) for v in value)
        case bool():
            return type_.name == "boolean"
        case int():
            return type_.name in INTEGERS or (widens and type_.name in ("float", "double"))
        case float():
            return type_.name in ("float", "double")
        case _:
            return type_.name not in (*INTEGERS, "boolean", "float", "double")


def marked_type(parameter: Parameter) -> tuple[m.Type, str] | None:
    """Type and name from the marker beside a parameter: `key: 0  # rebsync: env byte name`."""
    source = parameter.source
    line = source.line(source.position(parameter.span.start).line)
    match = _ENV_MARKER.search(line)
    if match is None:
        return None
    lengths = tuple(int(n) for n in re.findall(r"\d+", match["lengths"]))
    return m.Type(match["type"], lengths), match["name"]


def type_of_value(value: Value) -> m.Type:
    """The type of a parameter that no class reads."""
    match value:
        case tuple():
            inner = type_of_value(value[0]) if value else m.Type("int")
            return m.Type(inner.name, (len(value), *inner.dimensions))
        case bool():
            return m.Type("boolean")
        case float():
            return m.Type("double")
        case _:
            return m.Type("int")
