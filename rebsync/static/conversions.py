"""Checks that a value can become what its place expects."""

from __future__ import annotations

from rebsync.model import Expression, Type
from rebsync.static.scope import Body
from rebsync.static.types import casts, converts, is_boolean, is_numeric, is_rebec

_RANGES = {"byte": "-128 to 127", "short": "-32768 to 32767"}


def check_conversion(expression: Expression, source: Type, target: Type, body: Body) -> None:
    """Reports a value that does not become one of type `target` by itself."""
    if converts(source, target, body.facts.classes):
        return
    if source.name == "void":
        body.facts.error("RS302", expression.span, "this call gives no value")
        return
    message = f'a value of type "{source}" does not fit the type "{target}"'
    body.facts.error("RS302", expression.span, message, _hint(expression, source, target, body))


def _hint(expression: Expression, source: Type, target: Type, body: Body) -> str | None:
    if source.dimensions or target.dimensions:
        return "arrays must have the same element type and the same lengths"
    value = body.facts.value(expression)
    if target.name in _RANGES and isinstance(value, int) and not isinstance(value, bool):
        return f"{target} holds {_RANGES[target.name]}"
    if is_boolean(target) and is_numeric(source):
        return "write a comparison, such as x != 0"
    if casts(source, target, body.facts.classes):
        return f"cast it: ({target}) (...)"
    if is_rebec(source) and is_rebec(target):
        return f'"{source}" does not descend from "{target}"'
    return None


def check_condition(expression: Expression, type_: Type | None, of: str, body: Body) -> None:
    """Reports a condition that is not boolean."""
    if type_ is None or is_boolean(type_):
        return
    hint = "write a comparison, such as x != 0" if is_numeric(type_) else None
    message = f'the condition of {of} must be boolean, not "{type_}"'
    body.facts.error("RS304", expression.span, message, hint)
