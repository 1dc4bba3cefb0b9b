"""Jumps and exceptions of C++ ([stmt.jump], [except]): return, break, continue, throw, try."""

from __future__ import annotations

from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.alternatives import one_of
from rebsync.reverse.ir.cpp.classes import copies_trivially, ends_silently
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    lower_value,
    lowers_expression,
    lowers_statement,
)
from rebsync.reverse.ir.cpp.initialisation import initialised
from rebsync.reverse.ir.cpp.objects import as_value, class_of, passed
from rebsync.reverse.ir.cpp.statements import one
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.source import Span


@lowers_statement("return_statement")
def return_statement(context: Context, node: Node) -> None:
    """`return value;`: as the function's result."""
    inner, place = named(node), context.place(node)
    if not inner:
        context.emit(s.Return(None, place))
        return
    with context.full_expression():
        found = _returned(context, inner[0], place)
        context.emit(s.Return(found, place))


def _returned(context: Context, node: Node, place: Span) -> e.Expression | None:
    declared = context.result
    if node.type == "initializer_list":
        if declared is None:
            raise Unlowered("a list in braces as a result that is not known")
        target = context.temporary(declared.type, place)
        initialised(context, target, declared.type, node)
        return target
    value = lower_value(context, node)
    if declared is None:
        context.returned.append(value.type)
        declared = Declared(value.type)
    if declared.type == t.NOTHING:
        if value.type != t.NOTHING:
            context.emit(s.Evaluate(value.expression, place))
        return None
    _check_elision(context, value, place)
    if declared.reference is ReferenceKind.NONE and _is_own(context, value):
        value = Value(context.stored(value.expression, value.type, place), value.type)
    return passed(context, value, declared, place)


def _is_own(context: Context, value: Value) -> bool:
    """Whether it is a variable of the function itself, which ends: it is moved, not copied."""
    local = value.expression
    is_local = isinstance(local, e.Local) and local.name not in {"this", *context.aliases}
    return is_local and value.is_lvalue and isinstance(value.type, t.Record | t.Container)


def _check_elision(context: Context, value: Value, place: Span) -> None:
    """Whether a variable becomes the result itself, or is moved and ends, is up to the compiler."""
    is_written = not copies_trivially(context.world, value.type)
    is_written |= class_of(context, value.type) is not None
    is_silent = ends_silently(context.world, value.type)
    owner = class_of(context, value.type)
    if _is_own(context, value) and is_written and not is_silent and owner is not None:
        with context.body() as body:
            moved = replace(value, is_lvalue=False)
            made = context.temporary(value.type, place)
            context.world.construct(context, made, owner, [moved], place)
        one_of(context, [tuple(body), ()], place)


@lowers_statement("break_statement")
def break_statement(context: Context, node: Node) -> None:
    """`break;`."""
    context.emit(s.Break(context.place(node)))


@lowers_statement("continue_statement")
def continue_statement(context: Context, node: Node) -> None:
    """`continue;`."""
    context.emit(s.Continue(context.place(node)))


@lowers_statement("throw_statement")
def throw_statement(context: Context, node: Node) -> None:
    """`throw value;`."""
    throw(context, node)


@lowers_expression("throw_expression")
def throw(context: Context, node: Node) -> Value:
    """`throw value`, which the grammar may have as an expression."""
    inner, place = named(node), context.place(node)
    with context.full_expression():
        found = None
        if inner:
            found = as_value(context, lower_value(context, inner[0]), place)
        context.emit(s.Raise(found, None, place))
    return Value(e.Literal(None, t.NOTHING, place=place), t.NOTHING)


@lowers_statement("try_statement")
def try_statement(context: Context, node: Node) -> None:
    """`try` with its handlers in their order."""
    body = one(context, part(node, "body"))
    handlers = tuple(
        _handler(context, child) for child in named(node) if child.type == "catch_clause"
    )
    context.emit(s.Try(body, handlers, place=context.place(node)))


def _handler(context: Context, node: Node) -> s.Handler:
    """`catch (const E& e)`, or of anything."""
    place, parameters = context.place(node), named(part(node, "parameters"))
    with context.scoped():
        types: tuple[e.Expression, ...] | None = None
        target: e.Lvalue | None = None
        if parameters:
            types, target = _caught(context, parameters[0], place)
        body = one(context, part(node, "body"))
    return s.Handler(types, body, target, (), place)


def _caught(
    context: Context, node: Node, place: Span
) -> tuple[tuple[e.Expression, ...], e.Lvalue | None]:
    declarator = node.child_by_field_name("declarator")
    declared = context.world.types.declared(
        context.cpp, context.scope, part(node, "type"), declarator
    )
    kind = _exception_type(context, declared.type, place, text_of(part(node, "type")))
    names = _identifiers(declarator)
    if not names:
        return (kind,), None
    local = e.Local(context.unique(names[0]), declared.type, place)
    context.bind(names[0], Value(local, declared.type, is_lvalue=True))
    return (kind,), local


def _identifiers(node: Node | None) -> list[str]:
    found: list[str] = []
    while node is not None:
        if node.type == "identifier":
            found.append(text_of(node))
        node = named(node)[-1] if named(node) else None
    return found


def _exception_type(context: Context, type_: t.Type, place: Span, text: str) -> e.Expression:
    if isinstance(type_, t.Record) and type_.name in context.world.symbols.classes:
        return e.ClassReference(type_.name, place)
    return e.LibraryReference(context.world.types.imported(context.cpp, text), place=place)
