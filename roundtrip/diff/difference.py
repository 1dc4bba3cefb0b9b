"""Differences between two models as values; each can explain itself in one line.

The first of the two models is called left, the second right: mostly a model and what its code says.
"""

from __future__ import annotations

from enum import Enum
from typing import TypeAlias

from rebsync.diagnostics import Diagnostic, Findings
from rebsync.records import dataclass
from rebsync.source import NOWHERE, Source, SourceSpan, Span
from rebsync.unions import assert_never

_LONGEST = 72
_AROUND = 20  # of what two long texts have in common before they differ


class Depth(Enum):
    """What counts as a difference.

    IDENTICAL: everything but layout and comments. EQUAL: not the names of locals, the order of
    declarations, parentheses and braces without meaning, nor how a constant is written.
    """

    IDENTICAL = "identical"
    EQUAL = "equal"


class Aspect(Enum):
    """What of an element or a statement is different."""

    TYPE = "type"
    QUEUE_LENGTH = "queue length"
    EXTENDS = "base class"
    IMPLEMENTS = "interfaces"
    ABSTRACT = "abstract"
    ANNOTATION = "annotations"
    INITIAL = "initial value"
    PARAMETERS = "parameters"
    BINDING = "binding"
    ARGUMENT = "argument"
    RECEIVER = "receiver"
    AFTER = "after"
    PERIOD = "period"
    DEADLINE = "deadline"
    DELAY = "delay"
    CONDITION = "condition"
    EXPRESSION = "expression"
    BODY = "body"
    SECTIONS = "sections"
    TOPIC = "topic"
    PRIORITY = "priority"
    SETTING = "setting"


@dataclass(frozen=True, slots=True)
class Place:
    """A place in a text."""

    source: Source
    span: Span

    @property
    def line(self) -> int | None:
        """The line, counted from 1; None for a place that is a whole file."""
        if self.span is NOWHERE:
            return None
        return self.source.position(self.span.start).line

    def begins_in(self, other: Place) -> bool:
        """Whether it begins within another place."""
        is_there = self.source.path == other.source.path
        return is_there and other.span.start <= self.span.start <= other.span.end

    def __str__(self) -> str:
        return self.source.path if self.line is None else f"{self.source.path}:{self.line}"


def place(span: Span, source: Source) -> Place | None:
    """Where a span of a model is: in the code it was read from, or else in `source`."""
    if isinstance(span, SourceSpan):
        return Place(span.source, span)
    return Place(source, span) if span != NOWHERE else None


@dataclass(frozen=True, slots=True)
class Element:
    """A part of a model that has a name: its kind and its path, as markers have them.

    Kinds are model, env, reactiveclass, interface, statevar, knownrebec, constructor, msgsrv,
    method, parameter, main and rebec. The path is that of the left model, if it is in there.
    """

    kind: str
    path: str

    def __str__(self) -> str:
        return f"{self.kind} {self.path}".rstrip()

    @property
    def group(self) -> str:
        """The class that the element belongs to; empty for `env`, main and rebecs."""
        return "" if self.kind in ("model", "env", "main", "rebec") else self.path.split(".")[0]


@dataclass(frozen=True, slots=True)
class Added:
    """An element that only the right model has; `left` is where it would be."""

    element: Element
    left: Place | None
    right: Place | None


@dataclass(frozen=True, slots=True)
class Removed:
    """An element that only the left model has; `right` is where it would be."""

    element: Element
    left: Place | None
    right: Place | None


@dataclass(frozen=True, slots=True)
class Renamed:
    """An element that the right model has under another name.

    `name` is its path there; for a parameter only the name.
    """

    element: Element
    name: str
    left: Place | None
    right: Place | None


@dataclass(frozen=True, slots=True)
class Moved:
    """An element that the right model has elsewhere: `to` says where."""

    element: Element
    to: str
    left: Place | None
    right: Place | None


@dataclass(frozen=True, slots=True)
class Changed:
    """An aspect of an element or, if `of` names a part of it such as a statement, of that part."""

    element: Element
    aspect: Aspect
    of: str
    old: str
    new: str
    left: Place | None
    right: Place | None


