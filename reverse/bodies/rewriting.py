"""Pieces of a model with something else in the place of some of their parts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from functools import cache
from typing import TypeVar

from rebsync import model as m

_Node = TypeVar("_Node")


def rewritten(node: _Node, change: Callable[[object], object]) -> _Node:
    """The node with each part below it, then itself, replaced by what `change` makes of it."""
    changed: dict[str, object] = {}
    kind: type = type(node)
    for name in _parts(kind):
        before = getattr(node, name)
        after = _rewritten(before, change)
        if after is not before:
            changed[name] = after
    whole = replace(node, **changed) if changed else node  # type: ignore[type-var]
    result = change(whole)
    assert isinstance(result, object)
    return result  # type: ignore[return-value]


def _rewritten(value: object, change: Callable[[object], object]) -> object:
    if isinstance(value, tuple):
        parts = tuple(_rewritten(v, change) for v in value)
        same = all(a is b for a, b in zip(parts, value, strict=True))
        return value if same else parts
    kind: type = type(value)
    return rewritten(value, change) if _is_node(kind) else value


@cache
def _parts(kind: type) -> tuple[str, ...]:
    return tuple(f.name for f in fields(kind) if f.compare)


@cache
def _is_node(kind: type) -> bool:
    return is_dataclass(kind)


def renamed(node: m.Statement, old: str, new: str) -> m.Statement:
    """The statement with another name for a variable."""

    def change(part: object) -> object:
        return replace(part, name=new) if isinstance(part, m.Name) and part.name == old else part

    return rewritten(node, change)
