"""Comprehensions and generator expressions of Python as loops."""

from __future__ import annotations

from collections.abc import Callable

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.python.context import MAPPING, SEQUENCE, SET, Lowering, NoLowering
from rebsync.reverse.ir.python.functions import captures_of
from rebsync.reverse.ir.python.loops import for_each
from rebsync.reverse.ir.python.results import has_truth
from rebsync.reverse.syntax.py_tree import field, named

FIRST = ".0"  # the parameter of a generator expression: what its first loop iterates


def comprehension(ctx: Lowering, node: Node) -> e.Expression:
    """A new container and the loops that fill it."""
    type_ = {"list_comprehension": SEQUENCE, "set_comprehension": SET}.get(node.type, MAPPING)
    place, clauses, body = ctx.place(node), _clauses(node), field(node, "body")
    iterable = _first(ctx, clauses)
    target = ctx.temporary(node, type_)
    empty = e.BuildMapping(MAPPING) if type_ == MAPPING else e.Build(type_)
    ctx.emit(s.Assign(target, empty, place))
    scope = ctx.binder.scopes[node.id]
    ctx.within(scope, lambda: _loop(ctx, clauses, iterable, lambda: _insert(ctx, target, body)))
    return target


def generator(ctx: Lowering, node: Node) -> e.Expression:
    """A call of the generator function that the expression is, on what it iterates first."""
    clauses = _clauses(node)
    iterable = _first(ctx, clauses)
    function = ctx.binder.scopes[node.id]
    captures = captures_of(ctx, function)
    closure = e.Closure(function.name, captures, place=ctx.place(node))
    target = ctx.temporary(node)
    first = s.CallArgument(iterable)
    ctx.emit(s.Call(target, s.ValueCallee(closure), (first,), ctx.place(node)))
    return target


def generator_body(ctx: Lowering, node: Node) -> None:
    """The body of the function that a generator expression is."""
    body = field(node, "body")
    _loop(ctx, _clauses(node), e.Local(FIRST), lambda: _hand_out(ctx, body))


def _clauses(node: Node) -> list[Node]:
    clauses = [c for c in named(node) if c.type in ("for_in_clause", "if_clause")]
    if any(c.type == "async" for clause in clauses for c in clause.children):
        raise NoLowering("a comprehension that waits", node)
    return clauses


def _first(ctx: Lowering, clauses: list[Node]) -> e.Expression:

    return ctx.value(field(clauses[0], "right"))


def _loop(
    ctx: Lowering, clauses: list[Node], iterable: e.Expression, fill: Callable[[], None]
) -> None:
    """The loops and conditions of a comprehension, one in the other."""

    for_each(ctx, clauses[0], iterable, lambda: _rest(ctx, clauses, fill))


def _rest(ctx: Lowering, clauses: list[Node], fill: Callable[[], None]) -> None:
    """What stands behind a loop or condition."""

    _, *rest = clauses
    if not rest:
        fill()
    elif rest[0].type == "if_clause":
        test = ctx.value(named(rest[0])[0])
        body = ctx.body(lambda: _rest(ctx, rest, fill))
        ctx.emit(s.If(test, body, (), has_truth(test), ctx.place(rest[0])))
    else:
        _loop(ctx, rest, ctx.value(field(rest[0], "right")), fill)


def _insert(ctx: Lowering, target: e.Temporary, body: Node) -> None:

    place = ctx.place(body)
    if body.type != "pair":
        ctx.emit(s.Insert(target, ctx.value(body), place=place))
        return
    parts = (field(body, "key"), field(body, "value"))
    key, value = ctx.values(parts)
    ctx.emit(s.Insert(target, value, key, place))


def _hand_out(ctx: Lowering, body: Node) -> None:

    ctx.emit(s.Yield(None, ctx.value(body), place=ctx.place(body)))
