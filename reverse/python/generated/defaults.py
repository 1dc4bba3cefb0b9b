"""Parameters of functions that serve messages and have defaults: of no use where all are given."""

from __future__ import annotations

from collections.abc import Iterable

from tree_sitter import Node

from rebsync.reverse.python.generated.py_types import call_parts
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import field, text_of

_CONSTANT = frozenset({"integer", "float", "true", "false", "none"})
_DEFAULTS = frozenset({"default_parameter", "typed_default_parameter"})


def has_constant(parameter: Node) -> bool:
    """Whether a parameter has a default that is the same at any time."""
    return parameter.type in _DEFAULTS and field(parameter, "value").type in _CONSTANT


def is_given_all(name: str, bodies: Iterable[Node], count: int) -> bool:
    """Whether all that name a function in some bodies call it with so many arguments."""
    attributes = (n for body in bodies for n in nodes_in(body) if n.type == "attribute")
    found = (n for n in attributes if text_of(field(n, "attribute")) == name)
    return all(_given(each) == count for each in found)


def _given(function: Node) -> int | None:
    """How many arguments a function gets; None where it is not called, or something is spread."""
    _, arguments = call_parts(function.parent) or ("", [])
    above = function.parent
    if above is None or above.type != "call" or field(above, "function") != function:
        return None
    is_spread = any(a.type in ("list_splat", "dictionary_splat") for a in arguments)
    return None if is_spread else len(arguments)
