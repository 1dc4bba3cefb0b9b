"""Functions of Python itself, and of `random`, whose values the model says in other words."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync import precedence
from rebsync.intervals import INT32
from rebsync.literals import exact_literal_of
from rebsync.reverse.models.building import bare, binary, negated, tight, whole_number
from rebsync.reverse.python.expressions import elements
from rebsync.reverse.python.expressions.operands import OperandReader
from rebsync.reverse.python.expressions.values import OTHER, REAL, TRUTH, WHOLE, Value
from rebsync.reverse.syntax.py_tree import field, named, text_of
from rebsync.static.constants import constant, float_value, single

_LARGEST = 64  # parts of what is repeated where values are compared
_DRAWN = 64  # numbers, one of which is drawn
_TRUNCATING: Mapping[str, Callable[[float], int]] = {"builtins.int": int, "math.trunc": math.trunc}
_ROUNDING: Mapping[str, Callable[[float], int]] = {
    "builtins.round": round,
    "math.floor": math.floor,
    "math.ceil": math.ceil,
}
_TESTS = {"any": "||", "all": "&&"}


def called(reader: OperandReader, node: Node) -> Value | None:
    """What a function of Python gives; None for another. Unread: the model cannot say it."""
    library = reader.library(field(node, "function"))
    module, _, name = library.rpartition(".")
    arguments = elements.arguments_of(node)
    rounding = {**_TRUNCATING, **(_ROUNDING if reader.rounds_to_whole else {})}
    if library in rounding and len(arguments) == 1:
        value = reader.read(arguments[0])
        return _rounded(value, rounding[library]) or _whole(reader, value, node)
    if module == "random":
        return _drawn(reader, name, arguments, node)
    if module != "builtins":
        return None
    match name, arguments:
        case (("any" | "all"), [given]):
            return Value(_tested(reader, node, name, given), TRUTH)
        case "sum", [given, *start] if len(start) < 2:
            return _summed(reader, node, given, [reader.read(each) for each in start])
        case (("min" | "max"), [given, key]) if key.type == "keyword_argument":
            return _best(reader, node, name, given, key)
        case (("min" | "max"), [given]):
            return _extreme(reader, node, name, elements.certain(reader, given, name))
        case (("min" | "max"), [_, _, *_]):
            return _extreme(reader, node, name, [reader.read(each) for each in arguments])
        case "abs", [given]:
            return _absolute(reader, node, reader.read(given))
        case "bool", [given]:
            return Value(reader.condition(given), TRUTH)
        case "len", [given] if given.type in ("list", "tuple"):
            return Value(m.IntLiteral(len(elements.certain(reader, given, name))), WHOLE)
        case _:
            return None


def _tested(reader: OperandReader, node: Node, name: str, given: Node) -> m.Expression:
    """`any` and `all` of some elements."""
    found: m.Expression | None = None
    for value, condition in elements.elements(reader, given, name):
        each = reader.truth(value, given)
        if condition is not None and name == "any":
            each = binary("&&", condition, each)
        elif condition is not None:
            each = binary("||", negated(condition), each)
        found = each if found is None else binary(_TESTS[name], found, each)
    return m.BoolLiteral(name == "all") if found is None else found


def _summed(reader: OperandReader, node: Node, given: Node, start: Sequence[Value]) -> Value:
    """`sum` of whole numbers: of others Python does not round each step as the model does."""
    zero = Value(m.IntLiteral(0), WHOLE)
    values = [_certainly_whole(reader, each, node) for each in start]
    for value, condition in elements.elements(reader, given, "sum"):
        whole = _certainly_whole(reader, value, node)
        there = whole if condition is None else reader.joined(condition, whole, zero, node)
        values.append(there)
    found = values[0] if values else zero
    for value in values[1:]:
        found = reader.operation("+", found, value, node)
    return found


def _whole(reader: OperandReader, value: Value, node: Node) -> Value | None:
    """A whole number, as which a truth value is 1 or 0; None for another value."""
    if value.kind == TRUTH:
        one, zero = (Value(m.IntLiteral(number), WHOLE) for number in (1, 0))
        return reader.joined(value.expression, one, zero, node)
    return value if value.kind == WHOLE else None


def _rounded(value: Value, to_whole: Callable[[float], int]) -> Value | None:
    """A number with a point, which is written out, as a whole number; None for others."""
    is_written = all(map(_is_written, m.walk(value.expression)))
    number = constant(value.expression) if is_written else None
    if not isinstance(number, float) or abs(number) >= INT32.high:
        return None
    return Value(exact_literal_of(to_whole(number)), WHOLE)


def _is_written(part: m.Node) -> bool:
    """Whether Python computes a part of a literal of 64 bits as `constant` does."""
    match part:
        case m.IntLiteral(number):
            return number <= INT32.high
        case m.FloatLiteral(text):  # one of 32 bits may be rounded to another number
            return text[-1] in "dD" or single(float_value(text)) == float_value(text)
        case m.Binary():
            return isinstance(constant(part), float)
        case _:
            return isinstance(part, m.Paren | m.Unary)


def _certainly_whole(reader: OperandReader, value: Value, node: Node) -> Value:
    if (found := _whole(reader, value, node)) is None:
        raise reader.unread(node, "this is to be a whole number")
    return found


def _absolute(reader: OperandReader, node: Node, value: Value) -> Value:
    kind = value.kind
    if kind not in (WHOLE, REAL) or not reader.is_calm(value):
        raise reader.unread(node, "this is to be a number that is in a variable")
    zero = Value(exact_literal_of(0 if kind == WHOLE else 0.0), kind)
    minus = m.Unary("-", tight(value.expression, precedence.PREFIX))
    below = reader.compared("<", value, zero, node, 0)
    return reader.joined(below, Value(minus, kind), value, node)


def _extreme(reader: OperandReader, node: Node, name: str, values: list[Value]) -> Value:
    """The least or greatest value, of equal ones the first."""
    _check_ordered(reader, node, values)
    if not values or not reader.is_calm(*values):
        raise reader.unread(node, "what this compares is to be in a variable first")
    return _first(reader, node, name, values, lambda value: value)


def _check_ordered(reader: OperandReader, node: Node, values: Sequence[Value]) -> None:
    """Unread: the model does not compare values as Python does."""
    kinds = {value.kind for value in values}
    if kinds - {WHOLE, REAL} or (len(kinds) > 1 and not reader.mixes):
        raise reader.unread(node, "nobody knows which of these is less")


def _first(
    reader: OperandReader,
    node: Node,
    name: str,
    values: list[Value],
    measured: Callable[[Value], Value],
) -> Value:
    """The first value of which what is measured is the least or greatest."""
    found, sign = values[0], "<" if name == "min" else ">"
    for number, value in enumerate(values[1:]):
        if len(list(m.walk(found.expression))) > _LARGEST:
            raise reader.unread(node, "the model compares two values at a time")
        asked = reader.compared(sign, measured(value), measured(found), node, number)
        found = reader.joined(asked, value, found, node)
    return found


def _best(reader: OperandReader, node: Node, name: str, given: Node, key: Node) -> Value:
    """The first value of which a function of it is the least or greatest."""
    function = field(key, "value")
    parameters = function.child_by_field_name("parameters")
    names = [text_of(n) for n in named(parameters)] if parameters is not None else []
    if text_of(field(key, "name")) != "key" or function.type != "lambda" or len(names) != 1:
        raise reader.unread(node, "the model has no such expression")

    def measured(value: Value) -> Value:
        with reader.standing_for(names, [value]):
            read = reader.read(field(function, "body"))
        _check_ordered(reader, node, [read])
        if not reader.is_calm(read):
            raise reader.unread(node, "what this compares is to be in a variable first")
        return read

    values = [value for (value,) in elements.rows(reader, given, 1)]
    if len(values) < 2 and (not values or reader.may_fail(function)):
        raise reader.unread(node, "there is no least or greatest of no values")
    return _first(reader, node, name, values, measured)


def _drawn(reader: OperandReader, name: str, arguments: list[Node], node: Node) -> Value | None:
    """`random.choice([1, 2])` and `random.randint(1, 3)`; None for another call."""
    match name, arguments:
        case "choice", [given] if given.type in ("list", "tuple"):
            return _one_of(reader, elements.certain(reader, given, name), node)
        case ("randint", [_, _]) | ("randrange", [_] | [_, _]):
            ends = [whole_number(bare(reader.read(each).expression)) for each in arguments]
        case _:
            return None
    whole = [end for end in ends if end is not None]
    if len(whole) != len(ends):
        return None
    numbers = range(whole[0], whole[1] + 1) if name == "randint" else range(*whole)
    if not 0 < len(numbers) <= _DRAWN:
        return None
    return _one_of(reader, [Value(exact_literal_of(n), WHOLE) for n in numbers], node)


def _one_of(reader: OperandReader, values: Sequence[Value], node: Node) -> Value | None:
    kinds = {value.kind for value in values}
    if len(kinds) != 1 or (kind := kinds.pop()) == OTHER:
        return None
    options = tuple(value.expression for value in values)
    if any(isinstance(n, m.Name | m.Index) for each in options for n in m.walk(each)):
        raise reader.unread(node, "what is drawn here is to be written out")
    return Value(m.Choice(options, reader.span(node)), kind)
