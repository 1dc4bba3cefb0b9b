"""Possible states of the model: those that fit what was observed so far."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, NamedTuple, TypeAlias

from rebsync.checker.steps import Failure
from rebsync.conform.graph import Node
from rebsync.conform.recording import Served
from rebsync.conform.stream import Positions

Reason: TypeAlias = Literal["step", "time", "silent", "end"]
"""Why a possible state has no successor that fits: nobody's step fits; time would pass something
that was observed; a rebec ends a body that was not observed; nothing can happen any more."""


class Config(NamedTuple):
    """A possible state: how far it has come with the observations of each rebec.

    `begun` has the rebecs that serve something of which no observation was near when they took
    it, with the times when.
    """

    node: Node
    positions: Positions
    begun: tuple[tuple[int, int], ...] = ()


class Dead(NamedTuple):
    """A possible state that no step leads on from, at a time; `rebec` is to blame, or -1."""

    config: Config
    time: int
    reason: Reason
    rebec: int = -1
    failures: tuple[Failure, ...] = ()


Observer: TypeAlias = Callable[[list[Served]], None]
