"""Warnings of linters that a model's own way of writing would raise."""

from __future__ import annotations

from rebsync.model import (
    Binary,
    BoolLiteral,
    Declarator,
    Interface,
    Local,
    Parameter,
    ReactiveClass,
    walk,
)

_HARD_TO_READ = frozenset({"l", "O", "I"})


def silenced(declaration: ReactiveClass | Interface) -> list[str]:
    """The codes of ruff to ignore in the module of a class."""
    found = set()
    for node in walk(declaration):
        match node:
            case Binary("==" | "!=", left, right):
                if any(isinstance(e, BoolLiteral) for e in (left, right)):
                    found.add("E712")
            case Declarator(name=name) | Parameter(name=name) if name in _HARD_TO_READ:
                found.add("E741")
            case Local():
                found.add("F841")
            case _:
                pass
    return sorted(found)
