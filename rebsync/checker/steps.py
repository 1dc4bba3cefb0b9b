"""Steps from state to state, and what can go wrong in one: the interface of both engines."""

from __future__ import annotations

from typing import Literal, Protocol, TypeAlias

from rebsync.checker.state import State
from rebsync.records import dataclass

Semantics: TypeAlias = Literal["tts", "ftts", "core"]
FailureKind: TypeAlias = Literal[
    "assertion", "deadline", "overflow", "index", "division", "null", "time"
]
ViolationKind: TypeAlias = Literal[FailureKind, "property", "deadlock", "zeno"]
TIME = -1  # the actor of a step that only lets time pass


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a step has no successor; `pc` is the instruction that failed.

    For a missed deadline `pc` is the entry of the server's body; for an overflow it is the send,
    and `rebec` the receiver; else `rebec` is the one that acts. `text` is that of an assertion.
    """

    kind: FailureKind
    pc: int
    rebec: int
    text: str = ""


@dataclass(frozen=True, slots=True)
class Action:
    """What happens in a step: who acts, on which slot of its bag (-1: it resumes), what it chose.

    `choices` are the positions of the chosen options, in the order of evaluation.
    """

    actor: int
    slot: int = -1
    choices: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Step:
    """An action with its result: a state, reached after `time` units, or a failure."""

    action: Action
    result: State | Failure
    time: int = 0


class View(Protocol):
    """What a model does, seen as states and steps; the order of steps is always the same."""

    semantics: Semantics

    def initial_states(self) -> tuple[Step, ...]:
        """The states at time 0, or the failures of constructors; one for each way to choose."""

    def steps(self, state: State) -> tuple[Step, ...]:
        """All that can happen: rebecs in the order of main, messages of the bag, choices."""

    def next_state(self, state: State, action: Action) -> Step | None:
        """The step that an action makes, or None when the state does not allow it."""

    def is_deadlock(self, state: State) -> bool:
        """Whether all bags are empty and nobody is suspended."""
