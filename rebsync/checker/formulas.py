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


def parts(formula: Formula) -> Iterator[Formula]:
    """A formula and all that it is made of, each before what is in it."""
    yield formula
    match formula:
        case Atom():
            inner: tuple[Formula, ...] = ()
        case Not(operand):
            inner = (operand,)
        case And(left, right) | Or(left, right):
            inner = (left, right)
        case Temporal(_, operands) | Timed(_, _, operands):
            inner = operands
    for each in inner:
        yield from parts(each)


def atoms(formula: Formula) -> Iterator[int]:
    """The numbers of the predicates in a formula."""
    return (part.predicate for part in parts(formula) if isinstance(part, Atom))
