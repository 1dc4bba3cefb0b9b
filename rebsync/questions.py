"""A question about what a package does, in words of its topics and their fields."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.source import Span


@dataclass(frozen=True, slots=True)
class Word:
    """A field of a topic, such as `guard:/cmd_vel.linear.x`, or a constant of a message."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class QuotedText:
    """A text in quotes."""

    text: str
    span: Span


Operand: TypeAlias = Word | QuotedText | int | float | bool


@dataclass(frozen=True, slots=True)
class Comparison:
    """`left operator right`."""

    operator: str
    left: Operand
    right: Operand


@dataclass(frozen=True, slots=True)
class Truth:
    """A field that is a truth value."""

    word: Word


@dataclass(frozen=True, slots=True)
class Negation:
    operand: Condition


@dataclass(frozen=True, slots=True)
class Conjunction:
    operands: tuple[Condition, ...]


@dataclass(frozen=True, slots=True)
class Disjunction:
    operands: tuple[Condition, ...]


Condition: TypeAlias = Comparison | Truth | Negation | Conjunction | Disjunction


@dataclass(frozen=True, slots=True)
class Never:
    """`never wrong while meanwhile`: no state has both."""

    wrong: Condition
    meanwhile: Condition | None


@dataclass(frozen=True, slots=True)
class Always:
    """`always right while meanwhile`: each state in which `meanwhile` is true has both."""

    right: Condition
    meanwhile: Condition | None


@dataclass(frozen=True, slots=True)
class LeadsTo:
    """`first leads to then within 2 s`: `within` is in seconds, None for some time."""

    first: Condition
    then: Condition
    within: Fraction | None


@dataclass(frozen=True, slots=True)
class AtMost:
    """`condition at most 3 times`: it becomes true no more often."""

    condition: Condition
    times: int


@dataclass(frozen=True, slots=True)
class Messages:
    """`at most 3 messages on topic`."""

    topic: Word
    most: int


Question: TypeAlias = Never | Always | LeadsTo | AtMost | Messages


def texts_in(question: Question) -> Iterator[str]:
    """The texts that a question names."""
    match question:
        case Never(one, other) | Always(one, other) | LeadsTo(one, other):
            yield from _named(one)
            yield from _named(other) if other is not None else ()
        case AtMost(condition):
            yield from _named(condition)
        case Messages():
            return


def _named(condition: Condition) -> Iterator[str]:
    match condition:
        case Negation(operand):
            yield from _named(operand)
        case Conjunction(operands) | Disjunction(operands):
            for each in operands:
                yield from _named(each)
        case Comparison(_, left, right):
            yield from (side.text for side in (left, right) if isinstance(side, QuotedText))
        case Truth():
            return
