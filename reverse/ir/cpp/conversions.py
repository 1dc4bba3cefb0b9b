"""Conversions that C++ makes without saying so (C++17 [conv], [expr.arith.conv])."""

from __future__ import annotations

from dataclasses import replace

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.types import INT, STRING
from rebsync.reverse.ir.operators import Conversion
from rebsync.source import Span

_EXACT = {64: 53, 32: 24}  # bits of whole numbers that a float holds


def is_arithmetic(type_: t.Type) -> bool:
    """Whether values are numbers or truths, by the standard's word."""
    return isinstance(type_, t.Integer | t.Float | t.Truth)


def holds(type_: t.Integer, value: int) -> bool:
    """Whether an integer type has a value."""
    low, high = limits(type_)
    return low <= value <= high


def limits(type_: t.Integer) -> tuple[int, int]:
    """The least and the greatest value of an integer type of some bits."""
    bits = type_.bits or 64
    return (-(1 << bits - 1), (1 << bits - 1) - 1) if type_.signed else (0, (1 << bits) - 1)


def wrapped(type_: t.Integer, value: int) -> int:
    """A value modulo two to the bits of a type."""
    bits = type_.bits or 64
    value %= 1 << bits
    return value - (1 << bits) if type_.signed and value >> bits - 1 else value


def promoted(type_: t.Type) -> t.Type:
    """Integral promotion ([conv.prom]): what is narrower than an `int` becomes one.

    A scoped enumeration is not promoted; callers ask only for what C++ promotes.
    """
    match type_:
        case t.Truth():
            return INT
        case t.Integer(int(bits), signed) if bits < 32 or (bits == 32 and signed):
            return INT
        case t.Enumeration(_, underlying):
            return promoted(underlying)
        case _:
            return type_


def common_type(left: t.Type, right: t.Type) -> t.Type:
    """Usual arithmetic conversions ([expr.arith.conv])."""
    left, right = promoted(left), promoted(right)
    if isinstance(left, t.Float) or isinstance(right, t.Float):
        bits = [type_.bits for type_ in (left, right) if isinstance(type_, t.Float)]
        return t.Float(max(bits))
    if not isinstance(left, t.Integer) or not isinstance(right, t.Integer):
        return t.UNKNOWN
    wide = max(left.bits or 64, right.bits or 64)
    if left.signed == right.signed:
        return t.Integer(wide, left.signed)
    unsigned = right if left.signed else left
    return t.Integer(wide, signed=(unsigned.bits or 64) < wide)


def converted(value: e.Expression, from_: t.Type, to: t.Type, place: Span) -> e.Expression | None:
    """A value as one of another type, by the standard conversions; None if there is none."""
    if from_ == to or to == t.UNKNOWN:
        return value
    match to:
        case t.Truth():
            return _to_truth(value, from_, place)
        case t.Integer():
            return _to_integer(value, from_, to, place)
        case t.Float():
            return _to_float(value, from_, to, place)
        case t.Enumeration():
            if from_ == t.UNKNOWN:
                return e.Convert(Conversion.CAST, value, to, True, place)
            return None
        case t.Text():
            if isinstance(from_, t.Reference) and from_.to == t.Integer(8):
                return e.Convert(Conversion.TEXT, value, to, False, place)
            if from_ == t.Integer(8):  # the text of one character
                return e.Convert(Conversion.CAST, value, to, False, place)
        case t.Reference():
            return _to_reference(value, from_, to, place)
        case t.Optional(of):
            if from_ == t.NOTHING:
                return e.Literal(None, to, place=place)
            inner = converted(value, from_, of, place)
            return None if inner is None else e.Convert(Conversion.WIDEN, inner, to, False, place)
        case t.FunctionType():
            if isinstance(from_, t.FunctionType):
                return value
    return e.Convert(Conversion.CAST, value, to, True, place) if from_ == t.UNKNOWN else None


def _to_truth(value: e.Expression, from_: t.Type, place: Span) -> e.Expression | None:
    if isinstance(value, e.Literal) and isinstance(value.value, int | float):
        return e.Literal(bool(value.value), t.TRUTH, value.text, place)
    if isinstance(from_, t.Integer | t.Float | t.Enumeration | t.Reference | t.FunctionType):
        return e.Convert(Conversion.TRUTH, value, t.TRUTH, False, place)
    if isinstance(from_, t.Optional):
        return e.Convert(Conversion.TRUTH, value, t.TRUTH, False, place)
    if from_ == t.UNKNOWN or isinstance(from_, t.Record):
        return e.Convert(Conversion.TRUTH, value, t.TRUTH, True, place)
    return None


