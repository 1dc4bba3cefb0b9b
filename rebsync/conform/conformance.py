"""The answer of `rebsync conform` as values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field
from typing import Literal, TypeAlias

from rebsync.checker.trace import TraceStep
from rebsync.conform.properties import Evaluated
from rebsync.conform.recording import Place, Served
from rebsync.records import dataclass
from rebsync.source import SourceSpan

Verdict: TypeAlias = Literal["conforms", "deviates", "violated", "undetermined"]
"""A run of the model; none; one in which the model itself breaks a rule; not known."""

Kind: TypeAlias = Literal[
    "wrong state", "swapped", "repeated", "lost message", "lost state", "late", "early",
    "unexpected", "silent", "wrong value", "second publisher", "restarted", "no start",
    "model failure",
]  # fmt: skip


@dataclass(frozen=True, slots=True)
class Allowed:
    """A step that the model allows where a recorded one is not: what a rebec serves, when."""

    rebec: str
    server: str
    arguments: str
    arrival: int
    start: int
    state: tuple[tuple[str, str], ...]
    line: int


@dataclass(frozen=True, slots=True)
class Difference:
    """A variable with another value in the recording than in each state that the model allows."""

    variable: str
    recorded: str
    allowed: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class CodePlace:
    """A line of the code, counted from 1; its `span` where the code was read as a model."""

    path: str
    line: int
    span: SourceSpan | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Deviation:
    """The first step that no run of the model has.

    `served` is what was recorded, None where a rebec is silent; `rebec` its node; `time` is the
    model's; `line` the place in the model, 0 for none, and `code` that in the package, where one
    was compared. `explanation` are sentences. `message_place` is that of a message on a topic.
    """

    kind: Kind
    rebec: str
    time: int
    message: str
    served: Served | None
    line: int
    allowed: tuple[Allowed, ...] = ()
    differences: tuple[Difference, ...] = ()
    explanation: tuple[str, ...] = ()
    code: CodePlace | None = None
    message_place: Place | None = None

    @property
    def place(self) -> Place | None:
        """Where in the recordings it is."""
        return self.served.place if self.served is not None else self.message_place


@dataclass(frozen=True, slots=True)
class Lateness:
    """By how much the clock differs from the model's time, at the end of bodies, in seconds.

    `points` are (model time, rebec, seconds), thinned out; `greatest` is the one that is
    furthest off. `basis`: where time 0 of the clock is from. `goes_back`: stamps do, by seconds.
    """

    basis: Literal["announced", "first", "none"] = "none"
    zero: float = 0.0
    greatest: tuple[int, str, float] | None = None
    points: tuple[tuple[int, str, float], ...] = ()
    goes_back: bool = False


@dataclass(frozen=True, slots=True)
class TopicInterval:
    """Seconds that messages of a rebec on a topic took, by the server that publishes them.

    "delay": since what the server got; "period": since its last one, of timers and the like.
    """

    rebec: str
    server: str
    topic: str
    kind: str
    seconds: Sequence[float]


@dataclass(frozen=True, slots=True)
class Conformance:
    """What became of comparing a recorded run with a model.

    `compared` steps fit; `recorded` were read; `start` is the model time from which on the run was
    compared. `last` are the last steps that fit. `notes` say what else was noticed.
    """

    verdict: Verdict
    compared: int
    recorded: int
    start: int
    end: int
    reason: str = ""
    deviation: Deviation | None = None
    lateness: Lateness = field(default_factory=Lateness)
    notes: tuple[str, ...] = ()
    last: tuple[Served, ...] = ()
    widest: int = 1
    properties: tuple[Evaluated, ...] = ()
    intervals: tuple[TopicInterval, ...] = ()  # of topics, where that was asked for
    run: tuple[TraceStep, ...] = ()  # the last steps of a run that fits, where that was asked for
