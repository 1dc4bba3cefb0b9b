"""Texts that C++ formats as `printf` does ([c.format]): a value that is none of their places' kind.

What stands at `%s` is taken for the address of a text: a number there, or none, ends the program.
"""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.analysis.python.format_strings import conversions
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.scope import Scope, Variable
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.syntax.cpp_calls import CppCall, string_of

_TEXTS = ("string_literal", "concatenated_string")


def has_odd_format(scope: Scope, call: CppCall) -> bool:
    """Whether what a log says has places without values, or numbers where texts are to stand."""
    if not call.name.startswith(libraries.logging()) or "_STREAM" in call.name:
        return False
    texts = [i for i, each in enumerate(call.arguments) if each.type in _TEXTS]
    at = 1 if "_NAMED" in call.name else 0
    if len(texts) <= at:
        return False
    text = string_of(call.arguments[texts[at]])
    letters = conversions(text) if text is not None else None
    values = call.arguments[texts[at] + 1 :]
    if letters is None or len(letters) > len(values):
        return letters is not None
    found = zip(letters, values, strict=False)
    return any(letter == "s" and _is_number(scope, value) for letter, value in found)


def _is_number(scope: Scope, value: Node) -> bool:
    if value.type in ("number_literal", "true", "false"):
        return True
    meaning = resolve(scope, value)
    return isinstance(meaning, Variable) and meaning.type != TEXT
