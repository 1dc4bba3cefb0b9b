"""Expressions in launch and parameter files: arithmetic, comparisons and texts, nothing else.

ROS hands them to Python. Here they are read by Python's parser and worked out node by node, so
that nothing of a file ever runs; what goes beyond arithmetic and texts is open.
"""

from __future__ import annotations

import ast
import math
import operator
import warnings
from collections.abc import Callable, Mapping
from typing import TypeAlias

from rebsync.reverse.unknowns import Open

Scalar: TypeAlias = "bool | int | float | str"
Function: TypeAlias = "Callable[[str], Scalar | Open]"

_LONGEST = 1 << 12
_WIDEST = 1 << 64
_LARGEST_EXPONENT = 64
_BINARY: Mapping[type[ast.operator], Callable[..., object]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
}
_UNARY: Mapping[type[ast.unaryop], Callable[..., object]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
}
_COMPARE: Mapping[type[ast.cmpop], Callable[..., object]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda a, b: operator.contains(b, a),
    ast.NotIn: lambda a, b: not operator.contains(b, a),
}
_CONSTANTS: Mapping[str, Scalar] = {
    **{"true": True, "false": False, "pi": math.pi, "e": math.e},
    **{"tau": math.tau, "inf": math.inf, "nan": math.nan},
}
_CONVERSIONS: Mapping[str, Callable[[Scalar], Scalar]] = {"str": str, "int": int, "float": float}
_MATHS = frozenset(
    {
        *("acos", "asin", "atan", "ceil", "cos", "degrees", "exp", "fabs", "floor", "log", "log10"),
        *("radians", "sin", "sqrt", "tan", "trunc"),
    }
)


class _Stop(Exception):
    """The expression is open; the text says why."""


def evaluate(
    text: str, names: Mapping[str, Scalar | Open], functions: Mapping[str, Function]
) -> Scalar | Open:
    """The value of an expression over these names, and functions of one text."""
    if len(text) > _LONGEST:
        return Open("an expression of this length is not worked out")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text.strip(), mode="eval")
        return _Evaluator(names, functions).value(tree.body)
    except (SyntaxError, ValueError, TypeError, ArithmeticError) as error:
        return Open(f"`{text}` has no value: {error.args[0] if error.args else error}")
    except (RecursionError, MemoryError):
        return Open("an expression nested this deeply is not worked out")
    except _Stop as stop:
        return Open(str(stop))


class _Evaluator:
    def __init__(
        self, names: Mapping[str, Scalar | Open], functions: Mapping[str, Function]
    ) -> None:
        self._names = names
        self._functions = functions

    def value(self, node: ast.expr) -> Scalar:
        match node:
            case ast.Constant(bool() | int() | float() | str() as value):
                return value
            case ast.Name(name):
                return self._name(name)
            case ast.UnaryOp(sign, operand):
                apply = _UNARY.get(type(sign))
                return _scalar(apply(self.value(operand)) if apply else None, node)
            case ast.BinOp(left, sign, right):
                return self._binary(node, left, sign, right)
            case ast.BoolOp(ast.And(), values):
                return self._first(values, stop_at=False)
            case ast.BoolOp(_, values):
                return self._first(values, stop_at=True)
            case ast.Compare(left, signs, rights):
                return self._compare(left, signs, rights)
            case ast.IfExp(test, body, otherwise):
                return self.value(body if self.value(test) else otherwise)
            case ast.Call(ast.Name(name), [argument], []):
                return self._call(name, argument, node)
            case _:
                raise _beyond(node)

    def _name(self, name: str) -> Scalar:
        value = _CONSTANTS[name] if name in _CONSTANTS else self._names.get(name)
        if value is None:
            raise _Stop(f"`{name}` has no value")
        return _known(value)

    def _binary(
        self, node: ast.expr, left: ast.expr, sign: ast.operator, right: ast.expr
    ) -> Scalar:
        a, b = self.value(left), self.value(right)
        apply = _BINARY.get(type(sign))
        if apply is None or (isinstance(a, str) and isinstance(sign, ast.Mod)):
            raise _beyond(node)
        if isinstance(sign, ast.Pow) and isinstance(b, int) and abs(b) > _LARGEST_EXPONENT:
            raise _Stop("a power this large is not worked out")
        if isinstance(sign, ast.Mult) and (isinstance(a, str) or isinstance(b, str)):
            raise _beyond(node)
        return _scalar(apply(a, b), node)

    def _first(self, values: list[ast.expr], *, stop_at: bool) -> Scalar:
        value: Scalar = not stop_at
        for node in values:
            value = self.value(node)
            if bool(value) is stop_at:
                break
        return value

    def _compare(self, left: ast.expr, signs: list[ast.cmpop], rights: list[ast.expr]) -> Scalar:
        a = self.value(left)
        for sign, right in zip(signs, rights, strict=True):
            b = self.value(right)
            apply = _COMPARE.get(type(sign))
            if apply is None:
                raise _beyond(right)
            if not apply(a, b):
                return False
            a = b
        return True

    def _call(self, name: str, argument: ast.expr, node: ast.expr) -> Scalar:
        value = self.value(argument)
        if name in self._functions and isinstance(value, str):
            return _known(self._functions[name](value))
        if name in _CONVERSIONS:
            return _scalar(_CONVERSIONS[name](value), node)
        if name in _MATHS and not isinstance(value, str):
            return _scalar(getattr(math, name)(value), node)
        raise _beyond(node)


def _scalar(value: object, node: ast.expr) -> Scalar:
    match value:
        case bool() | float():
            return value
        case int() if abs(value) <= _WIDEST:
            return value
        case str() if len(value) <= _LONGEST:
            return value
        case _:
            raise _beyond(node)


def _known(value: Scalar | Open) -> Scalar:
    if isinstance(value, Open):
        raise _Stop(value.why)
    return value


def _beyond(node: ast.expr) -> _Stop:
    return _Stop(f"`{ast.unparse(node)}` is more than arithmetic")
