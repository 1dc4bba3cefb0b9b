"""Steps from state to state, and what can go wrong in one: the interface of both engines."""

from __future__ import annotations

from typing import Literal, TypeAlias

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
