"""Variables and elements of arrays: where they are, how they are read and stored."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from rebsync.checker.lowering.emitter import Emitter, kind_of, size_of
from rebsync.checker.program import Cell, Kind
from rebsync.model import Type
from rebsync.records import dataclass
from rebsync.static.types import element


@dataclass(frozen=True, slots=True)
class Place:
    """Cells from `start` on, in the rebec's variables, the frame, or rebec number `rebec`.

    `offset` is the cell of the frame that holds a computed offset; "pushed" says that the offset
    is on the stack; None that there is none. A `table` holds the constants of an env array, and
    `constant` says which one it is.
    """

    root: Literal["VAR", "LOCAL", "STATE", "TABLE"]
    start: int
    type: Type
    rebec: int = 0
    offset: int | Literal["pushed"] | None = None
    table: tuple[Cell, ...] = ()
    constant: str = ""

    @property
    def kind(self) -> Kind:
        return kind_of(self.type)

    @property
    def size(self) -> int:
        return size_of(self.type)


def kept(place: Place, e: Emitter) -> Place:
    """The place with a pushed offset moved into the frame, so that it can be used again."""
    if place.offset != "pushed":
        return place
    cell = e.allocate(1)
    e.emit("SETLOCAL", cell)
    return replace(place, offset=cell)


def index_by(place: Place, index: int, e: Emitter) -> Place:
    """The element at a constant index inside of the array."""
    inner = element(place.type)
    return replace(place, start=place.start + index * size_of(inner), type=inner)


def index_pushed(place: Place, e: Emitter) -> Place:
    """The element at the index on the stack; above an offset that was pushed before."""
    inner = element(place.type)
    e.emit("OFFSET", place.type.dimensions[0], size_of(inner))
    if place.offset is not None:
        e.emit("ADD")
    return replace(place, type=inner, offset="pushed")


def push(place: Place, e: Emitter) -> None:
    """Pushes the cells of a place."""
    if place.size == 1:
        _push_cell(place, 0, e)
        return
    with e.scope():
        fixed = kept(place, e)
        for cell in range(place.size):
            _push_cell(fixed, cell, e)


def _push_cell(place: Place, cell: int, e: Emitter) -> None:
    start = place.start + cell
    if place.offset is None:
        match place.root:
            case "STATE":
                e.emit("STATE", place.rebec, start)
            case "TABLE":
                mark = e.mark(place.constant and f"{place.constant}[{start}]")
                e.emit("CONST", place.table[start], mark)
            case _:
                e.emit(place.root, start)
        return
    if isinstance(place.offset, int):
        e.emit("LOCAL", place.offset)
    match place.root:
        case "STATE":
            e.emit("STATEAT", place.rebec, start)
        case "TABLE":
            e.emit("TABLE", e.mark(place.constant), start, place.table[start:])
        case _:
            e.emit(f"{place.root}AT", start)


def store(place: Place, e: Emitter) -> None:
    """Pops the cells of a value into a place whose offset is not on the stack, or is under one."""
    if place.size == 1 and not isinstance(place.offset, int):
        suffix = "" if place.offset is None else "AT"
        e.emit(f"SET{place.root}{suffix}", place.start)
        return
    with e.scope():
        fixed, value = place, e.allocate(1)
        for cell in reversed(range(place.size)):
            _store_cell(fixed, cell, value, e)


def _store_cell(place: Place, cell: int, value: int, e: Emitter) -> None:
    if place.offset is None:
        e.emit(f"SET{place.root}", place.start + cell)
        return
    assert isinstance(place.offset, int)
    e.emit("SETLOCAL", value)
    e.emit("LOCAL", place.offset)
    e.emit("LOCAL", value)
    e.emit(f"SET{place.root}AT", place.start + cell)
