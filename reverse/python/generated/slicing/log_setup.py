"""Statements at the top of modules that only say how is logged."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.python.generated.module_variables import (
    call_and_arguments,
    imported_as,
    loggers_of,
)
from rebsync.reverse.python.generated.py_types import expression_in
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import text_of

_LEVEL = re.compile(r"logging\.(?:DEBUG|INFO|WARN|WARNING|ERROR|CRITICAL|FATAL)\Z")
_HANDLERS = frozenset({"logging.StreamHandler", "logging.NullHandler"})


def sets_up_logs(module: Scope, statement: Node) -> bool:
    """Whether a statement of a module only says how is logged, and cannot fail."""
    inner = expression_in(statement) or statement
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
