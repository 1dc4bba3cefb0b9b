"""One worker's share of a search, in C: templates/shard.c."""

from __future__ import annotations

import ctypes
import hashlib
from array import array
from collections.abc import Sequence
from functools import partial
from itertools import accumulate
from typing import Any, NamedTuple

from rebsync.checker import native
from rebsync.checker.build import Unit, header, libraries
from rebsync.checker.compile_model import model_unit
from rebsync.checker.decoding import cause_of, covered
from rebsync.checker.exploration import Covered, Event, Unavailable
from rebsync.checker.program import Program
from rebsync.checker.reduction import PersistentSets
from rebsync.checker.steps import Semantics
from rebsync.records import dataclass

NOTHING = 2**64 - 1  # no state
_FOREVER = 2**63 - 1
_WAY = 12  # bytes
_PARTS = (*native.KERNEL, "fingerprints.h", "ranking.h", "shard.h", "shard.c")


@dataclass(frozen=True, slots=True)
class Task:
    """What is searched, and how: the same for all workers."""

    program: Program
    semantics: Semantics
    invariants: tuple[int, ...]
    persistent: PersistentSets
    until: int | None
    instructions: int
    hash_compaction: bool
    shares: int

    def units(self) -> tuple[Unit, Unit]:
        """The share and the model, as libraries."""
        parts = tuple(header(name) for name in _PARTS)
        return Unit("shard", partial(header, "shard.c"), parts, "-O1"), model_unit(self.program)

    @property
    def seal(self) -> str:
        """What the C of all workers must have in common."""
        parts = (part for unit in self.units() for part in unit.parts)
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()


class PlacedEvent(NamedTuple):
    """Something wrong, with its place in the order of the search."""

    parent: int
    code: int
    place: int
    event: Event


class _Unfinished(ctypes.Structure):
    number: int
    cause: int
    pc: int
    outer: int
    _fields_ = tuple((name, ctypes.c_uint64) for name in ("number", "cause", "pc", "outer"))


class _Figures(ctypes.Structure):
    states: int
    fresh: int
    transitions: int
    dropped: int
    findings: int
    unfinished: _Unfinished
    _fields_ = (
        *((name, ctypes.c_uint64) for name in ("states", "fresh", "transitions", "dropped")),
        ("findings", ctypes.c_uint64),
        ("unfinished", _Unfinished),
    )


class _Found(ctypes.Structure):
    kind: int
    pc: int
    rebec: int
    code: int
    place: int
    parent: int
    state: int
    ordinal: int
    _fields_ = (
        *((name, ctypes.c_int32) for name in ("kind", "pc", "rebec")),
        *((name, ctypes.c_uint32) for name in ("code", "place")),
        ("parent", ctypes.c_uint64),
        *((name, ctypes.c_int64) for name in ("state", "ordinal")),
    )


class PhaseReport(NamedTuple):
    """What a phase has come to: states that wait, new ones, steps, those later than the bound.

    `unfinished` is a state in which a body was given up, with the cause, and where.
    """

    states: int
    fresh: int
    transitions: int
    dropped: int
    findings: tuple[PlacedEvent, ...]
    unfinished: tuple[int, int, int, int] | None


