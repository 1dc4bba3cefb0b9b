"""Arguments of calls and constants in launch files in Python."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from typing import TypeAlias

from rebsync.reverse.launch.parameters import ParameterValue

_DEEPEST = 40
_Resolve: TypeAlias = "Callable[[ast.expr], ast.expr]"


def called(call: ast.Call) -> str:
    """The last part of the name of what is called."""
    match call.func:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
        case _:
            return ""


def named_arguments(
    call: ast.Call, resolve: _Resolve, depth: int = 0
) -> Iterator[tuple[str | None, ast.expr]]:
    """What a call is given by name, and by `**` of tables that are written out; None: any others.

    `resolve` gives what a name stands for.
    """
    for keyword in call.keywords:
        if keyword.arg is not None:
            yield keyword.arg, keyword.value
        else:
            yield from _entries(keyword.value, resolve, depth + 1)


def _entries(
    table: ast.expr, resolve: _Resolve, depth: int
) -> Iterator[tuple[str | None, ast.expr]]:
    match resolve(table) if depth < _DEEPEST else None:
        case ast.Dict(keys=keys, values=values):
            for key, value in zip(keys, values, strict=True):
                if key is None:
                    yield from _entries(value, resolve, depth + 1)
                else:
                    name = literal(resolve(key))
                    yield name if isinstance(name, str) else None, value
        case ast.Call(func=ast.Name(id="dict"), args=[]) as call:
            yield from named_arguments(call, resolve, depth)
        case ast.BinOp(left=left, op=ast.BitOr(), right=right):
            yield from _entries(left, resolve, depth + 1)
            yield from _entries(right, resolve, depth + 1)
        case _:
            yield None, table


def literal(node: ast.expr) -> ParameterValue | None:
    """A constant; None where there is none, or one that no parameter holds."""
    match node:
        case ast.Constant(value=bool() | int() | float() | str() as value):
            return value
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() | float() as value)):
            return -value
        case ast.List(elts=items) | ast.Tuple(elts=items):
            inner = [literal(item) for item in items]
            return None if None in inner else tuple(v for v in inner if v is not None)
        case ast.Call(args=[value, *_]) if called(node) == "ParameterValue":
            return literal(value)
        case _:
            return None
