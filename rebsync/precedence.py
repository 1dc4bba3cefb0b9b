"""How tightly operators bind: C's order, every binary operator associates to the left."""

from __future__ import annotations

from typing import Final

from rebsync import model as m

BINARY_LEVELS: Final = (
    ("||",),
    ("&&",),
    ("|",),
    ("^",),
    ("&",),
    ("==", "!="),
    ("instanceof",),
    ("<=", ">=", "<", ">"),
    ("<<", ">>"),
    ("+", "-"),
    ("*", "/", "%"),
)
LOWEST: Final = 0
BINARY: Final = {op: level for level, row in enumerate(BINARY_LEVELS, start=1) for op in row}
CHAIN: Final = 1
PREFIX: Final = len(BINARY_LEVELS) + 1
POSTFIX: Final = PREFIX + 1
CAST: Final = POSTFIX + 1
PRIMARY: Final = CAST + 1


def binding(expression: m.Expression) -> int:
    """The level of an expression's outermost operator; higher binds tighter."""
    match expression:
        case m.Assign() | m.Conditional():
            return LOWEST
        case m.Binary(operator):
            return BINARY[operator]
        case m.InstanceOf():
            return BINARY["instanceof"]
        case m.Unary():
            return PREFIX
        case m.IntLiteral(value) if value < 0:
            return PREFIX
        case m.Postfix():
            return POSTFIX
        case m.Cast():
            return CAST
        case _:
            return PRIMARY
