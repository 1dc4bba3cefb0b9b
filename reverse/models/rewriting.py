"""Pieces of a model with something else in the place of some of their parts."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace
from operator import is_
from typing import TypeVar, get_args

from rebsync import model as m

_Node = TypeVar("_Node")
_NODES = frozenset(get_args(m.Node))
# Statements, and what holds them.
STATEMENTS = frozenset({*get_args(m.Statement), m.Case, m.MessageServer, m.Method, m.Constructor})


def rewritten(
    node: _Node, change: Callable[[object], object], kinds: Collection[type] = _NODES
) -> _Node:
    """The node with each part below it, then itself, replaced by what `change` makes of it.

    Parts of other `kinds` stay as they are, with all that is in them.
    """
    changed: dict[str, object] = {}
    kind: type = type(node)
    for name in m.child_fields(kind):
        before = getattr(node, name)
        if type(before) is tuple:
            parts = tuple([rewritten(v, change, kinds) if type(v) in kinds else v for v in before])
            if not all(map(is_, parts, before)):
                changed[name] = parts
        elif type(before) in kinds:
            after = rewritten(before, change, kinds)
            if after is not before:
                changed[name] = after
    whole = replace(node, **changed) if changed else node  # type: ignore[type-var]
    result = change(whole)
    assert isinstance(result, object)
    return result  # type: ignore[return-value]


def renamed(node: m.Statement, old: str, new: str) -> m.Statement:
    """The statement with another name for a variable."""
    if not any(isinstance(n, m.Name) and n.name == old for n in m.walk(node)):
        return node  # to look is quicker than to make each part anew

    def change(part: object) -> object:
        return replace(part, name=new) if isinstance(part, m.Name) and part.name == old else part

    return rewritten(node, change)


def before_breaks(body: m.Statement, first: m.Statement) -> m.Statement:
    """The body of a loop, where a statement stands before each `break` that ends this loop."""
    match body:
        case m.Block(statements):
            found: list[m.Statement] = []
            for inner in statements:
                found += [first] if isinstance(inner, m.Break) else []
                found.append(before_breaks(inner, first))
            return replace(body, statements=tuple(found))
        case m.If(_, then, otherwise):
            last = before_breaks(otherwise, first) if otherwise is not None else None
            return replace(body, then=before_breaks(then, first), otherwise=last)
        case _:
            return body
