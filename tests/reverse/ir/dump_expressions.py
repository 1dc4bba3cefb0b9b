"""Expressions of the intermediate form as text.

A `?` marks what may be up to the classes of operands: `a +? b`, `self?.speed`.
"""

from __future__ import annotations

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.dump_types import dump_type
from rebsync.reverse.ir.operators import Operator
from rebsync.unions import assert_never


def dump_expression(expression: e.Expression) -> str:
    """An expression on one line, as a whole."""
    match expression:
        case e.Literal(value, _, _):
            return "none" if value is None else repr(value)
        case e.Local(name):
            return name
        case e.Temporary(number):
            return f"${number}"
        case e.Captured(function, name):
            return f"{function}^{name}"
        case e.Global(module, name):
            return f"{module}::{name}"
        case e.ClassReference(name):
            return f"class {name}"
        case e.ModuleReference(name):
            return f"module {name}"
        case e.LibraryReference(name):
            return f"library {name}"
        case e.FunctionReference(name):
            return f"function {name}"
        case e.Closure(function, captures, defaults):
            return _closure(function, captures, defaults)
        case e.Attribute() | e.Index() | e.Dereference() | e.AddressOf() | e.Slice():
            return _place(expression)
        case e.Unary() | e.Binary() | e.And() | e.Or() | e.Conditional():
            return _operation(expression)
        case _:
            return _new_value(expression)


def _place(
    expression: e.Attribute | e.Index | e.Dereference | e.AddressOf | e.Slice,
) -> str:
    """A part of an object, or what a reference leads to."""
    match expression:
        case e.Attribute(target, name):
            return f"{_inner(target)}{_mark(expression.dynamic)}.{name}"
        case e.Index(target, index):
            start = "" if expression.from_end else "+"
            mark = _mark(expression.dynamic)
            return f"{_inner(target)}{mark}[{start}{dump_expression(index)}]"
        case e.Dereference(reference):
            return f"*{_mark(expression.dynamic)}{_inner(reference)}"
        case e.AddressOf(place):
            return f"&{_inner(place)}"
        case e.Slice(low, high, step):
            return ":".join("" if p is None else dump_expression(p) for p in (low, high, step))
        case _:
            assert_never(expression)


def _operation(
    expression: e.Unary | e.Binary | e.And | e.Or | e.Conditional,
) -> str:
    """What operators make of values."""
    match expression:
        case e.Unary(operator, operand):
            space = " " if operator.value.isalpha() else ""
            return f"{operator.value}{_mark(expression.dynamic)}{space}{_inner(operand)}"
        case e.Binary(operator, left, right):
            sign = f"{dump_operator(operator, expression.dynamic)}{_width(expression.type)}"
            return f"{_inner(left)} {sign} {_inner(right)}"
        case e.And(left, right):
            return f"{_inner(left)} and{_mark(expression.dynamic)} {_inner(right)}"
        case e.Or(left, right):
            return f"{_inner(left)} or{_mark(expression.dynamic)} {_inner(right)}"
        case e.Conditional(test, then, otherwise):
            mark = _mark(expression.dynamic)
            return f"{_inner(test)} ?{mark} {_inner(then)} : {_inner(otherwise)}"
        case _:
            assert_never(expression)


def _new_value(
    expression: e.Convert | e.Copy | e.Move | e.Build | e.BuildMapping | e.BuildRecord | e.Format,
) -> str:
    """A value that is converted, copied or built."""
    match expression:
        case e.Convert(conversion, operand, type_):
            mark = _mark(expression.dynamic)
            return f"{conversion.value}{mark}<{dump_type(type_)}>({dump_expression(operand)})"
        case e.Copy(operand):
            return f"copy({dump_expression(operand)})"
        case e.Move(operand):
            return f"move({dump_expression(operand)})"
        case e.Build(type_, elements):
            inner = ", ".join(map(_element, elements))
            return f"new {dump_type(type_)}({inner})"
        case e.BuildMapping(type_, entries):
            inner = ", ".join(
                _element(n)
                if isinstance(n, e.Spread)
                else f"{dump_expression(n[0])}: {dump_expression(n[1])}"
                for n in entries
            )
            return f"new {dump_type(type_)}({inner})"
        case e.BuildRecord(type_, fields):
            inner = ", ".join(f"{name}={dump_expression(value)}" for name, value in fields)
            return f"new {type_.name}({inner})"
        case e.Format(pieces):
            return f"format{_mark(expression.dynamic)}({', '.join(map(_piece, pieces))})"
        case _:
            assert_never(expression)


def dump_operator(operator: Operator, dynamic: bool) -> str:
    """An operator between two values."""
    return f"{operator.value}{_mark(dynamic)}"


def _width(type_: t.Type) -> str:
    """How wide the result is, where that bounds it."""
    match type_:
        case t.Integer(int()) | t.Float(32):
            return f"<{dump_type(type_)}>"
        case _:
            return ""


def _mark(dynamic: bool) -> str:
    return "?" if dynamic else ""


_WITH_SPACES = (e.Unary, e.Binary, e.And, e.Or, e.Conditional, e.Build, e.BuildMapping)


def _inner(expression: e.Expression) -> str:
    text = dump_expression(expression)
    return f"({text})" if isinstance(expression, _WITH_SPACES) else text


def _element(element: e.Expression | e.Spread) -> str:
    if isinstance(element, e.Spread):
        return f"*{_inner(element.operand)}"
    return dump_expression(element)


def _piece(piece: e.FormatPiece) -> str:
    style = "" if piece.style is None else f" as {dump_expression(piece.style)}"
    return f"{dump_expression(piece.value)}{piece.conversion}{style}"


def _closure(
    function: str, captures: tuple[e.Capture, ...], defaults: tuple[tuple[str, e.Expression], ...]
) -> str:
    taken = [f"{'&' if c.by_reference else '='}{dump_expression(c.variable)}" for c in captures]
    values = [f"{name}={dump_expression(value)}" for name, value in defaults]
    inner = ", ".join([*taken, *values])
    return f"closure {function}{f' [{inner}]' if inner else ''}"
