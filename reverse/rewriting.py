"""Pieces of a model with something else in the place of some of their parts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from typing import TypeVar

from rebsync import model as m

_Node = TypeVar("_Node")


def rewritten(node: _Node, change: Callable[[object], object]) -> _Node:
    """The node with each part below it, then itself, replaced by what `change` makes of it."""
    changed: dict[str, object] = {}
    for each in fields(node):  # type: ignore[arg-type]
        if not each.compare:
            continue
        before = getattr(node, each.name)
        after = _rewritten(before, change)
        if after is not before:
            changed[each.name] = after
    whole = replace(node, **changed) if changed else node  # type: ignore[type-var]
    result = change(whole)
    assert isinstance(result, object)
    return result  # type: ignore[return-value]


def _rewritten(value: object, change: Callable[[object], object]) -> object:
    if isinstance(value, tuple):
        parts = tuple(_rewritten(v, change) for v in value)
        same = all(a is b for a, b in zip(parts, value, strict=True))
        return value if same else parts
    return rewritten(value, change) if hasattr(value, "__dataclass_fields__") else value


def renamed(node: m.Statement, old: str, new: str) -> m.Statement:
    """The statement with another name for a variable."""

    def change(part: object) -> object:
        return replace(part, name=new) if isinstance(part, m.Name) and part.name == old else part

    return rewritten(node, change)
