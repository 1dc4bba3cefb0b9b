"""Where instructions are collected: one list for the whole model, one frame for each body."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import field

from rebsync.checker.look import Look, unwatched
from rebsync.checker.program import Body, Cell, Instruction, Kind, Slot
from rebsync.model import Constructor, Declarator, MessageServer, Method, Parameter, Type
from rebsync.records import dataclass
from rebsync.source import NOWHERE, Span
from rebsync.static import Analysis
from rebsync.static.symbols import ClassInfo, ServerSymbol
from rebsync.static.types import PRIMITIVES, VOID

Declared = MessageServer | Method | Constructor
_GLANCE = 256  # instructions between two looks at the bounds
Selector = tuple[str, tuple[Type | None, ...]]


def kind_of(type_: Type) -> Kind:
    """How the cells of a type are to be read."""
    name = type_.name
    return name if name in PRIMITIVES else "rebec"  # type: ignore[return-value]


def size_of(type_: Type) -> int:
    """How many cells a value takes; `void` takes none."""
    size = 0 if type_.name == VOID.name else 1
    for length in type_.dimensions:
        size *= length
    return size


@dataclass
class World:
    """What the bodies of a model share: the instructions, and who is known by which number.

    With `moves` the `@Move` of robots are instructions too. `asks_waiting`: some body reads how
    long its message has waited.
    """

    analysis: Analysis
    look: Look = unwatched
    moves: bool = False
    asks_waiting: bool = False
    code: list[Instruction] = field(default_factory=list)
    spans: list[Span] = field(default_factory=list)
    bodies: list[Body | None] = field(default_factory=list)
    texts: dict[str, int] = field(default_factory=dict)
    selectors: dict[Selector, int] = field(default_factory=dict)
    class_numbers: dict[str, int] = field(default_factory=dict)
    rebec_numbers: dict[str, int] = field(default_factory=dict)
    waiting: deque[tuple[int, ClassInfo, Declared]] = field(default_factory=deque)
    _numbers: dict[tuple[str, int], int] = field(default_factory=dict)

    def body_of(self, info: ClassInfo, declared: Declared) -> int:
        """The number of a body as a class runs it; it is lowered later."""
        key = (info.name, id(declared))
        if key not in self._numbers:
            self._numbers[key] = len(self.bodies)
            self.waiting.append((len(self.bodies), info, declared))
            self.bodies.append(None)
        return self._numbers[key]

    def selector(self, server: ServerSymbol) -> int:
        """The number of a name with its signature, which each receiver answers in its own way."""
        return self.selectors.setdefault((server.name, server.signature), len(self.selectors))

    def descendants(self, name: str) -> tuple[int, ...]:
        """The classes whose rebecs are of a type."""
        classes = self.analysis.classes
        return tuple(n for c, n in self.class_numbers.items() if name in classes[c].lineage)


@dataclass
class Emitter:
    """One body being lowered; `info` is the class that runs it, None for a predicate.

    `waited` has how long the message waited, where that has to be kept.
    """

    world: World
    info: ClassInfo | None
    returns: Type
    state: dict[str, Slot]
    known: dict[str, int]
    slots: dict[int, Slot] = field(default_factory=dict)
    free: int = 0
    frame: int = 0
    breaks: list[list[int]] = field(default_factory=list)
    continues: list[list[int]] = field(default_factory=list)
    span: Span = NOWHERE
    waited: Slot | None = None

    def emit(self, op: str, a: int = 0, b: int = 0, constants: tuple[Cell, ...] = ()) -> int:
        """Adds an instruction; gives its place, for `patch`."""
        self.world.code.append(Instruction(op, a, b, constants))
        if not len(self.world.code) % _GLANCE:
            self.world.look()
        self.world.spans.append(self.span)
        return len(self.world.code) - 1

    @property
    def here(self) -> int:
        """Where the next instruction will be."""
        return len(self.world.code)

    def patch(self, *jumps: int) -> None:
        """Lets jumps go to the next instruction."""
        for jump in jumps:
            self.world.code[jump] = self.world.code[jump]._replace(a=self.here)

    def text(self, text: str) -> int:
        """The number of a text."""
        return self.world.texts.setdefault(text, len(self.world.texts))

    def mark(self, constant: str) -> int:
        """What an instruction has that stands for a constant of the model: 0 for none."""
        return self.text(constant) + 1 if constant else 0

    def allocate(self, size: int) -> int:
        """Cells of the frame, until the scope ends."""
        offset = self.free
        self.free += size
        self.frame = max(self.frame, self.free)
        return offset

    def declare(self, declared: Declarator | Parameter, name: str, type_: Type) -> Slot:
        """A variable of the frame."""
        size = size_of(type_)
        slot = Slot(name, type_, kind_of(type_), self.allocate(size), size)
        self.slots[id(declared)] = slot
        return slot

    @contextmanager
    def scope(self) -> Iterator[None]:
        """Cells allocated inside are free again afterwards."""
        mark = self.free
        yield
        self.free = mark

    @contextmanager
    def at(self, span: Span) -> Iterator[None]:
        """Instructions emitted inside belong to this place of the model."""
        outer, self.span = self.span, span
        yield
        self.span = outer
