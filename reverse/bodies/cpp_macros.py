"""Macros that the files define, as the statements that stand for a call of one."""

from __future__ import annotations

import re
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import Scope, Variable
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_tree import Cpp, named, parse, text_of
from rebsync.source import Source
from rebsync.static.types import INT

_REST = "__VA_ARGS__"
_JOINED = re.compile(rf"##\s*{_REST}")
_CONTINUED = re.compile(r"\\\r?\n")


@dataclass(frozen=True, slots=True)
class MacroBody:
    """The statements that stand for a call of a macro, with its parameters as locals of a scope."""

    cpp: Cpp
    statements: Node
    scope: Scope
    parameters: frozenset[str]


def macro_bodies(scope: Scope, path: str, name: str) -> tuple[MacroBody, ...]:
    """The bodies of all that define a macro; none where one is not known as whole statements."""
    found = [_macro_body(scope, path, name, defined) for defined in scope.macros.get(name, ())]
    known = tuple(body for body in found if body is not None)
    return known if len(known) == len(found) else ()


def _macro_body(scope: Scope, path: str, name: str, defined: Node) -> MacroBody | None:
    cpp = _body(path, defined)
    if cpp is None or _may_be_of_others(name, defined):
        return None
    given = frozenset({text_of(p) for p in named(_part(defined, "parameters"))} | {_REST})
    scope = scope.with_locals({p: Variable(p, INT) for p in given})
    macros = {n: found for n, found in scope.macros.items() if n != name}
    statements = _part(cpp.root.named_children[0], "body")
    return MacroBody(cpp, statements, replace(scope, macros=macros), given)


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
    around = (n for n in ancestors(defined) if n.type == "preproc_ifdef")
    guards = (n.child_by_field_name("name") for n in around)
    return any(guard is not None and text_of(guard) == name for guard in guards)


def _part(node: Node, name: str) -> Node:
    return node.children_by_field_name(name)[0]
