"""Macros that take arguments ([cpp.replace]): what their text does where they are named."""

from __future__ import annotations

import re
from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.alternatives import one_of
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value, lower_statement, lower_value
from rebsync.reverse.syntax.cpp_tree import Cpp, named, parse, part, text_of
from rebsync.source import Source, Span

_CONTINUED = re.compile(r"\\\r?\n")


def expanded(context: Context, name: str, nodes: Sequence[Node], place: Span) -> Value:
    """A call of a macro of the program, of which one definition counts.

    Arguments are evaluated once, before its text: what they do is done, but perhaps less often.
    """
    definitions = context.world.symbols.code.macros[name]
    if name in context.expanding:
        raise Unlowered(f"a macro, {name}")
    target = context.temporary(t.UNKNOWN, place)
    given = [lower_value(context, node) for node in nodes]
    bodies: list[s.Body] = []
    context.expanding.add(name)
    try:
        for defined in definitions:
            with context.body() as body, context.scoped():
                parameters = [text_of(p) for p in named(part(defined, "parameters"))]
                for parameter, value in zip(parameters, given, strict=False):
                    context.bind(parameter, value)
                _text(context, defined, target, place)
            bodies.append(tuple(body))
    finally:
        context.expanding.discard(name)
    with context.body() as whole:
        one_of(context, bodies, place)
    context.emit(s.Block(tuple(whole), place))
    return Value(target, t.UNKNOWN)


def _text(context: Context, defined: Node, target: e.Lvalue, place: Span) -> None:
    """The text of a macro: an expression, whose value it has, or statements."""
    value = defined.child_by_field_name("value")
    text = _CONTINUED.sub(" ", text_of(value)) if value is not None else ""
    if "#" in text:
        raise Unlowered("a macro that joins or writes what it gets")
    before = context.cpp, context.used_at
    try:
        context.cpp, statements = _parsed(context.cpp, text)
        context.used_at = context.used_at or place
        is_value = [n.type for n in statements] == ["return_statement"]
        if is_value:
            found = lower_value(context, named(statements[0])[0])
            context.emit(s.Assign(target, found.expression, place))
        else:
            for node in statements:
                lower_statement(context, node)
    finally:
        context.cpp, context.used_at = before


def _parsed(around: Cpp, text: str) -> tuple[Cpp, list[Node]]:
    for wrapped in (f"void body() {{ return {text}; }}", f"void body() {{ {text}\n; }}"):
        cpp = parse(Source(around.source.path, wrapped))
        functions = cpp.root.named_children
        is_whole = len(functions) == 1 and functions[0].type == "function_definition"
        if is_whole and not cpp.root.has_error:
            return cpp, named(part(functions[0], "body"))
    raise Unlowered("a macro that is no whole statement")
