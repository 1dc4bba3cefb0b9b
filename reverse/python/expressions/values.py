"""Values of Python as expressions of the model, with their kinds."""

from __future__ import annotations

from typing import TypeAlias

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.models.building import bare, chosen
from rebsync.reverse.models.texts import TEXT
from rebsync.static.types import BOOLEAN, DOUBLE, INT

# What a variable holds in all of a program: a kind of value, a message by its type, or anything.
Kind: TypeAlias = str
TRUTH, WHOLE, REAL, STRING, OTHER = "boolean", "int", "double", TEXT.name, "other"
TYPES = {TRUTH: BOOLEAN, WHOLE: INT, REAL: DOUBLE, STRING: TEXT}


@dataclass(frozen=True, slots=True)
class Value:
    """An expression of the model, and what kind of value it is in Python.

    `single` says that the model has 32 bits of a float; `mixed` that it may be a whole number, or
    None instead of a text.
    """

    expression: m.Expression
    kind: Kind
    single: bool = False
    mixed: bool = False


def as_number(value: Value) -> Value:
    """A truth value as Python computes with it, 1 or 0; other values as they are."""
    if value.kind != TRUTH:
        return value
    match bare(value.expression):
        case m.BoolLiteral(truth):
            return Value(m.IntLiteral(int(truth)), WHOLE)
        case expression:
            return Value(chosen(expression, m.IntLiteral(1), m.IntLiteral(0)), WHOLE)
