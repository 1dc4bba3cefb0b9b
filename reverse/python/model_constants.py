"""Numbers and truth values that generated Python gives names to, and what else says nothing."""

from __future__ import annotations

import builtins

from tree_sitter import Node

from rebsync.reverse.python.py_index import Scope
from rebsync.reverse.python.py_tree import field, named, text_of

_LITERALS = frozenset({"integer", "float", "true", "false"})


def constants_of(scope: Scope) -> dict[str, Node]:
    """The names of a module or a class that are bound once, to a literal."""
    found = {}
    for name, bindings in scope.names.items():
        if len(bindings) == 1 and bindings[0].how == "value" and not hasattr(builtins, name):
            value = bindings[0].value
            if value is not None and _is_literal(value):
                found[name] = value
    return found


def enumerations_of(module: Scope) -> dict[str, Node]:
    """The members of the module's enumerations of integers, `Command.STOP`, as what they are."""
    found = {}
    for node in named(module.node):
        bases = node.child_by_field_name("superclasses")
        if node.type != "class_definition" or bases is None:
            continue
        if [text_of(b).removeprefix("enum.") for b in named(bases)] != ["IntEnum"]:
            continue
        name = text_of(field(node, "name"))
        for statement in named(field(node, "body")):
            inner = named(statement)[0] if statement.type == "expression_statement" else None
            if inner is None or inner.type != "assignment" or not _is_new(module, name):
                continue
            value = inner.child_by_field_name("right")
            if value is not None and value.type == "integer":
                found[f"{name}.{text_of(field(inner, 'left'))}"] = value
    return found


def is_quiet(scope: Scope, statement: Node) -> bool:
    """Whether a statement of a module or a class only names a constant or defines a function.

    Where these are used, the reader of bodies looks at what they are.
    """
    if statement.type == "function_definition":
        return _is_new(scope, text_of(field(statement, "name")))
    inner = named(statement)[0] if statement.type == "expression_statement" else None
    if inner is None or inner.type != "assignment":
        return False
    left, value = field(inner, "left"), inner.child_by_field_name("right")
    if left.type != "identifier" or value is None:
        return False
    if text_of(left) == "__all__":
        return value.type in ("list", "tuple")
    return _is_literal(value) and _is_new(scope, text_of(left))


def _is_new(scope: Scope, name: str) -> bool:
    """Whether a name stands for nothing else."""
    return len(scope.names.get(name, ())) == 1 and not hasattr(builtins, name)


def _is_literal(node: Node) -> bool:
    if node.type == "unary_operator":
        return text_of(field(node, "operator")) == "-" and _is_literal(field(node, "argument"))
    return node.type in _LITERALS
