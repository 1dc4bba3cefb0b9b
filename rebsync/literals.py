"""Constant values as the literals of the model that stand for them."""

from __future__ import annotations

from rebsync import model as m
from rebsync.package import Value


def literal_of(value: Value) -> m.Expression:
    """The shortest literal of a number or truth value; a text is the name of a rebec."""
    match value:
        case bool():
            return m.BoolLiteral(value)
        case int():
            literal = m.IntLiteral(abs(value))
            return literal if value >= 0 else m.Unary("-", literal)
        case float():
            number = m.FloatLiteral(repr(abs(value)))
            return number if str(value)[0] != "-" else m.Unary("-", number)
        case str():
            return m.Name(value)
        case tuple():
            raise ValueError("arrays have no literal")


def exact_literal_of(value: bool | int | float) -> m.Expression:
    """The same, of a float with all its 64 bits."""
    match literal_of(value):
        case m.FloatLiteral(text):
            return m.FloatLiteral(f"{text}d")
        case m.Unary("-", m.FloatLiteral(text)):
            return m.Unary("-", m.FloatLiteral(f"{text}d"))
        case found:
            return found


def initial_of(value: Value) -> m.Initializer:
    """The same for the initial value of a variable, which may be an array."""
    if isinstance(value, tuple):
        return m.ArrayInitializer(tuple(initial_of(v) for v in value))
    return literal_of(value)


def plain_float(digits: str) -> str:
    """A number with digits on both sides of its point and no `+` in its exponent."""
    before, exponent, power = digits.replace("E", "e").partition("e")
    whole, point, rest = before.partition(".")
    rest = f".{rest or '0'}" if point else ""
    return f"{whole or '0'}{rest}{exponent}{power.removeprefix('+')}"
