"""Moves of robots as instructions, for whoever wants to know the ways that a run makes them go."""

from __future__ import annotations

from rebsync.checker.lowering.emitter import Emitter
from rebsync.checker.lowering.expressions import as_kind
from rebsync.model import (
    Binary,
    BoolLiteral,
    Cast,
    Conditional,
    Empty,
    Index,
    IntLiteral,
    Member,
    Name,
    Paren,
    Self,
    Type,
    Unary,
    walk,
)
from rebsync.static.movement import Offset, movement

_WITHOUT_EFFECT = (
    BoolLiteral, Cast, Conditional, Index, IntLiteral, Member, Name, Paren, Self, Type,
)  # fmt: skip


def moves(node: Empty, e: Emitter) -> None:
    """The moves that an empty statement stands for, where the program is to have them."""
    if not e.world.moves:
        return
    for annotation in node.annotations:
        step = movement(annotation) if annotation.name == "Move" else None
        if step is None:
            continue
        with e.at(annotation.span):
            known = all(_is_harmless(offset) for offset in (step.x, step.y))
            if known:
                _push(step.x, e)
                _push(step.y, e)
            e.emit("MOVE", int(known))


def _push(offset: Offset, e: Emitter) -> None:
    if offset.amount is None:
        e.emit("CONST", 0)
        return
    as_kind(offset.amount, "int", e)
    if offset.operator == "-":
        e.emit("NEG")


def _is_harmless(offset: Offset) -> bool:
    """Whether the amount changes nothing, chooses nothing and divides by nothing.

    Choices would be others than those of the steps, and a failure is none of the model's.
    """
    return offset.amount is None or all(_is_plain(each) for each in walk(offset.amount))


def _is_plain(node: object) -> bool:
    match node:
        case Binary(operator):
            return operator not in ("/", "%")
        case Unary(operator):
            return operator not in ("++", "--")
        case _:
            return isinstance(node, _WITHOUT_EFFECT)
