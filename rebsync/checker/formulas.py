"""Temporal formulas over numbered predicates: what the property file says, defines expanded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

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
