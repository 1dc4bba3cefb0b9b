"""Loops of Python."""

from __future__ import annotations

from collections.abc import Callable

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.python.context import Lowering
from rebsync.reverse.ir.python.references import name_target
from rebsync.reverse.ir.python.results import has_truth
from rebsync.reverse.ir.python.targets import assign
from rebsync.reverse.syntax.py_tree import field, named


def while_(ctx: Lowering, node: Node) -> None:
    tests: list[e.Expression] = []
    prelude = ctx.body(lambda: tests.append(ctx.value(field(node, "condition"))))
    body = ctx.block(node.child_by_field_name("body"))
    otherwise = ctx.else_of(node)
    (test,) = tests
    place = ctx.place(node)
    ctx.emit(s.Loop(test, body, prelude, (), otherwise, False, has_truth(test), place))


def for_(ctx: Lowering, node: Node) -> None:
    iterable = ctx.value(field(node, "right"))
    waits = any(c.type == "async" for c in node.children)
    body = field(node, "body")
    for_each(ctx, node, iterable, lambda: ctx.lower_all(named(body)), ctx.else_of(node), waits)


def for_each(
    ctx: Lowering,
    node: Node,
    iterable: e.Expression,
    fill: Callable[[], None],
    otherwise: s.Body = (),
    waits: bool = False,
) -> None:
    """A loop over elements: names are stored in directly, other targets from a temporary."""
    left = field(node, "left")
    target: e.Lvalue
    if left.type == "identifier":
        target = name_target(ctx, left)
        body = ctx.body(fill)
    else:
        temporary = target = ctx.temporary(left)

        def with_target() -> None:
            assign(ctx, left, temporary, left)
            fill()

        body = ctx.body(with_target)
    place = ctx.place(node)
    ctx.emit(s.ForEach(target, iterable, body, otherwise, waits=waits, place=place))
