"""What a search tells, whichever engine ran it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import field
from typing import Protocol

from rebsync.checker.endless import Cut
from rebsync.checker.graph import Graph
from rebsync.checker.look import Look, unwatched
from rebsync.checker.memory import NO_MEMORY, is_scarce
from rebsync.checker.steps import Failure, Semantics
from rebsync.records import dataclass

INSTRUCTIONS = 1_000_000_000  # after which a search gives up a body, unless told otherwise


class Unavailable(Exception):
    """The compiled engine cannot be had here; the text says why."""


@dataclass(frozen=True, slots=True)
class Faults:
    """Which events are violations, besides failures: predicates that must hold, and deadlocks."""

    predicates: frozenset[int] = frozenset()
    deadlock: bool = True

    def includes(self, cause: object) -> bool:
        """Whether an event with this cause is a violation."""
        if cause == "deadlock":
            return self.deadlock
        return isinstance(cause, Failure) or cause in self.predicates


@dataclass(frozen=True, slots=True)
class Limits:
    """Bounds of a search; None is no bound, of memory what the machine has.

    `seconds` is by the wall clock. `until` bounds the model time since the start: steps that would
    pass it are left out, and the search is then incomplete. `memory` is in bytes, of the whole
    process. `instructions` are those of one run of a body. With `first` a search ends at the first
    of the `faults`. `began` is the moment by time.perf_counter from which the seconds count, else
    they count from the search.
    """

    states: int | None = None
    seconds: float | None = None
    memory: int | None = None
    until: int | None = None
    instructions: int = INSTRUCTIONS
    began: float | None = None
    faults: Faults = field(default_factory=Faults)
    first: bool = False

    def out_of_time(self, searched: float) -> str | None:
        """Why to stop after so many seconds of searching, if the time is over."""
        spent = searched if self.began is None else time.perf_counter() - self.began
        if self.seconds is None or spent < self.seconds:
            return None
        return f"the bound of {self.seconds:g} seconds was reached"

    def out_of_memory(self, used: int) -> str | None:
        """Why to stop with so many bytes in use; without a bound what the machine has is one."""
        if self.memory is None:
            return NO_MEMORY if is_scarce(used) else None
        if used < self.memory:
            return None
        return f"the bound of {self.memory} bytes of memory was reached"


def bound_of_states(states: int) -> str:
    """Why a search ends that has found so many states."""
    return f"the bound of {states} states was reached"


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a search is: `depth` is the breadth-first level, `memory` bytes in use.

    `task` is what is done after the search, while that is done; `violations` are the kinds of
    those found so far.
    """

    states: int
    transitions: int
    depth: int
    waiting: int
    seconds: float
    memory: int
    task: str = ""
    violations: tuple[str, ...] = ()


def kinds_of(causes: Iterable[object], faults: Faults) -> tuple[str, ...]:
    """The kinds of violations among the causes of events."""
    return tuple(
        cause.kind
        if isinstance(cause, Failure)
        else "deadlock"
        if cause == "deadlock"
        else "property"
        for cause in causes
        if faults.includes(cause)
    )


Report = Callable[[Progress], None]


@dataclass(frozen=True, slots=True)
class Event:
    """Something wrong, met first here: at state `state` (breadth-first number).

    `cause` is a Failure of the step with ordinal `ordinal` of that state; or the number of a
    predicate that is false in the state; or "deadlock".
    """

    cause: Failure | int | str
    state: int
    ordinal: int = -1


@dataclass(frozen=True, slots=True)
class Covered:
    """Servers (numbers) and branches (instruction, whether it jumped) that ran.

    `largest` is, for each rebec, the most places of its bag that were ever taken, the message
    being served included.
    """

    servers: frozenset[int]
    branches: frozenset[tuple[int, bool]]
    largest: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Extremes:
    """The least and greatest value of a measure, each with the first state that has it.

    States are -1 when no state has a value; `undefined` is the first that has none, or -1.
    """

    least: int
    least_state: int
    greatest: int
    greatest_state: int
    undefined: int


@dataclass(frozen=True, slots=True)
class Exploration:
    """The outcome of a search.

    `events` are in the order in which breadth-first search met them, one for each different
    cause (failures: kind and pc and rebec; predicates: number). `reason` says why the search is
    not complete, or is None; `cut` is the body that it has given up. `measured` are the measures of
    the program. `depth` is the last level
    that was entered.
    """

    states: int
    transitions: int
    depth: int
    events: tuple[Event, ...]
    covered: Covered
    semantics: Semantics
    engine: str
    seconds: float
    build_seconds: float
    memory: int
    reason: str | None = None
    notes: tuple[str, ...] = field(default=())
    cut: Cut | None = None
    measured: tuple[Extremes, ...] = ()


class Search(Protocol):
    """A breadth-first search that can be asked afterwards."""

    def run(self, limits: Limits, report: Report | None = None) -> Exploration:
        """Searches until everything is seen or a bound is reached; Ctrl-C ends it cleanly too."""

    def path(self, state: int) -> tuple[int, ...]:
        """A shortest way to a state: the code of the initial state, then of each step (an
        ordinal, see `orbits.py` for those of canonical states)."""

    def graph(self, look: Look = unwatched) -> Graph:
        """The whole state space that was seen, with its labels; `look` is called now and then."""

    def marks(self, graph: Graph) -> bytearray:
        """For each state of its graph whether it is on an endless run without time (bit 0), and
        whether a step of time or an end can be reached from it (bit 1)."""
