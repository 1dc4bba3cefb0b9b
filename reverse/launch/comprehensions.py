"""Comprehensions of launch files in Python, written out where what they go over is written out."""

from __future__ import annotations

import ast
import copy
from collections.abc import Callable, Iterator, Mapping
from itertools import islice
from typing import TypeAlias

from rebsync.records import dataclass

Comprehension: TypeAlias = "ast.ListComp | ast.GeneratorExp | ast.DictComp"
COMPREHENSIONS = (ast.ListComp, ast.GeneratorExp, ast.DictComp)
_MOST = 1_000  # elements
_SCOPES = (*COMPREHENSIONS, ast.SetComp, ast.Lambda)
_Resolve: TypeAlias = "Callable[[ast.expr], ast.expr]"
_Bound: TypeAlias = "dict[str, ast.expr]"


@dataclass(frozen=True, slots=True)
class WrittenOut:
    """The list, or table, that a comprehension gives, and which call each call in it copies."""

    value: ast.List | ast.Dict
    originals: Mapping[ast.Call, ast.Call]


def written_out(node: Comprehension, resolve: _Resolve) -> WrittenOut | None:
    """What a comprehension gives; None where a value or a condition decides how much.

    `resolve` gives what a name stands for.
    """
    if any(g.ifs or g.is_async for g in node.generators) or _rebinds(node):
        return None
    turns: list[_Bound] = [{}]
    for generator in node.generators:
        more = _turns(turns, generator, resolve)
        if more is None:
            return None
        turns = more
    originals: dict[ast.Call, ast.Call] = {}
    if isinstance(node, ast.DictComp):
        keys = [_copied(node.key, bound, originals) for bound in turns]
        values = [_copied(node.value, bound, originals) for bound in turns]
        table = ast.Dict(keys=list[ast.expr | None](keys), values=values)
        return WrittenOut(ast.copy_location(table, node), originals)
    elements = [_copied(node.elt, bound, originals) for bound in turns]
    listed = ast.List(elts=elements, ctx=ast.Load())
    return WrittenOut(ast.copy_location(listed, node), originals)


def _rebinds(node: Comprehension) -> bool:
    """Whether something inside has a name again that a comprehension binds."""
    inner = [n for n in ast.walk(node) if isinstance(n, _SCOPES) and n is not node]
    own = {n.id for g in node.generators for n in ast.walk(g.target) if isinstance(n, ast.Name)}
    stored = (n for scope in inner for n in ast.walk(scope))
    again = {n.id for n in stored if isinstance(n, ast.Name) and not isinstance(n.ctx, ast.Load)}
    again |= {n.arg for scope in inner for n in ast.walk(scope) if isinstance(n, ast.arg)}
    return bool(own & again) or any(isinstance(n, ast.NamedExpr) for n in ast.walk(node))


def _turns(
    turns: list[_Bound], generator: ast.comprehension, resolve: _Resolve
) -> list[_Bound] | None:
    """What is bound in each turn of one more `for`."""
    found: list[_Bound] = []
    for bound in turns:
        items = _items(_copied(generator.iter, bound, {}), resolve)
        for item in items if items is not None else ():
            more = _bound_to(generator.target, item, resolve)
            if more is None:
                return None
            found.append(bound | more)
        if items is None or len(found) > _MOST:
            return None
    return found


def _items(value: ast.expr, resolve: _Resolve) -> list[ast.expr] | None:
    """What a loop goes over."""
    match resolve(value):
        case ast.List(elts=items) | ast.Tuple(elts=items):
            return None if any(isinstance(i, ast.Starred) for i in items) else items
        case ast.Call(func=ast.Name(id="enumerate"), args=[inner, *rest], keywords=given):
            starts = [*rest, *(k.value for k in given if k.arg == "start")]
            first = _number(resolve(starts[0])) if starts else 0
            counted = _items(inner, resolve)
            if counted is None or first is None or len(starts) < len(rest) + len(given):
                return None
            return [_pair(ast.Constant(n), item) for n, item in enumerate(counted, first)]
        case ast.Call(func=ast.Name(id="zip"), args=[left, right], keywords=[]):
            lefts, rights = _items(left, resolve), _items(right, resolve)
            if lefts is None or rights is None:
                return None
            return [_pair(a, b) for a, b in zip(lefts, rights, strict=False)]
        case ast.Call(func=ast.Name(id="range"), args=bounds, keywords=[]) if bounds:
            numbers = [n for b in bounds if (n := _number(resolve(b))) is not None]
            if len(numbers) < len(bounds) or numbers[2:] == [0] or len(numbers) > 3:
                return None
            turns = islice(range(*numbers), _MOST + 1)
            return [ast.copy_location(ast.Constant(n), value) for n in turns]
        case ast.Call(func=ast.Attribute(value=table, attr="items"), args=[], keywords=[]):
            found = resolve(table)
            if not isinstance(found, ast.Dict) or None in found.keys:
                return None
            pairs = zip(found.keys, found.values, strict=True)
            return [_pair(key, item) for key, item in pairs if key is not None]
        case _:
            return None


def _number(value: ast.expr) -> int | None:
    match value:
        case ast.Constant(value=int() as number) if not isinstance(number, bool):
            return number
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() as number)):
            return -number
        case _:
            return None


def _pair(first: ast.expr, second: ast.expr) -> ast.Tuple:
    """Two values where the second stands."""
    if not hasattr(first, "lineno"):
        ast.copy_location(first, second)
    return ast.copy_location(ast.Tuple(elts=[first, second], ctx=ast.Load()), second)


def _bound_to(target: ast.expr, item: ast.expr, resolve: _Resolve) -> _Bound | None:
    """What the names of a target stand for."""
    if isinstance(target, ast.Name):
        return {target.id: item}
    value = resolve(item)
    if not isinstance(target, ast.Tuple | ast.List) or not isinstance(value, ast.Tuple | ast.List):
        return None
    if len(target.elts) != len(value.elts):
        return None
    found: _Bound = {}
    for each, part in zip(target.elts, value.elts, strict=True):
        more = _bound_to(each, part, resolve)
        if more is None or isinstance(part, ast.Starred):
            return None
        found |= more
    return found


def _copied(
    node: ast.expr, bound: Mapping[str, ast.expr], originals: dict[ast.Call, ast.Call]
) -> ast.expr:
    """An expression with what its names are bound to; notes which call each call copies."""
    found = copy.deepcopy(node)
    originals.update(_calls(found, node))
    value: ast.expr = _Substitution(bound).visit(found)
    return value


def _calls(found: ast.expr, node: ast.expr) -> Iterator[tuple[ast.Call, ast.Call]]:
    for made, original in zip(ast.walk(found), ast.walk(node), strict=True):
        if isinstance(made, ast.Call) and isinstance(original, ast.Call):
            yield made, original


class _Substitution(ast.NodeTransformer):
    def __init__(self, bound: Mapping[str, ast.expr]) -> None:
        self._bound = bound

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return copy.deepcopy(self._bound[node.id]) if node.id in self._bound else node
