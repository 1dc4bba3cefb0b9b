"""The typed syntax tree of a property file; expressions without `->` are those of a model."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import field, replace
from typing import Literal, TypeAlias

from rebsync.model import Expression
from rebsync.records import dataclass
from rebsync.source import NOWHERE, Span


def _span() -> Span:
    return field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Not:
    """`!operand`, where the operand is more than a state expression."""

    operand: Formula
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class And:
    """`left && right`, where one of them is more than a state expression."""

    left: Formula
    right: Formula
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Or:
    """`left || right`, where one of them is more than a state expression."""

    left: Formula
    right: Formula
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Implies:
    """`left -> right`; associates to the right and binds weakest."""

    left: Formula
    right: Formula
    span: Span = _span()


LtlOperator: TypeAlias = Literal["G", "F", "X", "U", "W"]
TctlOperator: TypeAlias = Literal["AG", "AF", "AU", "EG", "EF", "EU"]


@dataclass(frozen=True, slots=True)
class Ltl:
    """`G(p)`, `F(p)`, `X(p)`, `U(p, q)` or `W(p, q)`."""

    operator: LtlOperator
    operands: tuple[Formula, ...]
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class TimeBound:
    """`time <= limit` and its like; `limit` is a constant of the model or a literal."""

    comparison: Literal["<", "<=", ">", ">=", "=="]
    limit: Expression
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Tctl:
    """`AG(time <= c, p)`, `EU(p, q)` and the like; without a bound the time does not matter."""

    operator: TctlOperator
    bound: TimeBound | None
    operands: tuple[Formula, ...]
    span: Span = _span()


Formula: TypeAlias = Expression | Not | And | Or | Implies | Ltl | Tctl


@dataclass(frozen=True, slots=True)
class Define:
    """`name = value;`: a name for a formula without temporal operators, or for a number."""

    name: str
    value: Formula
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True, slots=True)
class Property:
    """`name: formula;`."""

    name: str
    formula: Formula
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True, slots=True)
class Measure:
    """A whole number or truth value that is to be measured, and its `text` as written."""

    text: str
    value: Formula


@dataclass(frozen=True, slots=True)
class TimeBetween:
    """The time from when `start` becomes true to when `end` holds; `text` names both."""

    text: str
    start: Formula
    end: Formula


@dataclass(frozen=True, slots=True)
class Properties:
    """All that a property file says."""

    defines: tuple[Define, ...] = ()
    assertions: tuple[Property, ...] = ()
    ltl: tuple[Property, ...] = ()
    tctl: tuple[Property, ...] = ()
    span: Span = _span()

    @property
    def all(self) -> tuple[Property, ...]:
        """The properties of every kind, defines aside."""
        return (*self.assertions, *self.ltl, *self.tctl)

    def named(self, names: Collection[str]) -> Properties:
        """The same with the properties of these names only."""
        return replace(
            self,
            assertions=tuple(p for p in self.assertions if p.name in names),
            ltl=tuple(p for p in self.ltl if p.name in names),
            tctl=tuple(p for p in self.tctl if p.name in names),
        )


def operands(formula: Formula) -> tuple[Formula, ...]:
    """The formulas directly below a node that is more than a state expression."""
    match formula:
        case Not(operand):
            return (operand,)
        case And(left, right) | Or(left, right) | Implies(left, right):
            return (left, right)
        case Ltl(_, below) | Tctl(_, _, below):
            return below
        case _:
            return ()


def subformulas(formula: Formula) -> Iterator[Formula]:
    """A formula and all in it, state expressions as a whole."""
    yield formula
    for below in operands(formula):
        yield from subformulas(below)


def state_expressions(formula: Formula) -> Iterator[Expression]:
    """The largest state expressions of a formula, in source order."""
    below = operands(formula)
    if not below and not isinstance(formula, Not | And | Or | Implies | Ltl | Tctl):
        yield formula
    for each in below:
        yield from state_expressions(each)
