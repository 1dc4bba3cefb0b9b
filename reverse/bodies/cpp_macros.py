"""Macros that the files define: whether a call of one touches what the model has."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_tree import Cpp, named, parse, text_of
from rebsync.source import Source
from rebsync.static.types import INT

if TYPE_CHECKING:
    from rebsync.reverse.bodies.cpp_effects import Effects

_REST = "__VA_ARGS__"
_JOINED = re.compile(rf"##\s*{_REST}")
_CONTINUED = re.compile(r"\\\r?\n")


def is_harmless(effects: Effects, name: str) -> bool:
    """Whether a macro only looks at what it gets, and touches nothing else, at this place.

    All that define it count, and there must be one.
    """
    found = effects.scope.macros.get(name, ())
    return bool(found) and all(_is_calm(effects, name, node) for node in found)


def _is_calm(effects: Effects, name: str, defined: Node) -> bool:
    body = _body(effects.cpp.source.path, defined)
    if body is None or _may_be_of_others(name, defined):
        return False
    given = {text_of(p) for p in named(_part(defined, "parameters"))} | {_REST}
    scope = effects.scope.with_locals({p: Variable(p, INT) for p in given})
    macros = {n: found for n, found in scope.macros.items() if n != name}
    inside = replace(
        effects,
        cpp=body,
        scope=replace(scope, macros=macros),
        own=frozenset(),
        everything=False,
        returning=False,
        _inner=effects._inner - given,
        _loops=0,
    )
    try:
        inside.check(_part(body.root.named_children[0], "body"))
    except Unread:
        return False
    return True


def _body(path: str, defined: Node) -> Cpp | None:
    """What stands for a call, as the body of a function; None where it is no whole statements."""
    value = defined.child_by_field_name("value")
    text = text_of(value) if value is not None else ""
    plain = _CONTINUED.sub(" ", _JOINED.sub(_REST, text))
    if "#" in plain:
        return None
    parsed = parse(Source(path, f"void body() {{ {plain}\n; }}"))
    functions = parsed.root.named_children
    whole = len(functions) == 1 and functions[0].type == "function_definition"
    return parsed if whole and not parsed.root.has_error else None


def _may_be_of_others(name: str, defined: Node) -> bool:
    """Whether it is only defined where nobody else has done so."""
    around = defined.parent
    while around is not None:
        guard = around.child_by_field_name("name") if around.type == "preproc_ifdef" else None
        if guard is not None and text_of(guard) == name:
            return True
        around = around.parent
    return False


def _part(node: Node, name: str) -> Node:
    return node.children_by_field_name(name)[0]
