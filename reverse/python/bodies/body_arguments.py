"""Parameters of functions with the arguments that a call gives them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from tree_sitter import Node

from rebsync.reverse.syntax.py_index import PyParameter, Scope, arguments_of
from rebsync.reverse.syntax.py_tree import field, text_of

Argument: TypeAlias = tuple[PyParameter, "Node | None", bool]


def arguments(own: Scope, call: Node) -> Iterator[Argument]:
    """The parameters of a function with what a call gives; False for what it is by default."""
    plain, keywords = arguments_of(call)
    parameters = own.parameters
    if own.self_name is not None and not _names_object(call, own):
        parameters = parameters[1:]
    for number, parameter in enumerate(parameters):
        if parameter.star:
            yield parameter, None, True
        elif number < len(plain):
            yield parameter, plain[number], True
        elif parameter.name in keywords:
            yield parameter, keywords[parameter.name], True
        else:
            yield parameter, parameter.default, False


def _names_object(call: Node, own: Scope) -> bool:
    """Whether the object is the first argument, as in `Base.__init__(self)`."""
    called = field(call, "function")
    if called.type != "attribute" or own.name != "__init__":
        return False
    plain, _ = arguments_of(call)
    return bool(plain) and text_of(plain[0]) == "self" and "super" not in text_of(called)