def _to_integer(
    value: e.Expression, from_: t.Type, to: t.Integer, place: Span
) -> e.Expression | None:
    match from_:
        case t.Integer():
            return _between_integers(value, from_, to, place)
        case t.Truth():
            if isinstance(value, e.Literal):
                return e.Literal(int(bool(value.value)), to, value.text, place)
            return e.Convert(Conversion.WIDEN, value, to, False, place)
        case t.Enumeration(_, underlying):
            number = e.Convert(Conversion.CAST, value, underlying, False, place)
            return _between_integers(number, underlying, to, place)
        case t.Float():
            return e.Convert(Conversion.TRUNCATE, value, to, False, place)
        case t.Unknown():
            whole = e.Convert(Conversion.TRUNCATE, value, t.UNBOUNDED, True, place)
            return e.Convert(Conversion.WRAP, whole, to, True, place)
        case _:
            return None


def _between_integers(
    value: e.Expression, from_: t.Integer, to: t.Integer, place: Span
) -> e.Expression:
    if from_ == to:
        return value
    if isinstance(value, e.Literal) and isinstance(value.value, int):
        return replace(value, value=wrapped(to, value.value), type=to)
    low, high = limits(from_)
    fits = holds(to, low) and holds(to, high)
    conversion = Conversion.WIDEN if fits else Conversion.WRAP
    return e.Convert(conversion, value, to, False, place)


def _to_float(value: e.Expression, from_: t.Type, to: t.Float, place: Span) -> e.Expression | None:
    if isinstance(value, e.Literal) and isinstance(value.value, int | float) and to.bits == 64:
        return e.Literal(float(value.value), to, value.text, place)
    match from_:
        case t.Float(bits):
            conversion = Conversion.WIDEN if bits <= to.bits else Conversion.NARROW
        case t.Integer(bits):
            is_exact = (bits or 64) - from_.signed <= _EXACT[to.bits]
            conversion = Conversion.WIDEN if is_exact else Conversion.NARROW
        case t.Truth():
            conversion = Conversion.WIDEN
        case t.Enumeration(_, underlying):
            number = e.Convert(Conversion.CAST, value, underlying, False, place)
            return _to_float(number, underlying, to, place)
        case t.Unknown():
            return e.Convert(Conversion.NARROW, value, to, True, place)
        case _:
            return None
    return e.Convert(conversion, value, to, False, place)


def _to_reference(
    value: e.Expression, from_: t.Type, to: t.Reference, place: Span
) -> e.Expression | None:
    is_zero = isinstance(value, e.Literal) and value.value == 0
    if from_ == t.NOTHING or (is_zero and isinstance(from_, t.Integer)):
        return e.Literal(None, to, "nullptr", place)
    if isinstance(from_, t.Text) and to.to == t.Integer(8):
        return e.Convert(Conversion.CAST, value, to, False, place)
    if isinstance(from_, t.Array) and from_.element == to.to:
        return e.Convert(Conversion.CAST, value, to, False, place)
    if isinstance(from_, t.Reference):
        return e.Convert(Conversion.CAST, value, to, False, place)
    if from_ == t.UNKNOWN:
        return e.Convert(Conversion.CAST, value, to, True, place)
    return None


def rank(from_: t.Type, to: t.Type) -> int | None:
    """How good a conversion is ([over.ics.scs]): 0 exact, 1 promotion, 2 conversion, 3 of a class.

    None where there is none, or where the types are not known well enough.
    """
    if from_ == to:
        return 0
    if t.UNKNOWN in (from_, to):
        return None
    if is_arithmetic(from_) or isinstance(from_, t.Enumeration):
        if promoted(from_) == to or (from_ == t.Float(32) and to == t.DOUBLE):
            return 1
        return 2 if is_arithmetic(to) else 3 if isinstance(to, t.Optional) else None
    if from_ == STRING and isinstance(to, t.Reference):
        return 1 if to.to == t.Integer(8) else None
    if isinstance(from_, t.Reference):
        return 2 if isinstance(to, t.Reference | t.Truth) else 3 if to == STRING else None
    if isinstance(from_, t.FunctionType) and isinstance(to, t.FunctionType):
        return 3
    return None
