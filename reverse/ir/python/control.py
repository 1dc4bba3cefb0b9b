"""Branches, exceptions and contexts of Python."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.python.context import Lowering, NoLowering
from rebsync.reverse.ir.python.references import name_target
from rebsync.reverse.ir.python.results import has_truth
from rebsync.reverse.ir.python.targets import assign
from rebsync.reverse.syntax.py_tree import field, named


def branch(ctx: Lowering, node: Node) -> None:
    """`if` with its `elif` and `else`."""
    clauses = [c for c in node.children if c.type in ("elif_clause", "else_clause")]
    _branch(ctx, node, clauses)


def _branch(ctx: Lowering, node: Node, rest: list[Node]) -> None:

    test = ctx.value(field(node, "condition"))
    then = ctx.block(node.child_by_field_name("consequence"))
    otherwise: s.Body = ()
    if rest and rest[0].type == "elif_clause":
        otherwise = ctx.body(lambda: _branch(ctx, rest[0], rest[1:]))
    elif rest:
        otherwise = ctx.block(field(rest[0], "body"))
    ctx.emit(s.If(test, then, otherwise, has_truth(test), ctx.place(node)))


def try_(ctx: Lowering, node: Node) -> None:
    """`try` with what handles, `else` and `finally`."""

    body = ctx.block(field(node, "body"))
    handlers = tuple(_handler(ctx, c) for c in node.children if c.type == "except_clause")
    otherwise = ctx.else_of(node)
    clause = next((c for c in node.children if c.type == "finally_clause"), None)
    final = ctx.block(_block(clause)) if clause is not None else ()
    ctx.emit(s.Try(body, handlers, otherwise, final, ctx.place(node)))


def _handler(ctx: Lowering, node: Node) -> s.Handler:

    if any(c.type == "*" for c in node.children):
        raise NoLowering("groups of exceptions", node)
    values = node.children_by_field_name("value")
    name: Node | None = values[1] if len(values) > 1 else None  # of Python 2
    types: list[e.Expression] = []
    target: e.Lvalue | None = None
    prelude: s.Body = ()
    if values:
        kind = values[0]
        if kind.type == "as_pattern":
            name = _alias(kind)
            kind = kind.named_children[0]
        nodes = named(kind) if kind.type == "tuple" else [kind]
        prelude = ctx.body(lambda: types.extend(ctx.values(nodes)))
    if name is not None:
        target = name_target(ctx, name)
    body = ctx.block(_block(node))
    return s.Handler(tuple(types) if values else None, body, target, prelude, ctx.place(node))


def _block(node: Node) -> Node | None:
    return next((c for c in node.children if c.type == "block"), None)


def _alias(node: Node) -> Node:
    """The target of an `as`."""
    alias = field(node, "alias")
    return alias.named_children[0] if alias.named_children else alias


def with_(ctx: Lowering, node: Node) -> None:
    """`with`: the contexts one within the other."""
    clause = next(c for c in node.children if c.type == "with_clause")
    items = [c for c in named(clause) if c.type == "with_item"]
    waits = any(c.type == "async" for c in node.children)
    if len(items) == 1 and field(items[0], "value").type == "tuple":
        inner = named(field(items[0], "value"))
        if any(i.type == "as_pattern" for i in inner):
            _with(ctx, node, inner, waits)
            return
    _with(ctx, node, [field(item, "value") for item in items], waits)


def _with(ctx: Lowering, node: Node, items: list[Node], waits: bool) -> None:

    if not items:
        ctx.lower_all(named(field(node, "body")))
        return
    item, *rest = items
    name = _alias(item) if item.type == "as_pattern" else None
    context = ctx.value(item.named_children[0] if name is not None else item)
    target = ctx.temporary(item) if name is not None else None

    def fill() -> None:
        if name is not None and target is not None:
            assign(ctx, name, target, item)
        _with(ctx, node, rest, waits)

    body = ctx.body(fill)
    ctx.emit(s.With(context, target, body, waits, ctx.place(node)))
