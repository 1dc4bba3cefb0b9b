"""What could not be read exactly: each with the place, the reason, and what to do about it."""

from __future__ import annotations

from collections import Counter
from dataclasses import field
from enum import Enum
from fractions import Fraction
from typing import TYPE_CHECKING

from rebsync.records import dataclass
from rebsync.source import Source, Span

if TYPE_CHECKING:  # a check that finds nothing changed loads this, and no models
    from rebsync.model import Expression

IN_THREADS = "in threads of their own"  # callbacks, in a finding: the model has fewer runs
NOT_SENT = "it is not sent in the model"  # a topic, in a finding: nobody gets what is published
COUNTS_ON = "counts on without end"  # a variable, in a finding: only very long runs differ


class Grade(Enum):
    """How much of a place of the code is in the model; what is not built need not be in it.

    Over-approximated: the model can do all that the code can, and more. Assumed: it says what the
    code does only if what is assumed there is true.
    """

    APPROXIMATED = "over-approximated"
    ASSUMED = "assumed"
    UNREADABLE = "unreadable"
    UNBUILT = "not built"


@dataclass(frozen=True, slots=True)
class Finding:
    """A place that is not in the model exactly: `within` names the callback or function."""

    grade: Grade
    source: Source
    span: Span
    why: str
    hint: str = ""
    within: str = ""

    @property
    def place(self) -> str:
        """The file and the line."""
        return f"{self.source.path}:{self.source.position(self.span.start).line}"

    @property
    def text(self) -> str:
        """The code at the place, on one line."""
        return " ".join(self.source.slice(self.span).split())


@dataclass(frozen=True, slots=True)
class Ordered:
    """An expression of a body that may depend on the order in which its parts are evaluated."""

    source: Source
    within: str
    expression: Expression


class Unread(Exception):
    """A piece of code that has no meaning in the model; caught where a statement is read."""

    def __init__(self, span: Span, why: str, hint: str = "") -> None:
        super().__init__(why)
        self.span = span
        self.why = why
        self.hint = hint


class NotWhole(Unread):
    """A time in seconds that is no whole number of units of the model's time."""

    def __init__(self, span: Span, why: str, hint: str, seconds: Fraction) -> None:
        super().__init__(span, why, hint)
        self.seconds = seconds


@dataclass(slots=True)
class Findings:
    """Collects findings, and counts the statements of each body, whether they were read or not.

    `times` are those in seconds that the model's unit of time does not divide.
    """

    all: list[Finding] = field(default_factory=list)
    statements: Counter[str] = field(default_factory=Counter)
    # Members that get values that the model cannot know: with these outside more can be read.
    open_members: set[str] = field(default_factory=set)
    times: set[Fraction] = field(default_factory=set)
    ordered: list[Ordered] = field(default_factory=list)

    def mark(self) -> tuple[int, int, Counter[str], set[str]]:
        """What there is, to go back to."""
        return len(self.all), len(self.ordered), Counter(self.statements), set(self.open_members)

    def back_to(self, marked: tuple[int, int, Counter[str], set[str]]) -> None:
        """Forgets what came since: it is read again."""
        count, ordered, statements, members = marked
        del self.all[count:], self.ordered[ordered:]
        self.statements, self.open_members = Counter(statements), set(members)

    def take(self, others: Findings) -> None:
        """Adds what was found elsewhere."""
        self.all += others.all
        self.ordered += others.ordered
        self.statements.update(others.statements)
        self.open_members |= others.open_members
        self.times |= others.times

    def unreadable(self, source: Source, unread: Unread, within: str) -> None:
        """Lists a place that the model lacks."""
        grade = Grade.UNREADABLE
        self.all.append(Finding(grade, source, unread.span, unread.why, unread.hint, within))
        if isinstance(unread, NotWhole):
            self.times.add(unread.seconds)

    def has_unreadable(self, source: Source, span: Span) -> bool:
        """Whether a place, or one around it, is listed as one that the model lacks."""
        return any(
            f.grade is Grade.UNREADABLE and f.source is source and f.span.holds(span)
            for f in self.all
        )

    def approximated(
        self, source: Source, span: Span, why: str, hint: str = "", within: str = ""
    ) -> None:
        """Lists a place of which the model allows more than the code does."""
        self.all.append(Finding(Grade.APPROXIMATED, source, span, why, hint, within))

    def assumed(
        self, source: Source, span: Span, why: str, hint: str = "", within: str = ""
    ) -> None:
        """Lists a place of which the model says what the code does only under an assumption."""
        self.all.append(Finding(Grade.ASSUMED, source, span, why, hint, within))
