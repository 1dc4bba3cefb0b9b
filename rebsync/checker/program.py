"""A model made ready to run: its rebecs, and its bodies as instructions of a stack machine.

Every value is a *cell*, a whole number: integers as they are, booleans as 0 or 1, rebecs by their
place in `main` (null is -1), floats and doubles by the 64 bits of the double that they equal. So
states compare bit by bit. An array is its cells in row-major order.

The meaning of each instruction is in `machine.py`; both engines run this one list.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

from rebsync.model import Type
from rebsync.records import dataclass
from rebsync.source import Span

Cell: TypeAlias = int
Kind: TypeAlias = Literal["byte", "short", "int", "float", "double", "boolean", "rebec"]
KINDS: tuple[Kind, ...] = ("byte", "short", "int", "float", "double", "boolean", "rebec")
NULL = -1
UNRANKED = 2**31 - 1  # the priority of what has no @priority: after all others
NO_DEADLINE = 2**62  # sorts after every deadline, and does not move with time
ANYBODY, ITSELF, ITS_SENDER = -1, -2, -3  # receivers as the marks of a send have them


class Instruction(NamedTuple):
    """One step of the stack machine: the name of the operation and its operands.

    A CONST that stands for a constant of the model has its kind and name among the texts: `b` is
    the number of that text plus 1. Of a TABLE that is `a`, and `b` the first element.

    The constants of a send are marks: whether its `after` is certainly more than 0, and who
    receives it (the number of a known rebec, ITSELF, ITS_SENDER, or ANYBODY when it is not known);
    those of a delay are empty unless it certainly takes time.
    """

    op: str
    a: int = 0
    b: int = 0
    constants: tuple[Cell, ...] = ()


@dataclass(frozen=True, slots=True)
class Slot:
    """A variable: `size` cells from `offset` on."""

    name: str
    type: Type
    kind: Kind
    offset: int
    size: int


@dataclass(frozen=True, slots=True)
class Body:
    """Instructions `entry` to `end` (exclusive): a server, method, constructor or predicate.

    The frame of a running body has `frame` cells: the parameters, then locals and temporaries;
    operands are pushed above it.
    """

    name: str
    entry: int
    end: int
    parameters: tuple[Slot, ...]
    frame: int


@dataclass(frozen=True, slots=True)
class Server:
    """A message server as one concrete class runs it.

    Of its messages from other rebecs the last `depth` wait, the others are lost; 0: all wait.
    """

    name: str
    class_name: str
    body: int
    priority: int
    span: Span
    depth: int = 0


@dataclass(frozen=True, slots=True)
class RebecInfo:
    """An instance in `main`; `dispatch` gives for each selector the server, or -1.

    `global_ranks` (of the whole program) decides whether `priority` ranks the rebec, or the
    priority of the message that it would take.
    """

    name: str
    class_name: str
    class_index: int
    capacity: int
    priority: int
    known: tuple[int, ...]
    state: tuple[Slot, ...]
    cells: int
    constructor: int
    arguments: tuple[Cell, ...]
    dispatch: tuple[int, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Program:
    """All of a model; `predicates` are bodies that compute one boolean from the whole state,
    `measures` bodies that compute a whole number.

    All bags together have `places` places.
    """

    code: tuple[Instruction, ...]
    spans: tuple[Span, ...]
    bodies: tuple[Body, ...]
    rebecs: tuple[RebecInfo, ...]
    servers: tuple[Server, ...]
    predicates: tuple[int, ...]
    texts: tuple[str, ...]
    global_ranks: bool
    has_delay: bool
    reads_clock: bool
    places: int
    measures: tuple[int, ...] = ()

    @property
    def observers(self) -> tuple[int, ...]:
        """The bodies that read the whole state, and change nothing."""
        return (*self.predicates, *self.measures)

    def body_at(self, pc: int) -> Body:
        """The body that an instruction belongs to."""
        return next(b for b in self.bodies if b.entry <= pc < b.end)
