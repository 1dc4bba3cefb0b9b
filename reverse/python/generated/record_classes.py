"""Data classes of a module whose objects only hold what they are made of."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from tree_sitter import Node

from rebsync.reverse.python.generated.py_types import type_of
from rebsync.reverse.syntax.py_index import CLASS, PyCode, Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

_DATACLASS = re.compile(
    r"(?:dataclasses\.)?dataclass(?:\((?:\s*(?:frozen|order|eq)\s*=\s*(?:True|False)\s*,?)*\))?\Z"
)

_MODULE = re.compile(r"from\s+dataclasses\s+import\b|import\s+dataclasses\s*\Z")


def records_in(code: PyCode, module: Scope) -> Mapping[str, Sequence[str]]:
    """The fields of each, by the names of the classes. None has a default."""
    imported = {
        name
        for name, bindings in module.names.items()
        if len(bindings) == 1 and _MODULE.match(text_of(bindings[0].node))
    }
    scopes = (s for s in code.scopes.values() if s.kind == CLASS and s.parent is module)
    return {
        scope.name: fields
        for scope in scopes
        if len(module.names[scope.name]) == 1
        and imported.issuperset(d.partition(".")[0].partition("(")[0] for d in scope.decorators)
        and (fields := _fields(scope))
    }


def _fields(scope: Scope) -> tuple[str, ...]:
    """The fields of a data class; none where its objects may do more than to hold them."""
    is_plain = len(scope.decorators) == 1 and _DATACLASS.match(scope.decorators[0])
    if not is_plain or scope.node.child_by_field_name("superclasses") is not None:
        return ()
    found = []
    for statement in named(field(scope.node, "body")):
        if statement.type == "function_definition":
            if not _is_idle(statement):
                return ()
        elif (name := _declared(statement)) is not None:
            found.append(name)
        elif not (named(statement) and named(statement)[0].type == "string"):
            return ()
    return tuple(found)


def _declared(statement: Node) -> str | None:
    """The field that `x: int` declares."""
    inner = named(statement)[0] if statement.type == "expression_statement" else statement
    if inner.type != "assignment" or inner.child_by_field_name("right") is not None:
        return None
    said = field(inner, "type")
    return text_of(field(inner, "left")) if type_of(said) or text_of(said) == "str" else None


def _is_idle(function: Node) -> bool:
    """Whether a method runs only where it is called by its name."""
    name = text_of(field(function, "name"))
    return not (name.startswith("__") and name.endswith("__"))
