"""What a body does to the robot that runs it: it moves, and lets time pass."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias


class Moved(NamedTuple):
    """A `@Move`, `elapsed` units after the body began to run and after `sends` of its messages.

    The offsets are in cells, and None where they cannot be computed without an effect.
    """

    elapsed: int
    sends: int
    x: int | None
    y: int | None


class Delayed(NamedTuple):
    """A delay of `time` units that begins; `pc` is its instruction."""

    elapsed: int
    sends: int
    time: int
    pc: int


Course: TypeAlias = Moved | Delayed
