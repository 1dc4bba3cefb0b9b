"""States: a tuple with one `Local` for each rebec, all times counted from the present moment."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

from rebsync.checker.program import NO_DEADLINE, Cell


class Message(NamedTuple):
    """A message in a bag; in this order of fields the messages of a bag are sorted.

    `arrival` and `deadline` count from the present moment, so they fall as time goes by;
    `deadline` is NO_DEADLINE when there is none. A constructor that is suspended stands as the
    server -1 with its rebec as sender.
    """

    arrival: int
    server: int
    sender: int
    deadline: int
    arguments: tuple[Cell, ...]


class Frame(NamedTuple):
    """A suspended body: where it goes on, and its live cells, operands included."""

    pc: int
    cells: tuple[Cell, ...]


class Point(NamedTuple):
    """Where a rebec is suspended: the message that it serves and its frames, outermost first."""

    message: Message
    frames: tuple[Frame, ...]


class Local(NamedTuple):
    """The state of one rebec.

    `busy` is the time until it can act again; `point` is where it then goes on (exact view only).
    `clock` is the global time in a model that reads it, else 0.
    """

    variables: tuple[Cell, ...]
    bag: tuple[Message, ...]
    busy: int = 0
    point: Point | None = None
    clock: int = 0

    @property
    def places(self) -> int:
        """How many messages take a place: the one being served still does."""
        return len(self.bag) + (self.point is not None and self.point.message.server >= 0)


State: TypeAlias = tuple[Local, ...]


def later(local: Local, time: int, clocked: bool) -> Local:
    """The local state when so much time has passed."""
    if time == 0:
        return local
    bag = tuple(_later(m, time) for m in local.bag)
    point = local.point and Point(_later(local.point.message, time), local.point.frames)
    clock = local.clock + time if clocked else 0
    return Local(local.variables, bag, max(local.busy - time, 0), point, clock)


def _later(message: Message, time: int) -> Message:
    deadline = message.deadline
    return message._replace(
        arrival=message.arrival - time,
        deadline=deadline if deadline == NO_DEADLINE else deadline - time,
    )
