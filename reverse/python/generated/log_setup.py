"""Statements at the top of modules that only say how is logged, or import what a version has."""

from __future__ import annotations

import re
from collections.abc import Collection

from tree_sitter import Node

from rebsync.reverse.python.generated.module_variables import (
    call_and_arguments,
    imported_as,
    loggers_of,
)
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

_LEVEL = re.compile(r"logging\.(?:DEBUG|INFO|WARN|WARNING|ERROR|CRITICAL|FATAL)\Z")
_HANDLERS = frozenset({"logging.StreamHandler", "logging.NullHandler"})
_VERSION = re.compile(r"sys\.version_info\s*(?:>=|<)\s*\(\s*\d+\s*,\s*\d+\s*\)\Z")
# What only has other names for types there.
_OF_TYPES = re.compile(r"from (?:typing|typing_extensions|collections\.abc) import [\w\s,()]+\Z")


def sets_up_logs(module: Scope, statement: Node) -> bool:
    """Whether a statement of a module only says how is logged, and cannot fail."""
    inner = named(statement)[0] if statement.type == "expression_statement" else statement
    called, arguments = call_and_arguments(inner)
    head, _, method = called.partition(".")
    if called == "faulthandler.enable":
        return imported_as(module, "faulthandler") == "faulthandler" and not arguments
    if head not in loggers_of(module) or len(arguments) != 1:
        return False
    match method:
        case "setLevel":
            return _is_level(module, arguments[0])
        case "addHandler":
            handler, given = call_and_arguments(arguments[0])
            return handler in _HANDLERS and not given and _is_logging(module)
        case _:
            return False


def _is_level(module: Scope, node: Node) -> bool:
    return _LEVEL.match(text_of(node)) is not None and _is_logging(module)


def _is_logging(module: Scope) -> bool:
    return imported_as(module, "logging") == "logging"


def imports_types(module: Scope, statement: Node) -> bool:
    """Whether a statement imports names of types from where a version of Python has them."""
    if statement.type != "if_statement":
        return False
    condition = text_of(field(statement, "condition"))
    if _VERSION.match(condition) is None or imported_as(module, "sys") != "sys":
        return False
    others = statement.children_by_field_name("alternative")
    blocks = [field(statement, "consequence"), *(field(o, "body") for o in others)]
    is_whole = all(o.type == "else_clause" for o in others)
    return is_whole and all(map(_only_imports_types, blocks))


def _only_imports_types(block: Node) -> bool:
    inside: Collection[Node] = [n for n in named(block) if n.type != "comment"]
    return bool(inside) and all(_OF_TYPES.match(text_of(n)) for n in inside)
