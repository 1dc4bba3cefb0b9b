"""Where bodies in Python say that numbers wrap, as those of the model do."""

from __future__ import annotations

import ast
from collections.abc import Iterator

RANGE, ANY = "range", "any"
_FORMATS = frozenset({"int8", "int16", "int32"})
_GROWING = (ast.Add, ast.Sub, ast.Mult, ast.LShift)


def ranges_in(function: ast.FunctionDef) -> Iterator[tuple[str, str, ast.expr]]:
    """Each sum, product or shift to the left in a body, and the type that its value is cut to.

    Generated code leaves that out where no value can be too large, which is not looked at here.
    """
    cut = {}
    for node in ast.walk(function):
        match node:
            case ast.Call(ast.Name(name), [value]) if name in _FORMATS:
                cut[id(value)] = name
            case _:
                pass
    for node in ast.walk(function):
        if isinstance(node, ast.BinOp) and isinstance(node.op, _GROWING):
            yield ast.unparse(node), cut.get(id(node), ANY), node
        elif isinstance(node, ast.AugAssign) and isinstance(node.op, _GROWING):
            whole = ast.BinOp(node.target, node.op, node.value)
            yield ast.unparse(whole), ANY, ast.copy_location(whole, node)
