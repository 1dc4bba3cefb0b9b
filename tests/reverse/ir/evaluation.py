"""Evaluates expressions of the intermediate form on the values of Python itself.

Where a lowering says that no class has a say (`dynamic=False`), or of which type a value is, it is
held to that.
"""

from __future__ import annotations

import importlib
import math
import operator as op
import struct
from collections.abc import Callable
from dataclasses import field
from typing import Any, TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Conversion, Operator
from rebsync.reverse.ir.program import Function
from tests.reverse.ir.memory import Object, Pointer

# Any value of Python.
Value: TypeAlias = Any
PLAIN = (bool, int, float, complex, str, bytes, type(None), Object, Pointer)


@dataclass(eq=False, slots=True)
class Frame:
    """One call of a function: its variables, and the frames of the functions around it."""

    function: Function
    around: dict[str, Frame]
    locals: dict[str, Value] = field(default_factory=dict)
    temporaries: dict[int, Value] = field(default_factory=dict)


def _truncate(left: int, right: int) -> int:
    quotient = abs(left) // abs(right)
    return quotient if (left < 0) == (right < 0) else -quotient


def _classic(left: Value, right: Value) -> Value:
    whole = isinstance(left, int) and isinstance(right, int)
    return left // right if whole else left / right


BINARY: dict[Operator, Callable[[Value, Value], Value]] = {
    Operator.ADD: op.add,
    Operator.SUBTRACT: op.sub,
    Operator.MULTIPLY: op.mul,
    Operator.MATRIX_MULTIPLY: op.matmul,
    Operator.TRUE_DIVIDE: op.truediv,
    Operator.CLASSIC_DIVIDE: _classic,
    Operator.FLOOR_DIVIDE: op.floordiv,
    Operator.TRUNCATING_DIVIDE: _truncate,
    Operator.FLOOR_MODULO: op.mod,
    Operator.TRUNCATING_REMAINDER: lambda a, b: a - b * _truncate(a, b),
    Operator.POWER: op.pow,
    Operator.SHIFT_LEFT: op.lshift,
    Operator.SHIFT_RIGHT: op.rshift,
    Operator.BIT_AND: op.and_,
    Operator.BIT_OR: op.or_,
    Operator.BIT_XOR: op.xor,
    Operator.EQUAL: op.eq,
    Operator.UNEQUAL: op.ne,
    Operator.LESS: op.lt,
    Operator.LESS_EQUAL: op.le,
    Operator.GREATER: op.gt,
    Operator.GREATER_EQUAL: op.ge,
    Operator.SAME: op.is_,
    Operator.NOT_SAME: op.is_not,
    Operator.IN: lambda a, b: a in b,
    Operator.NOT_IN: lambda a, b: a not in b,
}
UNARY: dict[Operator, Callable[[Value], Value]] = {
    Operator.NEGATE: op.neg,
    Operator.PLUS: op.pos,
    Operator.INVERT: op.invert,
    Operator.NOT: op.not_,
}
CONVERSIONS: dict[Conversion, Callable[[Value], Value]] = {
    Conversion.TRUNCATE: math.trunc,
    Conversion.TRUTH: bool,
    Conversion.TEXT: str,
}


def wrapped(value: Value, type_: t.Type) -> Value:
    """A value as one of a type: numbers that it does not hold wrap."""
    if isinstance(type_, t.Integer) and type_.bits is not None:
        value &= (1 << type_.bits) - 1
        return value - (1 << type_.bits) if type_.signed and value >> (type_.bits - 1) else value
    if isinstance(type_, t.Float) and type_.bits == 32:
        return struct.unpack("f", struct.pack("f", value))[0]
    return value


def converted(conversion: Conversion, value: Value, type_: t.Type) -> Value:
    """A value made one of a type."""
    found = CONVERSIONS.get(conversion, lambda v: v)(value)
    if isinstance(type_, t.Float) and isinstance(found, int):
        found = float(found)
    elif isinstance(type_, t.Integer) and isinstance(found, bool):
        found = int(found)
    elif isinstance(type_, t.Text) and isinstance(found, int):
        found = chr(found)
    result = wrapped(found, type_)
    assert conversion is not Conversion.WIDEN or result == value, f"{value!r} is lost in {type_}"
    return result


_CHECKS: dict[type, type | tuple[type, ...]] = {
    t.Integer: int,
    t.Float: float,
    t.Truth: bool,
    t.Text: (str, bytes),
    t.UnitType: type(None),
}


def check(value: Value, type_: t.Type) -> None:
    """Fails if a value is not of the type that a lowering says."""
    kind = _CHECKS.get(type(type_))
    assert kind is None or isinstance(value, kind), f"{value!r} is no {type_}"


def plain(dynamic: bool, *values: Value) -> None:
    """Fails if a class may have a say where a lowering says that none has."""
    assert dynamic or all(type(v) in PLAIN for v in values), f"{values!r} have operators"


