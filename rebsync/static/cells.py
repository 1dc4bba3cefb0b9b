"""The cell that a robot is in, by its state variables: expressions, and what they evaluate to."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator, Mapping
from itertools import product

from rebsync.model import (
    Binary,
    Cast,
    Conditional,
    Expression,
    Index,
    IntLiteral,
    Member,
    Name,
    Paren,
    Self,
    Unary,
)
from rebsync.records import dataclass
from rebsync.static.constants import Value, constant
from rebsync.static.symbols import ClassInfo, EnvSymbol

_NUMBER = re.compile(r"-?\d+(\.\d+)?")


@dataclass(frozen=True, slots=True)
class Start:
    """The cell in which a robot starts.

    `told_by` are the expressions over its state that give the cell, None for a coordinate that
    nothing gives: then it is drawn from 0 on, and whether it meets others cannot be said.
    """

    x: float = 0.0
    y: float = 0.0
    told_by: tuple[str | None, str | None] = (None, None)

    @property
    def known(self) -> bool:
        """Whether both coordinates are."""
        return None not in self.told_by


@dataclass(frozen=True, slots=True)
class CellOf:
    """The expressions over its state that give the cell of a robot; None where nothing does."""

    x: Expression | None = None
    y: Expression | None = None
    texts: tuple[str | None, str | None] = (None, None)

    def at(self, state: Mapping[str, str], env: Mapping[str, EnvSymbol]) -> Start:
        """The cell in which a robot is whose variables are shown so."""
        values = [_value(each, state, env) for each in (self.x, self.y)]
        x, y = (value or 0.0 for value in values)
        told = [t if v is not None else None for t, v in zip(self.texts, values, strict=True)]
        return Start(x, y, (told[0], told[1]))


def _value(
    expression: Expression | None, state: Mapping[str, str], env: Mapping[str, EnvSymbol]
) -> float | None:
    if expression is None:
        return None
    value = constant(flat(expression), lambda name: _known(name.name, state, env))
    return None if value is None or isinstance(value, bool) else float(value)


def _known(name: str, state: Mapping[str, str], env: Mapping[str, EnvSymbol]) -> Value | None:
    """The value of a variable, or a constant of the model, by its name."""
    text = state.get(name)
    if text is None:
        symbol = env.get(name)
        return symbol.value if symbol is not None else None
    if text in ("true", "false"):
        return text == "true"
    if not _NUMBER.fullmatch(text):
        return None
    return float(text) if "." in text else int(text)


def flat(expression: Expression) -> Expression:
    """The expression with elements of arrays and members of self as names: `pos[0]`, `x`."""
    name = place(expression)
    if name is not None:
        return Name(name)
    match expression:
        case Paren(inner):
            return Paren(flat(inner))
        case Unary(operator, operand):
            return Unary(operator, flat(operand))
        case Cast(type_, operand):
            return Cast(type_, flat(operand))
        case Binary(operator, left, right):
            return Binary(operator, flat(left), flat(right))
        case Conditional(condition, then, otherwise):
            return Conditional(flat(condition), flat(then), flat(otherwise))
        case _:
            return expression


def place(expression: Expression) -> str | None:
    """The name that a run shows a variable by: `x`, or `pos[0]`."""
    match expression:
        case Paren(inner):
            return place(inner)
        case Name(name) | Member(Self(), name):
            return name
        case Index(target, IntLiteral(number)):
            array = place(target)
            return None if array is None else f"{array}[{number}]"
        case _:
            return None


def variables_of(info: ClassInfo, types: Container[str] | None = None) -> Iterator[str]:
    """The names of the state variables of a class, of some types or of all: `x`, `pos[0]`."""
    for symbol in info.state:
        if symbol.type is None or (types is not None and symbol.type.name not in types):
            continue
        for index in product(*(range(n) for n in symbol.type.dimensions)):
            yield symbol.name + "".join(f"[{n}]" for n in index)
