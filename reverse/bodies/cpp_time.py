"""Times and durations of ROS and C++ as whole numbers of the model's unit of time."""

from __future__ import annotations

from fractions import Fraction

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_mailbox import has_mailbox
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.bodies.types.cpp_widths import check_whole
from rebsync.reverse.findings import NotWhole, Unread
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.libraries.tables.standard import SLEEPS, SUFFIXES, UNITS
from rebsync.reverse.models.building import binary, cast
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.constants import constant
from rebsync.static.types import DOUBLE, is_integer

_SECOND = Fraction(1)
_FOR_EVER = 10**15  # of any unit
_OTHER_CLOCK = "this clock is not the time of the model, at which a message server stands still"


def time_called(
    reader: CppExpressionReader, node: Node, name: str, arguments: list[Node]
) -> m.Expression | None:
    """`ros::Time::now()`, `ros::Duration(0.5)`, `std::chrono::milliseconds(20)`."""
    if not arguments and (
        name in libraries.names_of(Kind.CLOCK) or (name == "now" and is_flat(reader))
    ):
        if has_mailbox(reader.scope):
            raise Unread(reader.cpp.span(node), _OTHER_CLOCK, "ask the mailbox: mailbox_.now()")
        return m.Name("now", reader.cpp.span(node))
    seconds = seconds_of(name)
    if seconds is None:
        return None
    match arguments:
        case []:
            return m.IntLiteral(0, reader.cpp.span(node))
        case [only]:
            return units(reader, only, seconds)
        case [whole, nanoseconds] if seconds == _SECOND:
            of_two = (
                units(reader, whole, seconds),
                units(reader, nanoseconds, UNITS["nanoseconds"]),
            )
            return binary("+", *of_two)
        case _:
            return None


def is_flat(reader: CppExpressionReader) -> bool:
    """Whether the code may use a library whose nodes and clocks have a method `now`."""
    return libraries.is_flat(reader.cpp.data)


def written(reader: CppExpressionReader, node: Node) -> m.Expression | None:
    """`500ms`; None for a literal that is no span of time."""
    if node.type != "user_defined_literal":
        return None
    inner = named(node)
    suffix = text_of(inner[1]) if len(inner) == 2 else ""
    if suffix not in SUFFIXES:
        return None
    return units(reader, inner[0], SUFFIXES[suffix])


def seconds_of(name: str) -> Fraction | None:
    """The seconds that a number in a span of time means, by the name of the span's type."""
    if "chrono" in name:
        return UNITS.get(name.rpartition("::")[2])
    plain = name.removeprefix("::")
    return _SECOND if plain in libraries.seconds() else UNITS.get(plain)


def units(reader: CppExpressionReader, node: Node, seconds: Fraction) -> m.Expression:
    """So many seconds, times the number that a node is, in units of the model's time."""
    value = reader.read(node)
    check_whole(reader, node)
    whole = in_units(reader, value, seconds)
    if whole is None:
        span, unit = reader.cpp.span(node), reader.scope.unit
        why = f"this is no whole number of units of {float(unit):g} s that the model's time has"
        hint = "choose a time_unit in rebsync.toml of which it is a multiple"
        number = constant(value)
        if isinstance(number, int | float) and abs(number) < _FOR_EVER:
            raise NotWhole(span, why, hint, Fraction(str(number)) * seconds)
        raise Unread(span, why, hint)
    return whole


def in_units(
    reader: CppExpressionReader, value: m.Expression, seconds: Fraction
) -> m.Expression | None:
    """The same for a value of the model; None where it need not be whole."""
    factor = seconds / reader.scope.unit
    number = constant(value)
    if number is not None:
        if not abs(number) < _FOR_EVER:
            return None
        exact = Fraction(str(number)) * factor if not isinstance(number, bool) else Fraction(number)
        return _whole(exact)
    of = type_in(reader.scope, value)
    if isinstance(value, m.Cast) and value.type == DOUBLE:
        return in_units(reader, value.operand, seconds)
    if of is None or not is_integer(of) or factor.denominator != 1:
        return None
    return value if factor == 1 else binary("*", value, m.IntLiteral(int(factor)))


def _whole(number: Fraction) -> m.Expression | None:
    if number.denominator != 1 or abs(number) >= 2**31:
        return None
    return m.IntLiteral(int(number)) if number >= 0 else m.Unary("-", m.IntLiteral(-int(number)))


def to_seconds(reader: CppExpressionReader, target: Node) -> m.Expression | None:
    """`duration.toSec()`: units of the model's time as seconds; None for what is no time."""
    value = reader.read(target)
    of = type_in(reader.scope, value)
    if of is None or not is_integer(of):
        return None
    unit = reader.scope.unit
    if unit == 1:
        return cast(DOUBLE, value)
    if unit.numerator == 1:
        return binary("/", cast(DOUBLE, value), m.FloatLiteral(f"{unit.denominator}.0d"))
    return binary("*", cast(DOUBLE, value), m.FloatLiteral(f"{float(unit)}d"))


def pause(reader: CppExpressionReader, call: Node) -> m.Expression | None:
    """How long a call sleeps: `ros::Duration(1.0).sleep()`; None for one that does not."""
    if call.type != "call_expression":
        return None
    function = part(call, "function")
    if function.type == "field_expression":
        return _own_pause(reader, part(function, "argument"), text_of(part(function, "field")))
    text = text_of(function)
    name = text.rpartition("::")[2]
    unit = _SECOND if text in libraries.names_of(Kind.SLEEP, result="seconds") else SLEEPS.get(name)
    arguments = named(part(call, "arguments"))
    if len(arguments) != 1:
        return None
    if name == "sleep_for":
        return reader.read(arguments[0])
    if unit is None or text in reader.scope.functions:
        return None
    return units(reader, arguments[0], unit)


def _own_pause(reader: CppExpressionReader, target: Node, name: str) -> m.Expression | None:
    if name != "sleep":
        return None
    if target.type == "call_expression":
        return reader.read(target)
    meaning = resolve(reader.scope, target)
    return reader.read(target) if isinstance(meaning, Variable) else None
