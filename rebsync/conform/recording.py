"""What a recording tells, as values: bodies that nodes have served, and messages on topics."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, Protocol, TypeAlias


class Place(NamedTuple):
    """Where in the recordings a message is: the number of the file, and of the message in it."""

    file: int
    number: int


class Served(NamedTuple):
    """A state message (docs/decisions/0001): a body that a rebec has run, and its state after it.

    `rebec` is the number of the rebec in `main`; times are the model's, as the node has said;
    `cells` are its state variables as the checker stores them. `stamp` is when the recording got
    it, in seconds; `publisher` is the node that sent it, where the recording says so.
    """

    rebec: int
    server: str
    arguments: str
    arrival: int
    start: int
    now: int
    cells: tuple[int, ...]
    stamp: float
    place: Place
    publisher: str = ""


class Sent(NamedTuple):
    """A message on the topic of a message server: what the sender said of it.

    `receiver` is the number of the rebec; `arrival` and `deadline` are None where they are not in
    the message, as in code that people wrote.
    """

    receiver: int
    server: str
    arguments: str
    arrival: int | None
    deadline: int | None
    stamp: float
    place: Place
    publisher: str = ""


class Announced(NamedTuple):
    """The common time 0 that a node has said, in seconds of the ROS clock (decision 23)."""

    rebec: str
    zero: float
    stamp: float
    place: Place


class Ticked(NamedTuple):
    """A message of `/clock`: the simulated time, and when it was recorded."""

    time: float
    stamp: float
    place: Place


class Driven(NamedTuple):
    """A velocity that a robot was told (cmd_vel), from `stamp` on: m/s and rad/s."""

    rebec: int
    x: float
    y: float
    turn: float
    stamp: float
    place: Place


class Heard(NamedTuple):
    """A message on a topic of nodes that people wrote: the values of those fields that count.

    There are many, and they lie in files: so the place is two numbers.
    """

    topic: str
    values: tuple[object, ...]
    stamp: float
    file: int
    number: int
    publisher: str = ""

    @property
    def place(self) -> Place:
        """Where it is."""
        return Place(self.file, self.number)


class Truncated(NamedTuple):
    """Where a file cannot be read on, and why: what was recorded after that is not known."""

    why: str
    stamp: float
    place: Place


Event: TypeAlias = "Served | Sent | Announced | Ticked | Driven | Heard | Truncated"


class Recording(Protocol):
    """Recordings of one run, merged by time; each call of `events` reads them from the start."""

    @property
    def paths(self) -> tuple[str, ...]:
        """The files, in the order of `Place.file`."""
        ...

    def events(self, with_sent: bool = False) -> Iterator[Event]:
        """What was recorded, by stamps; the messages between rebecs only where asked for."""
        ...
