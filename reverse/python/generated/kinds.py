"""The types that expressions of the model have, for variables of Python that are given none."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from functools import reduce
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.analysis.intervals.writes import is_own, own, variable_of
from rebsync.reverse.syntax.py_tree import field, named, text_of
from rebsync.source import NOWHERE, Span

_INT, _FLOAT, _DOUBLE, _BOOLEAN = map(m.Type, ("int", "float", "double", "boolean"))
_REALS = _DOUBLE, _FLOAT  # one of which makes the other numbers of an operation one
_INTEGERS = frozenset({"byte", "short", "int"})
_FLOATING = frozenset({"float", "double"})
_TIMES = frozenset({"now", *(f"currentMessage{n}" for n in ("Arrival", "Deadline", "WaitingTime"))})
_TESTS = frozenset({"<", "<=", ">", ">=", "==", "!=", "&&", "||"})

_MADE = dict.fromkeys(("int8", "int16", "int32", "divide", "remainder", "abs", "len"), _INT)
_MADE |= {"bool": _BOOLEAN, "any": _BOOLEAN, "all": _BOOLEAN, "float64": _DOUBLE}

Known: TypeAlias = Callable[[str], "m.Type | None"]


def kind_of(expression: m.Expression, known: Known, results: Mapping[str, m.Type]) -> m.Type | None:
    """The widest type of the kind of an expression's value; None where it cannot be told.

    A variable of Python holds any integer and numbers of 64 bits, so that it is an `int` or a
    `double` whatever is stored in it.
    """
    return _widest(type_of(expression, known, results))


def type_of(expression: m.Expression, known: Known, results: Mapping[str, m.Type]) -> m.Type | None:
    """The type in which the model computes an expression; None where it cannot be told.

    `known` tells those of variables, by `self.x` of those that others hide, `results` those of
    functions.
    """

    def of(inner: m.Expression) -> m.Type | None:
        return type_of(inner, known, results)

    match expression:
        case m.IntLiteral():
            return _INT
        case m.FloatLiteral(text):
            return _DOUBLE if text[-1] in "dD" else _FLOAT
        case m.BoolLiteral() | m.Unary("!") | m.InstanceOf():
            return _BOOLEAN
        case m.Paren(inner) | m.Unary(_, inner) | m.Postfix(_, inner) | m.Assign(_, inner):
            return of(inner)
        case m.Name(name) if name in _TIMES and known(name) is None:
            return _INT
        case m.Name(name):
            return known(name)
        case m.Member(m.Self(), name):
            return known(own(name))
        case m.Index(target):
            return _element(target, known)
        case m.Cast(type_):
            return type_
        case m.Call(None, "pow" | "sqrt" as name) if name not in results:
            return _DOUBLE
        case m.Call(None, name):
            return results.get(name)
        case m.Choice(options):
            return reduce(_joined, map(of, options))
        case m.Binary(operator) if operator in _TESTS:
            return _BOOLEAN
        case m.Conditional(_, one, other) | m.Binary(_, one, other):
            types = of(one), of(other)
            return next((real for real in _REALS if real in types), _joined(*types))
        case _:
            return None


def float_literal(text: str, span: Span = NOWHERE) -> m.FloatLiteral:
    """A number of the code, of 64 bits where 32 do not hold it."""
    value = float(text.replace("_", ""))
    try:
        (single,) = struct.unpack("f", struct.pack("f", value))
    except OverflowError:
        single = None
    return m.FloatLiteral(text if single == value else f"{text}d", span)


def literal_kind(node: Node, variables: Known) -> m.Type | None:
    """What an expression of Python is by its text; `variables` are those of the object."""
    match node.type:
        case "integer":
            return _INT
        case "float":
            return _DOUBLE
        case "true" | "false" | "comparison_operator" | "not_operator":
            return _BOOLEAN
        case "parenthesized_expression" if len(named(node)) == 1:
            return literal_kind(named(node)[0], variables)
        case "boolean_operator" | "binary_operator":
            sides = (literal_kind(field(node, side), variables) for side in ("left", "right"))
            return _joined(*sides)
        case "conditional_expression":
            then, _, otherwise = named(node)
            return _joined(literal_kind(then, variables), literal_kind(otherwise, variables))
        case "call":
            return _MADE.get(text_of(field(node, "function")))
        case "attribute":
            return _widest(variables(text_of(field(node, "attribute"))))
        case "subscript":
            holder = field(node, "value")
            type_ = variables(text_of(field(holder, "attribute")))
            return _widest(m.Type(type_.name)) if type_ and len(type_.dimensions) == 1 else None
        case _:
            return None


def is_floating(type_: m.Type | None) -> bool:
    """Whether values of a type have a fraction."""
    return type_ is not None and type_.name in _FLOATING and not type_.dimensions


def _element(target: m.Expression, known: Known) -> m.Type | None:
    depth = 1
    while isinstance(target, m.Index):
        target, depth = target.target, depth + 1
    name = variable_of(target) or ""
    type_ = known(own(name) if is_own(target) else name)
    if type_ is None or len(type_.dimensions) != depth:
        return None
    return m.Type(type_.name)


def is_kind(type_: m.Type, kind: m.Type | None) -> bool:
    """Whether a variable of a type may hold values of a kind, as `kind_of` tells it."""
    widest = _widest(type_)
    return widest is not None and kind in (None, widest)


def _widest(type_: m.Type | None) -> m.Type | None:
    if type_ is None or type_.dimensions or type_.name == "void":
        return None
    if type_.name in _INTEGERS:
        return _INT
    return _DOUBLE if type_.name in _FLOATING else m.Type(type_.name)


def _joined(left: m.Type | None, right: m.Type | None) -> m.Type | None:
    """The type of what is one of two."""
    one, other = _widest(left), _widest(right)
    if left == right or one == other:
        return left if left == right else one
    return _DOUBLE if {one, other} == {_INT, _DOUBLE} else None
