"""Expressions of the model made from others, in parentheses where they need them; declarations."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from rebsync import model as m
from rebsync import precedence
from rebsync.source import NOWHERE, Span

_OPPOSITE = {"==": "!=", "!=": "==", "<": ">=", ">=": "<", ">": "<=", "<=": ">"}
_DIVIDING = frozenset({"/", "%", "/=", "%="})
_MATHEMATICS = frozenset({"pow", "sqrt"})


def tight(expression: m.Expression, least: int) -> m.Expression:
    """The expression where only what binds at least so tightly may stand."""
    return m.Paren(expression) if precedence.binding(expression) < least else expression


def binary(
    operator: str, left: m.Expression, right: m.Expression, span: Span = NOWHERE
) -> m.Binary:
    """`left operator right`."""
    level = precedence.BINARY[operator]
    return m.Binary(operator, tight(left, level), tight(right, level + 1), span)


def chosen(condition: m.Expression, then: m.Expression, otherwise: m.Expression) -> m.Conditional:
    """`condition ? then : otherwise`."""
    return m.Conditional(tight(condition, precedence.CHAIN), then, otherwise)


def selected(
    asked: m.Expression, values: dict[int, m.Expression], otherwise: m.Expression
) -> m.Expression:
    """The value by a number that is asked; another one if it has none."""
    for number, value in reversed(values.items()):
        otherwise = chosen(binary("==", asked, m.IntLiteral(number)), value, otherwise)
    return otherwise


def cast(type_: m.Type, operand: m.Expression) -> m.Cast:
    """`(type) operand`."""
    return m.Cast(type_, tight(operand, precedence.CAST))


def negated(condition: m.Expression) -> m.Expression:
    """What is true where the condition is false."""
    match bare(condition):
        case m.Unary("!", operand):
            return bare(operand)
        case m.Choice():
            return condition
        case m.BoolLiteral(value):
            return m.BoolLiteral(not value)
        case m.Binary(operator, left, right, span) if operator in ("==", "!="):
            return m.Binary(_OPPOSITE[operator], left, right, span)
        case other:
            return m.Unary("!", tight(other, precedence.PREFIX))


def bare(expression: m.Expression) -> m.Expression:
    """The expression without parentheses around it."""
    while isinstance(expression, m.Paren):
        expression = expression.inner
    return expression


def number_literal(value: int) -> m.Expression:
    """A whole number as an expression."""
    return m.IntLiteral(value) if value >= 0 else m.Unary("-", m.IntLiteral(-value))


def located(expression: m.Expression, span: Span) -> m.Expression:
    """The expression with its place in the code, if it has none yet."""
    if isinstance(expression, m.Paren):
        return replace(expression, inner=located(expression.inner, span))
    return expression if expression.span != NOWHERE else replace(expression, span=span)


def is_calm(expression: m.Expression) -> bool:
    """Whether evaluating it changes nothing, and gives the same again if done twice."""
    for node in m.walk(expression):
        match node:
            case m.Assign() | m.Postfix() | m.Unary(operator="++" | "--") | m.Choice():
                return False
            case m.Call(target, name) if target is not None or name not in _MATHEMATICS:
                return False
    return True


def may_divide_by_zero(expression: m.Expression) -> bool:
    """Whether evaluating it may divide by zero, as far as its divisors are no numbers."""
    for node in m.walk(expression):
        match node:
            case m.Binary(operator, _, by) | m.Assign(operator, _, by) if operator in _DIVIDING:
                if not _is_nonzero(bare(by)):
                    return True
    return False


def _is_nonzero(expression: m.Expression) -> bool:
    match expression:
        case m.IntLiteral(number):
            return number != 0
        case m.FloatLiteral():
            return True  # of floats no quotient ends a program
        case m.Unary("-" | "+", operand):
            return _is_nonzero(bare(operand))
        case m.Binary("*", left, right):
            return _is_nonzero(bare(left)) and _is_nonzero(bare(right))
        case _:
            return False


def is_idle(expression: m.Expression) -> bool:
    """Whether it may be left out where nobody looks at its value."""
    return is_calm(expression) and not may_divide_by_zero(expression)


def is_effect(expression: m.Expression) -> bool:
    """Whether it is one that stands as a statement: an assignment or a call."""
    match bare(expression):
        case m.Assign() | m.Postfix() | m.Unary(operator="++" | "--") | m.Call():
            return True
        case _:
            return False


def is_place(expression: m.Expression) -> bool:
    """Whether it is a variable or an element of one."""
    match bare(expression):
        case m.Name() | m.Member():
            return True
        case m.Index(array):
            return is_place(array)
        case _:
            return False


def is_default(expression: m.Expression) -> bool:
    """Whether it is what state variables hold before they are given anything."""
    match bare(expression):
        case m.IntLiteral(0) | m.BoolLiteral(False):
            return True
        case m.FloatLiteral(text):
            return float(text) == 0
        case _:
            return False


def is_plain(expression: m.Expression) -> bool:
    """Whether it is a literal or a name, which cost nothing to repeat."""
    match bare(expression):
        case m.Name() | m.IntLiteral() | m.FloatLiteral() | m.BoolLiteral():
            return True
        case m.Member(m.Self()):
            return True
        case m.Unary("-", m.IntLiteral() | m.FloatLiteral()):
            return True
        case _:
            return False


def cell(axis: str, offset: m.Expression) -> m.Expression:
    """`X`, `X + 1`, `X - 1` for an offset."""
    match offset:
        case m.IntLiteral(0):
            return m.Name(axis)
        case m.Unary("-", operand):
            return m.Binary("-", m.Name(axis), operand)
        case _:
            return m.Binary("+", m.Name(axis), offset)


def whole_number(expression: m.Expression | None) -> int | None:
    """The number that a literal stands for, with its sign; None of all else."""
    match expression:
        case m.IntLiteral(value):
            return value
        case m.Unary("-", m.IntLiteral(value)):
            return -value
        case _:
            return None


def declarations(variables: Iterable[tuple[str, m.Type]]) -> tuple[m.Declaration, ...]:
    """Variables, each declared by itself and without a value."""
    return tuple(m.Declaration(type_, (m.Declarator(name),)) for name, type_ in variables)


def mentioned(variables: Mapping[str, m.Type], nodes: Sequence[m.Node]) -> dict[str, m.Type]:
    """The variables that some body names."""
    if not variables:
        return {}
    names = set()
    for node in nodes:
        for inner in m.walk(node):
            match inner:
                case m.Name(name) | m.Member(m.Self(), name):
                    names.add(name)
    return {n: t for n, t in variables.items() if n in names}
