"""A node as an open component: what it received and published by the recording, in real time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from rebsync.checker.program import Cell, Program
from rebsync.conform.components.bodies import ComponentBodies
from rebsync.conform.components.spool import Spool
from rebsync.conform.recording import Place
from rebsync.records import dataclass

UNORDERED = -1  # the lane of messages whose publisher is not known
CONNECTS = 2.0  # s after a node has shown itself in which its topics may not be connected yet

Cells = tuple[Cell, ...]


class Input(NamedTuple):
    """A recorded message that a rebec receives; those of a lane come in their order.

    `may_drop`: so many came together that a queue of the code may have been full. It came at
    `earliest`, in seconds; `is_kept`: its publisher may keep it for who connects later (latched
    topics, durability "transient local"), so that the rebec may have got it later.
    """

    stamp: float
    server: int
    cells: Cells
    lane: int
    may_drop: bool
    earliest: float
    is_kept: bool


class Output(NamedTuple):
    """A recorded message that a rebec has published."""

    stamp: float
    cells: Cells
    values: tuple[object, ...]
    file: int
    number: int

    @property
    def place(self) -> Place:
        """Where in the recordings it is."""
        return Place(self.file, self.number)


@dataclass(frozen=True, slots=True)
class Timing:
    """Seconds: a unit of the model; by how much the code and the network may be late; where a
    recording begins and ends; and when the node showed itself first."""

    unit: float
    slack: float
    begin: float
    end: float
    first: float


@dataclass(frozen=True, slots=True)
class Component:
    """A rebec with all that was recorded of it.

    `inputs` go by stamps; `outputs` are those of each topic in `topics`, which are known by the
    environment's servers. `conflicts` are pairs of servers whose bodies may disturb each other
    where they run in threads. `is_bounded`: a queue of the code may become full. `kept` says of
    each topic by how many seconds the first message may be older than its stamp, as the recorder
    got it when it connected.
    """

    program: Program
    rebec: int
    bodies: ComponentBodies
    timing: Timing
    inputs: Spool[Input]
    topics: tuple[str, ...]
    outputs: tuple[Sequence[Output], ...]
    by_server: dict[int, int]
    kept: tuple[float, ...]
    conflicts: frozenset[tuple[int, int]] = frozenset()
    in_threads: bool = False
    is_bounded: bool = True

    @property
    def name(self) -> str:
        """The name of the rebec."""
        return self.program.rebecs[self.rebec].name

    def started_while_recorded(self) -> Component:
        """The same of a node that was started then: who recorded had soon connected to it."""
        return replace(self, kept=tuple(min(old, CONNECTS) for old in self.kept))
