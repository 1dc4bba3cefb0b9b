"""Temporal formulas over numbered predicates: what the property file says, defines expanded."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, TypeAlias

from rebsync.records import dataclass

Bound: TypeAlias = tuple[Literal["<", "<=", ">", ">=", "=="], int]


@dataclass(frozen=True, slots=True)
class Atom:
    """A predicate, by its number in the program."""

    predicate: int


@dataclass(frozen=True, slots=True)
class Not:
    operand: Formula


@dataclass(frozen=True, slots=True)
class And:
    left: Formula
    right: Formula


@dataclass(frozen=True, slots=True)
class Or:
    left: Formula
    right: Formula


@dataclass(frozen=True, slots=True)
class Temporal:
    """An operator of LTL: `G F X` with one operand, `U W` with two."""

    operator: Literal["G", "F", "X", "U", "W"]
    operands: tuple[Formula, ...]


@dataclass(frozen=True, slots=True)
class Timed:
    """An operator of TCTL; `bound` limits the time at which it is fulfilled, None is no limit."""

    operator: Literal["AG", "AF", "AU", "EG", "EF", "EU"]
    bound: Bound | None
    operands: tuple[Formula, ...]


Formula: TypeAlias = Atom | Not | And | Or | Temporal | Timed


@dataclass(frozen=True, slots=True)
class NamedFormula:
    """One entry of a property file."""

    name: str
    formula: Formula


def atoms(formula: Formula) -> Iterator[int]:
    """The numbers of the predicates in a formula."""
    match formula:
        case Atom(predicate):
            yield predicate
        case Not(operand):
            yield from atoms(operand)
        case And(left, right) | Or(left, right):
            yield from atoms(left)
            yield from atoms(right)
        case Temporal(_, operands) | Timed(_, _, operands):
            for operand in operands:
                yield from atoms(operand)