@dataclass(frozen=True, slots=True)
class StatementInserted:
    """A statement that only the right body has; `left` is where it would be."""

    element: Element
    text: str
    left: Place | None
    right: Place | None


@dataclass(frozen=True, slots=True)
class StatementRemoved:
    """A statement that only the left body has; `right` is where it would be."""

    element: Element
    text: str
    left: Place | None
    right: Place | None


@dataclass(frozen=True, slots=True)
class StatementMoved:
    """A statement that the right body has elsewhere."""

    element: Element
    text: str
    left: Place | None
    right: Place | None


@dataclass(frozen=True, slots=True)
class Undetermined:
    """A place of which it is not known whether the two say the same."""

    element: Element
    why: str
    left: Place | None
    right: Place | None


Difference: TypeAlias = (
    Added
    | Removed
    | Renamed
    | Moved
    | Changed
    | StatementInserted
    | StatementRemoved
    | StatementMoved
    | Undetermined
)


@dataclass(frozen=True, slots=True)
class Comparison:
    """All differences between two models, in the order of the left one."""

    differences: tuple[Difference, ...]

    @property
    def is_empty(self) -> bool:
        """Whether the two are known to be the same."""
        return not self.differences

    @property
    def is_undetermined(self) -> bool:
        """Whether there is something of which it is not known."""
        return any(isinstance(d, Undetermined) for d in self.differences)

    @property
    def elements(self) -> frozenset[Element]:
        """The elements that are different."""
        return frozenset(d.element for d in self.differences)

    @property
    def renamed_classes(self) -> dict[str, str]:
        """The classes that have another name in the right model, with that."""
        found = (d for d in self.differences if isinstance(d, Renamed))
        return {d.element.path: d.name for d in found if d.element.kind == "reactiveclass"}


def explain(difference: Difference) -> str:
    """What is different, without the element."""
    match difference:
        case Added():
            return "added"
        case Removed():
            return "removed"
        case Renamed(name=name):
            return f"renamed to {name}"
        case Moved(to=to):
            return f"moved {to}"
        case Changed():
            return _change(difference)
        case StatementInserted(text=text):
            return f"statement inserted: {clipped(text)}"
        case StatementRemoved(text=text):
            return f"statement removed: {clipped(text)}"
        case StatementMoved(text=text):
            return f"statement moved: {clipped(text)}"
        case Undetermined(why=why):
            return f"undetermined: {why}"
        case _:
            assert_never(difference)


def _change(change: Changed) -> str:
    what = f"{change.aspect.value} of {change.of}" if change.of else change.aspect.value
    if not change.old:
        return f"{what} added: {clipped(change.new)}"
    if not change.new:
        return f"{what} removed: {clipped(change.old)}"
    old, new = both_clipped(change.old, change.new)
    if old == new:
        return f"{what} is written alike, and means something else: {old}"
    return f"{what} changed from {old} to {new}"


def both_clipped(old: str, new: str) -> tuple[str, str]:
    """Two texts, each on one line; of long ones the part where they begin to differ."""
    first, second = " ".join(old.split()), " ".join(new.split())
    same = next((i for i, (a, b) in enumerate(zip(first, second, strict=False)) if a != b), 0)
    if same <= _AROUND or max(len(first), len(second)) <= _LONGEST:
        return clipped(first), clipped(second)
    start = same - _AROUND
    return f"...{clipped(first[start:])}", f"...{clipped(second[start:])}"


def clipped(text: str) -> str:
    """A text on one line that is not too long."""
    line = " ".join(text.split())
    return line if len(line) <= _LONGEST else f"{line[: _LONGEST - 3]}..."


def finding(place: Place | None, code: str, message: str, hint: str) -> Findings:
    """A finding at a place of the model or of the code."""
    source = place.source if place is not None else Source("", "")
    span = place.span if place is not None else NOWHERE
    return Findings(source, (Diagnostic(code, Span(span.start, span.end), message, hint),))
