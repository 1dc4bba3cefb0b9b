"""Calls whose values the model has: of functions of the node, of Python, and of the clock."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync import model as m
from rebsync import precedence
from rebsync.intervals import unsigned
from rebsync.literals import exact_literal_of
from rebsync.reverse.bodies.building import bare, binary, chosen, is_calm, tight, whole_number
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import NotWhole, Unread
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.python import body_timers
from rebsync.reverse.python.body_arguments import arguments
from rebsync.reverse.python.body_effects import is_harmless, is_still
from rebsync.reverse.python.body_scope import (
    REAL,
    STRING,
    TRUTH,
    WHOLE,
    Frame,
    Nobody,
    Value,
    unknown,
)
from rebsync.reverse.python.py_callbacks import body_of
from rebsync.reverse.python.py_index import Scope, arguments_of, has_splat, last_name
from rebsync.reverse.python.py_tree import field, named, text_of
from rebsync.reverse.unknowns import Open

if TYPE_CHECKING:
    from rebsync.reverse.python.body_expression_reader import BodyExpressionReader

_MOST = 64


def called(reader: BodyExpressionReader, node: Node) -> Value:
    """What a call gives."""
    function = field(node, "function")
    own = reader.reading.function(function, reader.frame)
    if own is not None:
        return value_of_method(reader, own, node)
    stopped = body_timers.is_stopped(reader.reading, node, reader.frame)
    if stopped is not None:
        return Value(stopped, TRUTH)
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
    if name.startswith("random."):
        found = _random(reader, name.removeprefix("random."), plain, node)
        if found is not None:
            return found
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
        case "bool", [only]:
            return Value(reader.condition(only), TRUTH)
        case "int", [only]:
            value = reader.read(only)
            if value.kind == WHOLE:
                return value
            if value.kind == TRUTH:
                return _as_number(value)
            raise unknown(reader.frame, node, "whether its int holds this number")
        case "str", [only]:
            value = reader.read(only)
            return value if value.kind == STRING and not value.mixed else None
        case "float", [only]:
            value = reader.read(only)
            if value.kind == TRUTH:
                value = _as_number(value)
            return Value(reader.real(value, node), REAL)
        case "abs", [only]:
            value = reader.read(only)
            if value.kind in (TRUTH, STRING) or not is_calm(value.expression):
                return None
            zero = exact_literal_of(0 if value.kind == WHOLE else 0.0)
            if value.kind == WHOLE:
                reader.need(value, node, "abs")
            less = binary("<", value.expression, zero)
            minus = m.Unary("-", tight(value.expression, precedence.PREFIX))
            return Value(chosen(less, minus, value.expression), value.kind, value.single)
        case (("min" | "max"), [first, *others]) if others:
            best = reader.read(first)
            for other in others:
                best = _better(reader, name, best, reader.read(other), node)
            return best
        case _:
            return None


def _as_number(value: Value) -> Value:
    return Value(chosen(value.expression, m.IntLiteral(1), m.IntLiteral(0)), WHOLE)


def _better(
    reader: BodyExpressionReader, name: str, best: Value, other: Value, node: Node
) -> Value:
    """Of two numbers the lesser or greater; of equal ones Python takes the first."""
    calm = is_calm(best.expression) and is_calm(other.expression)
    if STRING in (best.kind, other.kind):
        raise unknown(reader.frame, node, "which text comes first")
    if not calm or TRUTH in (best.kind, other.kind):
        raise Unread(reader.frame.span(node), f'"{name}" of these is not read')
    kind = best.kind if best.kind == other.kind else REAL
    if kind == REAL:
        one, two = reader.real(best, node), reader.real(other, node)
    else:
        one, two = reader.need(best, node, "one"), reader.need(other, node, "other")
    sign = "<" if name == "min" else ">"
    return Value(chosen(binary(sign, two, one), two, one), kind)


def _random(
    reader: BodyExpressionReader, name: str, arguments: list[Node], node: Node
) -> Value | None:
    """A number drawn from some that are known."""
    span = reader.frame.span(node)
    match name, arguments:
        case "randint", [low, high]:
            bounds = [bare(reader.read(n).expression) for n in (low, high)]
            first, last = (whole_number(b) for b in bounds)
            if first is None or last is None or not first <= last < first + _MOST:
                return None
            options = tuple(exact_literal_of(n) for n in range(first, last + 1))
            return Value(m.Choice(options, span) if len(options) > 1 else options[0], WHOLE)
        case "choice", [listed] if listed.type in ("list", "tuple"):
            values = [reader.read(n) for n in named(listed)]
            kinds = {v.kind for v in values}
            if len(kinds) != 1:
                return None
            return Value(m.Choice(tuple(v.expression for v in values), span), kinds.pop())
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


def value_of_method(reader: BodyExpressionReader, own: Scope, call: Node) -> Value:
    """The value of a function that only computes it from what it is given."""
    span = reader.frame.span(call)
    body = body_of(own)
    if is_still(reader.reading, own):
        quiet = all(is_harmless(reader.reading, n, reader.frame) for n in _given(call))
        if quiet and not (len(body) == 1 and body[0].type == "return_statement"):
            raise Unknown(span, f'the model cannot know what "{own.name}" gives', "")
    if len(body) != 1 or body[0].type != "return_statement" or own.decorators:
        raise Unread(span, f'the value of "{own.name}" is not read')
    inner = Frame(own, server=reader.frame.server, outer=reader.frame)
    for parameter, node, given in arguments(own, call, span):
        if node is None or not given:
            ways = reader.reading.values.ways(node, own) if node is not None else ()
            inner.bound[parameter.name] = reader.reading.constant(ways) or Nobody()
            continue
        value = reader.read(node)
        if not is_calm(value.expression):
            raise Unread(span, f'the value of "{own.name}" is not read')
        inner.bound[parameter.name] = value
    returned = named(body[0])
    if has_splat(call):
        raise Unread(span, "what stars unpack into the arguments is not read")
    if not returned or inner.scope.node.id in reader.running:
        raise Unread(span, f'the value of "{own.name}" is not read')
    running = (*reader.running, own.node.id)
    return type(reader)(reader.reading, inner, reader.within, running).read(returned[0])


def _given(call: Node) -> list[Node]:
    plain, keywords = arguments_of(call)
    return [*plain, *keywords.values()]