class Evaluator:
    """Expressions of a program; `globals` are the variables of its modules."""

    def __init__(self) -> None:
        self.globals: dict[str, dict[str, Value]] = {}
        self.classes: dict[str, Value] = {}
        self.defining: dict[str, dict[str, Value]] = {}

    def note(self, kind: str, holder: Value, name: Value) -> None:
        """Told of each read and write of what functions may share."""

    def closure(self, expression: e.Closure, frame: Frame) -> Value:
        raise NotImplementedError

    def module(self, name: str) -> Value:
        raise NotImplementedError

    def eval(self, expression: e.Expression, frame: Frame) -> Value:
        value = self._eval(expression, frame)
        if type_ := getattr(expression, "type", None):
            check(value, type_)
        return value

    def _eval(self, expression: e.Expression, frame: Frame) -> Value:
        match expression:
            case e.Literal(value):
                return value
            case e.Local(name):
                if name not in frame.locals:
                    raise UnboundLocalError(name)
                return frame.locals[name]
            case e.Temporary(number):
                return frame.temporaries[number]
            case e.Captured(function, name):
                self.note("read captured", function, name)
                if name not in frame.around[function].locals:
                    raise NameError(name)
                return frame.around[function].locals[name]
            case e.Global(module, name):
                return self.global_(module, name)
            case e.ClassReference(name):
                return self.defining.get(name, self.classes.get(name))
            case e.ModuleReference(name):
                return self.module(name)
            case e.LibraryReference(name):
                return library(name)
            case e.Closure():
                return self.closure(expression, frame)
            case e.Attribute(holder, name):
                return self.attribute(self.eval(holder, frame), name)
            case e.Index(holder, index):
                container = self.eval(holder, frame)
                key = self.eval(index, frame)
                self.note("read element", container, key)
                return container[key]
            case e.Slice(low, high, step):
                parts = (low, high, step)
                return slice(*(None if p is None else self.eval(p, frame) for p in parts))
            case _:
                return self._operation(expression, frame)

    def _operation(self, expression: e.Expression, frame: Frame) -> Value:
        match expression:
            case e.Unary(operator, operand):
                value = self.eval(operand, frame)
                is_container = isinstance(value, list | dict | set | tuple)
                plain(expression.dynamic or is_container, value)
                return wrapped(UNARY[operator](value), expression.type)
            case e.Binary(operator, left, right):
                first, second = self.eval(left, frame), self.eval(right, frame)
                by_identity = operator in (Operator.SAME, Operator.NOT_SAME)
                plain(expression.dynamic or by_identity, first, second)
                return wrapped(BINARY[operator](first, second), expression.type)
            case e.And(left, right):
                first = self.eval(left, frame)
                return self.eval(right, frame) if self.truth(first, expression.dynamic) else first
            case e.Or(left, right):
                first = self.eval(left, frame)
                return first if self.truth(first, expression.dynamic) else self.eval(right, frame)
            case e.Conditional(test, then, otherwise):
                holds = self.truth(self.eval(test, frame), expression.dynamic)
                return self.eval(then if holds else otherwise, frame)
            case e.Convert(conversion, operand, type_):
                value = self.eval(operand, frame)
                plain(expression.dynamic, value)
                return converted(conversion, value, type_)
            case e.Build(type_, elements):
                return self._build(type_, elements, frame)
            case e.BuildMapping(_, entries):
                found: dict[Value, Value] = {}
                for entry in entries:
                    if isinstance(entry, e.Spread):
                        found.update(self.eval(entry.operand, frame))
                    else:
                        key = self.eval(entry[0], frame)
                        found[key] = self.eval(entry[1], frame)
                return found
            case e.Format(pieces):
                return "".join(self._piece(p, expression.dynamic, frame) for p in pieces)
            case _:
                raise NotImplementedError(expression)

    def _build(self, type_: t.Type, elements: tuple[Value, ...], frame: Frame) -> Value:
        values: list[Value] = []
        for element in elements:
            if isinstance(element, e.Spread):
                values.extend(self.eval(element.operand, frame))
            else:
                values.append(self.eval(element, frame))
        assert isinstance(type_, t.Container)
        made = {t.ContainerKind.TUPLE: tuple, t.ContainerKind.SET: set}.get(type_.kind, list)
        return made(values)

    def _piece(self, piece: e.FormatPiece, dynamic: bool, frame: Frame) -> str:
        value = self.eval(piece.value, frame)
        plain(dynamic, value)
        shown: dict[str, Callable[[Value], str]] = {"!r": repr, "!s": str, "!a": ascii}
        if piece.conversion:
            value = shown[piece.conversion](value)
        style = "" if piece.style is None else self.eval(piece.style, frame)
        return format(value, style)

    def truth(self, value: Value, dynamic: bool) -> bool:
        """Whether a value counts as true."""
        plain(dynamic or isinstance(value, list | dict | set | tuple), value)
        return bool(value)

    def attribute(self, holder: Value, name: str) -> Value:
        """A member of an object, a class, or a class that is being defined."""
        if any(holder is space for space in self.defining.values()):
            if name not in holder:
                raise NameError(name)
            return holder[name]
        self.note("read attribute", holder, name)
        return getattr(holder, name)

    def global_(self, module: str, name: str) -> Value:
        """A variable of a module, or a builtin where it has none."""
        self.note("read global", module, name)
        if name in self.globals[module]:
            return self.globals[module][name]
        try:
            return library(f"builtins.{name}")
        except AttributeError:
            raise NameError(name) from None


def library(name: str) -> Value:
    """What a library has under a full name."""
    first, *rest = name.split(".")
    found: Value = importlib.import_module(first)
    path = first
    for part in rest:
        path += f".{part}"
        if not hasattr(found, part):
            try:
                importlib.import_module(path)
            except ImportError:
                raise AttributeError(path) from None
        found = getattr(found, part)
    return found
