"""Texts that are filled in: `"%s_x" % name` and `"{}_x".format(name)`."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.python.values.py_evaluator import PyEvaluator
from rebsync.reverse.python.values.py_worth import Items, Table, Value, Ways
from rebsync.reverse.syntax.py_index import Scope, arguments_of

_PERCENT = re.compile(r"%(?:\((\w+)\))?([-+# 0]*)(\d*)(?:\.(\d+))?([%a-zA-Z])")
_BRACES = re.compile(r"\{\{|\}\}|\{(\w*)((?:\.\w+|\[\w+\])*)(![rsa])?(:[^{}]*)?\}")


def formatted(values: PyEvaluator, text: Value, given: Ways, node: Node, scope: Scope) -> Ways:
    """What `text % given` is."""
    if not isinstance(text, str):
        return (values.unknown("a text with a place to fill in", node, scope),)
    parts: list[Ways] = []
    fillings = _fillings(given)
    at = index = 0
    for match in _PERCENT.finditer(text):
        parts.append((text[at : match.start()],))
        at = match.end()
        if match[5] == "%":
            parts.append(("%",))
        elif match[1] is not None:
            parts.append(_keyed(given, match[1]))
        else:
            parts.append(_as_written(fillings[index], match) if index < len(fillings) else ())
            index += 1
    return values.join([*parts, (text[at:],)], node, scope)


def _fillings(given: Ways) -> list[Ways]:
    match given:
        case (Items(each),):
            return list(each)
        case _:
            return [given]


def _keyed(given: Ways, key: str) -> Ways:
    for value in given:
        if isinstance(value, Table):
            return tuple(v for k, ways in value.pairs if k == (key,) for v in ways)
    return ()


def _as_written(ways: Ways, match: re.Match[str]) -> Ways:
    """Values as a conversion writes them; those that are no numbers as they are."""
    plain = match[5] in "sdi" and not match[2] and not match[3] and match[4] is None
    if plain:
        return ways
    pattern = f"%{match[2]}{match[3]}{'.' + match[4] if match[4] is not None else ''}{match[5]}"
    return tuple(_written(v, pattern) for v in ways)


def _written(value: Value, pattern: str) -> Value:
    if not isinstance(value, (bool, int, float, str)):
        return value
    try:
        return pattern % value
    except (TypeError, ValueError):
        return value


def filled(values: PyEvaluator, text: str, call: Node, scope: Scope) -> Ways:
    """What `text.format(...)` is."""
    plain, keywords = arguments_of(call)
    parts: list[Ways] = []
    at = index = 0
    for match in _BRACES.finditer(text):
        parts.append((text[at : match.start()],))
        at = match.end()
        if match[0] in ("{{", "}}"):
            parts.append((match[0][0],))
            continue
        name = match[1]
        if not name:
            name, index = str(index), index + 1
        found = plain[int(name)] if name.isdigit() and int(name) < len(plain) else None
        found = found if found is not None else keywords.get(name)
        is_open = found is None or match[2] or (match[4] or "").strip(":sd")
        unknown = values.unknown("a format that is not followed", call, scope)
        parts.append((unknown,) if found is None or is_open else values.ways(found, scope))
    return values.join([*parts, (text[at:],)], call, scope)
