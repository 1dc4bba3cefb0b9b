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


_PRINTING = frozenset(f"{of}{name}" for of in ("", "std::") for name in ("printf", "fprintf"))


def has_odd_format(scope: Scope, call: CppCall) -> bool:
    """Whether what a log says has places without values, or numbers where texts are to stand."""
    letters, values = _filled(call)
    return len(letters) > len(values) or any(_is_number(scope, v) for v in texts_in(call))


def texts_in(call: CppCall) -> list[Node]:
    """The values that a log, or a function of C that prints, puts in as texts: `%s`."""
    letters, values = _filled(call)
    return [value for letter, value in zip(letters, values, strict=False) if letter == "s"]


def _filled(call: CppCall) -> tuple[list[str], list[Node]]:
    """The letters of what a call fills into a text, and the values; empty for other calls."""
    is_log = call.name.startswith(libraries.logging()) and "_STREAM" not in call.name
    texts = [i for i, each in enumerate(call.arguments) if each.type in _TEXTS]
    at = 1 if "_NAMED" in call.name else 0
    if not (is_log or call.name in _PRINTING) or len(texts) <= at:
        return [], []
    text = string_of(call.arguments[texts[at]])
    letters = conversions(text) if text is not None else None
    return letters or [], list(call.arguments[texts[at] + 1 :])


def _is_number(scope: Scope, value: Node) -> bool:
    if value.type in ("number_literal", "true", "false"):
        return True
    meaning = resolve(scope, value)
    return isinstance(meaning, Variable) and meaning.type != TEXT