class Shard:
    """A share of a search. Raises MemoryError when there is none left.

    Raises Unavailable when it cannot be built.
    """

    def __init__(self, task: Task) -> None:
        self.task = task
        self._shard: int | None = None
        self._library, self._model = libraries(task.units())
        _declare(self._library)
        persistent = native.persistent_table(task.persistent, len(task.program.rebecs))
        self._shard = self._library.rebsync_shard_new(
            ctypes.addressof(ctypes.c_char.in_dll(self._model, "rebsync_model")),
            native.SEMANTICS.index(task.semantics),
            task.hash_compaction,
            task.shares,
            _FOREVER if task.until is None else min(task.until, _FOREVER),
            task.instructions,
            native.numbers(task.invariants),
            len(task.invariants),
            native.numbers(persistent),
            len(task.persistent),
        )
        if not self._shard:
            raise Unavailable("there is no memory for a share of the search")

    def __del__(self) -> None:
        if self._shard:
            self._library.rebsync_shard_free(self._shard)

    # --- phases

    def begin(self) -> PhaseReport:
        """Makes the initial states."""
        return self._phase(self._library.rebsync_shard_begin)

    def expand(self) -> PhaseReport:
        """Makes the steps of the states that wait."""
        return self._phase(self._library.rebsync_shard_expand)

    def batch(self, owner: int) -> bytes:
        """The states that were reached and belong to a worker."""
        return self._bytes(self._library.rebsync_shard_batch, owner)

    def receive(self, batches: Sequence[bytes], end: int) -> PhaseReport:
        """Takes in what workers have sent, up to the steps of the state `end`."""
        for batch in batches:
            self._do(self._library.rebsync_shard_receive, batch, end)
        self._library.rebsync_shard_settle(self._shard)
        return self._report()

    def ways(self, first: int, parents: int, part: int) -> bytes:
        """The ways to new states from a range of parents, of so many from the number `first` on."""
        return self._bytes(self._library.rebsync_shard_ways, first, parents, part)

    def number(self, first: int, places: bytes) -> None:
        """Numbers the new states of the next range by their places in it."""
        count = len(places) // 4
        self._library.rebsync_shard_number(self._shard, first, places, count)

    def accept(self) -> PhaseReport:
        """Ends a level: the new states are judged, and wait."""
        return self._phase(self._library.rebsync_shard_accept)

    def checkpoint(self) -> bytes:
        """The states that wait; see `before`."""
        return self._bytes(self._library.rebsync_shard_checkpoint)

    def restore(self, checkpoints: Sequence[bytes]) -> None:
        """Takes in the states of all levels so far."""
        for checkpoint in checkpoints:
            self._do(self._library.rebsync_shard_restore, checkpoint)

    def rank(self, lists: Sequence[bytes]) -> list[bytes]:
        """For each list of ways their places among all, in four bytes each."""
        counts = [len(each) // _WAY for each in lists]
        places = array("I", bytes(4 * sum(counts)))
        texts = (ctypes.c_char_p * len(lists))(*lists)
        lengths = (ctypes.c_uint64 * len(lists))(*map(len, lists))
        into = places.buffer_info()[0]
        if self._library.rebsync_rank(texts, lengths, len(lists), len(places), into):
            raise MemoryError
        ends = accumulate(counts)
        return [places[end - n : end].tobytes() for end, n in zip(ends, counts, strict=True)]

    def covered(self) -> Covered:
        """What ran in this worker."""
        ask = partial(self._library.rebsync_shard_covered, self._shard)
        return covered(self.task.program, ask)

    # --- calls

    def _do(self, function: Any, *arguments: object) -> None:  # noqa: ANN401 - of C
        if function(self._shard, *arguments):
            raise MemoryError

    def _phase(self, function: Any) -> PhaseReport:  # noqa: ANN401 - of C
        self._do(function)
        return self._report()

    def _bytes(self, function: Any, *arguments: object) -> bytes:  # noqa: ANN401 - of C
        length = ctypes.c_uint64(NOTHING)  # which C leaves there without memory
        found = function(self._shard, *arguments, ctypes.byref(length))
        if length.value == NOTHING:
            raise MemoryError
        return ctypes.string_at(found, length.value) if found else b""

    def _report(self) -> PhaseReport:
        figures = _Figures()
        self._library.rebsync_shard_figures(self._shard, ctypes.byref(figures))
        found = self._library.rebsync_shard_findings(self._shard)
        findings = tuple(self._placed(found[i]) for i in range(figures.findings))
        end = figures.unfinished
        unfinished = (end.number, end.cause, end.pc, end.outer) if end.number != NOTHING else None
        known = figures.states, figures.fresh, figures.transitions, figures.dropped
        return PhaseReport(*known, findings, unfinished)

    def _placed(self, found: _Found) -> PlacedEvent:
        cause = cause_of(self.task.program, found.kind, found.pc, found.rebec)
        event = Event(cause, found.state, found.ordinal)
        return PlacedEvent(found.parent, found.code, found.place, event)


def _declare(library: ctypes.CDLL) -> None:
    """Says the types of the functions."""
    pointer, number, wide = ctypes.c_void_p, ctypes.c_int, ctypes.c_uint64
    signed, bytes_ = ctypes.c_int64, ctypes.c_char_p
    types: dict[str, tuple[Any, list[Any]]] = {
        "new": (pointer, [pointer, *[number] * 3, signed, signed, *[pointer, number] * 2]),
        "free": (None, [pointer]),
        "begin": (number, [pointer]),
        "expand": (number, [pointer]),
        "batch": (pointer, [pointer, ctypes.c_uint32, pointer]),
        "receive": (number, [pointer, bytes_, wide]),
        "settle": (None, [pointer]),
        "ways": (pointer, [pointer, wide, wide, ctypes.c_uint32, pointer]),
        "number": (None, [pointer, wide, bytes_, wide]),
        "accept": (number, [pointer]),
        "checkpoint": (pointer, [pointer, pointer]),
        "restore": (number, [pointer, bytes_]),
        "figures": (None, [pointer, pointer]),
        "findings": (ctypes.POINTER(_Found), [pointer]),
        "covered": (None, [pointer] * 4),
    }
    for name, (result, arguments) in types.items():
        function = getattr(library, f"rebsync_shard_{name}")
        function.restype, function.argtypes = result, arguments
    library.rebsync_rank.restype = number
    library.rebsync_rank.argtypes = [pointer, pointer, number, wide, pointer]
