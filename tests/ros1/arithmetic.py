"""A small interpreter of statements, written from the meaning of the model, not from the code.

Arithmetic is 32-bit after C's promotions, wraps, and goes from left to right; values narrow when
they are stored, passed or cast; integer division by zero and a wrong index abandon the body.
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass, field
from typing import TypeAlias

from rebsync import model as m

Number: TypeAlias = "int | float | bool"
Value: TypeAlias = "Number | list[Number]"

_BITS = {"byte": 8, "short": 16, "int": 32}
_RANK = {"int": 0, "float": 1, "double": 2}


class Abandoned(Exception):
    """The body breaks a rule of the model."""


class Undefined(Exception):
    """A result that the meaning leaves open: infinite, or too large for an integer."""


@dataclass
class State:
    """Variables with their declared types; arrays are lists."""

    types: dict[str, str]
    values: dict[str, Value] = field(default_factory=dict)


def run(statement: m.Statement, state: State) -> None:
    """Executes a statement."""
    match statement:
        case m.Block(statements):
            for inner in statements:
                run(inner, state)
        case m.ExpressionStatement(expression):
            evaluate(expression, state)
        case m.If(condition, then, otherwise):
            if evaluate(condition, state)[1]:
                run(then, state)
            elif otherwise is not None:
                run(otherwise, state)
        case _:
            raise NotImplementedError(statement)


def evaluate(node: m.Expression, state: State) -> tuple[str, Number]:
    """The type in C and the value of an expression."""
    match node:
        case m.IntLiteral(value):
            return "int", value
        case m.BoolLiteral(truth):
            return "boolean", truth
        case m.FloatLiteral(text):
            return "float", convert(float(text), "float")
        case m.Paren(inner):
            return evaluate(inner, state)
        case m.Name() | m.Index():
            place = _Place.of(node, state)
            return place.type, place.value
        case m.Cast(type_, operand):
            return type_.name, convert(evaluate(operand, state)[1], type_.name)
        case m.Unary("++" | "--" as operator, operand):
            return _step(operator, _Place.of(operand, state), prefix=True)
        case m.Postfix(operator, operand):
            return _step(operator, _Place.of(operand, state), prefix=False)
        case m.Unary(operator, operand):
            return _unary(operator, evaluate(operand, state))
        case m.Binary("&&" | "||" as operator, left, right):
            first = bool(evaluate(left, state)[1])
            return "boolean", (
                bool(evaluate(right, state)[1]) if first == (operator == "&&") else first
            )
        case m.Binary(operator, left, right):
            one = evaluate(left, state)
            return operate(operator, one, evaluate(right, state))
        case m.Conditional(condition, then, otherwise):
            chosen = then if evaluate(condition, state)[1] else otherwise
            return evaluate(chosen, state)
        case m.Assign(operator, target, assigned):
            return _assign(operator, target, assigned, state)
        case m.Call(None, "sqrt", (operand,)):
            return "double", math.sqrt(evaluate(operand, state)[1])
        case _:
            raise NotImplementedError(node)


@dataclass
class _Place:
    """Where a value is stored; an index is evaluated once."""

    type: str
    name: str
    state: State
    index: int | None = None

    @staticmethod
    def of(node: m.Expression, state: State) -> _Place:
        match node:
            case m.Paren(inner):
                return _Place.of(inner, state)
            case m.Name(name):
                return _Place(state.types[name], name, state)
            case m.Index(m.Name(name), index):
                position = evaluate(index, state)[1]
                values = state.values[name]
                assert isinstance(values, list)
                if not 0 <= position < len(values):
                    raise Abandoned
                return _Place(state.types[name], name, state, int(position))
            case _:
                raise NotImplementedError(node)

    @property
    def value(self) -> Number:
        held = self.state.values[self.name]
        if isinstance(held, list):
            assert self.index is not None
            return held[self.index]
        return held

    def store(self, value: Number) -> Number:
        narrowed = convert(value, self.type)
        held = self.state.values[self.name]
        if isinstance(held, list):
            assert self.index is not None
            held[self.index] = narrowed
        else:
            self.state.values[self.name] = narrowed
        return narrowed


def _step(operator: str, place: _Place, *, prefix: bool) -> tuple[str, Number]:
    before = place.value
    after = place.store(before + (1 if operator == "++" else -1))
    return place.type, after if prefix else before


def _assign(
    operator: str, target: m.Expression, assigned: m.Expression, state: State
) -> tuple[str, Number]:
    place = _Place.of(target, state)
    if operator == "=":
        return place.type, place.store(evaluate(assigned, state)[1])
    before = place.type, place.value
    result = operate(operator[:-1], before, evaluate(assigned, state))
    return place.type, place.store(result[1])


def _unary(operator: str, operand: tuple[str, Number]) -> tuple[str, Number]:
    type_, value = operand
    if operator == "!":
        return "boolean", not value
    promoted = "int" if type_ in _BITS else type_
    if operator == "~":
        return promoted, ~int(value)
    return promoted, convert(-value if operator == "-" else value, promoted)


def operate(
    operator: str, left: tuple[str, Number], right: tuple[str, Number]
) -> tuple[str, Number]:
    """A binary operator on two values that have been evaluated."""
    if left[0] == "boolean":
        a, b = bool(left[1]), bool(right[1])
        return "boolean", {"&": a & b, "|": a | b, "^": a ^ b, "==": a == b, "!=": a != b}[operator]
    type_ = max((_promoted(left[0]), _promoted(right[0])), key=_RANK.__getitem__)
    one, other = convert(left[1], type_), convert(right[1], type_)
    compared = {
        "<": one < other,
        "<=": one <= other,
        ">": one > other,
        ">=": one >= other,
        "==": one == other,
        "!=": one != other,
    }
    if operator in compared:
        return "boolean", compared[operator]
    return type_, convert(_arithmetic(operator, one, other, type_ == "int"), type_)


def _promoted(type_: str) -> str:
    return "int" if type_ in _BITS else type_


def _arithmetic(operator: str, a: Number, b: Number, whole: bool) -> Number:
    match operator:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return a * b
        case "/" | "%" if b == 0:
            raise Abandoned if whole else Undefined
        case "/" if not whole:
            return a / b
        case "/":
            return int(a) // int(b) if (a < 0) == (b < 0) else -(abs(int(a)) // abs(int(b)))
        case "%":
            return int(math.copysign(abs(int(a)) % abs(int(b)), a))
        case "<<":
            return int(a) << (int(b) & 31)
        case ">>":
            return int(a) >> (int(b) & 31)
        case "&":
            return int(a) & int(b)
        case "|":
            return int(a) | int(b)
        case "^":
            return int(a) ^ int(b)
        case _:
            raise NotImplementedError(operator)


def convert(value: Number, type_: str) -> Number:
    """A value as one of the type: wrapped, or rounded."""
    if type_ == "boolean":
        return bool(value)
    if type_ in _BITS:
        if isinstance(value, float):
            if not abs(value) < 2**31 - 1:
                raise Undefined
            value = int(value)
        half = 1 << (_BITS[type_] - 1)
        return (int(value) + half) % (2 * half) - half
    number = float(value)
    if type_ == "float":
        if abs(number) > 3e38:
            raise Undefined
        number = float(struct.unpack("f", struct.pack("f", number))[0])
    if not math.isfinite(number) or abs(number) > 1e300:
        raise Undefined
    return number
