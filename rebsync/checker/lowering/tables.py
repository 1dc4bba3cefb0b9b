"""The cells of constants that are arrays."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.checker.lowering.emitter import kind_of
from rebsync.checker.program import Cell, Kind
from rebsync.checker.values import stored
from rebsync.model import ArrayInitializer, Declarator, Initializer, Type
from rebsync.static import Analysis


def env_table(declaration: Declarator, type_: Type, analysis: Analysis) -> tuple[Cell, ...]:
    """The cells of a constant of the model."""
    assert declaration.initial is not None
    return tuple(_cells(declaration.initial, kind_of(type_), analysis))


def _cells(initial: Initializer, kind: Kind, analysis: Analysis) -> Iterator[Cell]:
    if isinstance(initial, ArrayInitializer):
        for part in initial.values:
            yield from _cells(part, kind, analysis)
        return
    value = analysis.value_of(initial)
    assert value is not None, initial
    yield stored(value, kind)
