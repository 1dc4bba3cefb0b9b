"""Calls whose values the model has: of functions of the node, of Python, and of the clock."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import unsigned
from rebsync.reverse.findings import NotWhole, Unread
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.python.bodies import body_functions, body_timers
from rebsync.reverse.python.bodies.body_expression_reader import BodyExpressionReader
from rebsync.reverse.python.bodies.body_scope import unknown
from rebsync.reverse.python.expressions import functions
from rebsync.reverse.python.expressions.tables import looked_up
from rebsync.reverse.python.expressions.values import REAL, STRING, TRUTH, WHOLE, Value, as_number
from rebsync.reverse.syntax.py_index import arguments_of, last_name
from rebsync.reverse.syntax.py_tree import field, text_of
from rebsync.reverse.unknowns import Open


def called(reader: BodyExpressionReader, node: Node) -> Value:
    """What a call gives."""
    function = field(node, "function")
    own = reader.reading.function(function, reader.frame)
    if own is not None:
        return body_functions.value_of_call(reader, own, node)
    stopped = body_timers.is_stopped(reader.reading, node, reader.frame)
    if stopped is not None:
        return Value(stopped, TRUTH)
    found = functions.called(reader, node) or looked_up(reader, node)
    if found is not None:
        return found
    name = reader.reading.external(function, reader.frame)
    plain, keywords = arguments_of(node)
    if name.startswith("builtins.") and not keywords:
        found = _builtin(reader, name.removeprefix("builtins."), plain, node)
        if found is not None:
            return found
    if name in _clocks() and not plain and reader.reading.second == 1:
        return Value(m.Name("now", reader.frame.span(node)), REAL, True)
    asked = libraries.function(name)
    if asked is not None and asked.kind is Kind.RUNNING:
        return Value(m.BoolLiteral(asked.result == "bool"), TRUTH)
    return parameter(reader, node)


def _clocks() -> frozenset[str]:
    """Functions that give the time in seconds."""
    return libraries.names_of(Kind.CLOCK, result="seconds")


def parameter(reader: BodyExpressionReader, node: Node) -> Value:
    """The value of a parameter, as the node starts with it."""
    reading = reader.reading
    gives = last_name(field(node, "function")) in libraries.giving_parameters()
    if not gives and not any(name in text_of(node) for name in libraries.parameter_methods()):
        raise unknown(reader.frame, node, f'what "{text_of(field(node, "function"))}" gives')
    value = reading.instance.value(reading.values.value(node, reader.frame.scope))
    if isinstance(value, Open):
        raise unknown(reader.frame, node, f"the value of a parameter: {value.why}")
    found = reading.constant((value,))
    if found is None:
        raise unknown(reader.frame, node, "a parameter that is no number and no text")
    return found


# --- Python's own -------------------------------------------------------------------------------


def _builtin(
    reader: BodyExpressionReader, name: str, arguments: list[Node], node: Node
) -> Value | None:
    match name, arguments:
        case "int", [only]:
            known = _rounded(reader, only, int)
            if known is None:
                raise unknown(reader.frame, node, "whether its int holds this number")
            return known
        case "round", [only] if reader.reading.unit.version == 3:
            value = as_number(reader.read(only))
            return value if value.kind == WHOLE else _rounded(reader, only, round)
        case "str", [only]:
            value = reader.read(only)
            return value if value.kind == STRING and not value.mixed else None
        case "float", [only]:
            return Value(reader.real(as_number(reader.read(only)), node), REAL)
        case _:
            return None


def _rounded(
    reader: BodyExpressionReader, node: Node, to_whole: Callable[[float], int]
) -> Value | None:
    """A float that is known as the whole number that Python makes of it."""
    match reader.reading.values.ways(node, reader.frame.scope):
        case (float() as number,) if math.isfinite(number):
            return reader.reading.constant((to_whole(number),))
        case _:
            return None


# --- time ---------------------------------------------------------------------------------------


def units(reader: BodyExpressionReader, node: Node) -> m.Expression:
    """A time in seconds as a whole number of the model's units."""
    reading = reader.reading
    value = reading.instance.seconds(reading.values.value(node, reader.frame.scope))
    if isinstance(value, Open):
        read = reader.read(node)
        if read.kind == WHOLE and reading.second == 1:
            return reader.need(read, node, "time", unsigned(31))
        raise Unread(reader.frame.span(node), f"how long it takes is not known: {value.why}")
    found = value / Fraction(reading.second)
    if found.denominator != 1:
        why = f"{float(value):g} s is no multiple of the model's unit of time"
        raise NotWhole(reader.frame.span(node), why, "set time_unit in rebsync.toml", value)
    return m.IntLiteral(int(found))
