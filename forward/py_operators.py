"""How tightly Python's operators bind, and where that differs from the model's."""

from __future__ import annotations

import struct

from rebsync.literals import plain_float
from rebsync.records import dataclass

TERNARY, NOT, COMPARISON, UNARY, ATOM = 1, 4, 5, 12, 15
BINARY = {
    "or": 2,
    "and": 3,
    **dict.fromkeys(("<", "<=", ">", ">=", "==", "!="), COMPARISON),
    "|": 6,
    "^": 7,
    "&": 8,
    **dict.fromkeys(("<<", ">>"), 9),
    **dict.fromkeys(("+", "-"), 10),
    **dict.fromkeys(("*", "/", "%"), 11),
}


@dataclass(frozen=True, slots=True)
class Text:
    """An expression in Python and how tightly its operator binds."""

    text: str
    level: int

    def at(self, least: int) -> str:
        """The text where an operator that binds at a level takes it."""
        return self.text if self.level >= least else f"({self.text})"


def atom(text: str) -> Text:
    """An expression that no operator can tear apart."""
    return Text(text, ATOM)


def float_literal(literal: str) -> str:
    """A literal of the model: float unless it says double."""
    digits, suffix = literal.replace("_", ""), ""
    if digits[-1] in "dDfF":
        digits, suffix = digits[:-1], digits[-1].lower()
        digits += "" if set(digits) & set(".eE") else ".0"
    digits = plain_float(digits)
    if suffix:
        return f"float{64 if suffix == 'd' else 32}({digits})"
    value = float(digits)
    try:
        single: float = struct.unpack("f", struct.pack("f", value))[0]
    except OverflowError:
        return f"float32({digits})"
    return digits if single == value else f"float32({digits})"
