"""The interface of the search in C, as runtime.c and search.h define it."""

from __future__ import annotations

import ctypes
from collections.abc import Iterable, Iterator
from typing import Literal

from rebsync.checker.asking import Question
from rebsync.checker.reduction import PersistentSets
from rebsync.checker.steps import FailureKind, Semantics
from rebsync.checker.symmetry import Symmetry, inverse

KERNEL = (
    "machine.h",
    "kernel.h",
    "common.h",
    "kernel_data.h",
    "components.h",
    "endless.h",
    "outcomes.h",
    "orbits.h",
    "expansion.h",
    "observing.h",
    "collecting.h",
    "kernel.c",
)
PARTS = (
    *KERNEL,
    "fingerprints.h",
    "trail.h",
    "search.h",
    "visited.h",
    "frontier.h",
    "storing.h",
    "pipeline.h",
    "graph.h",
    "standstill.h",
)
SEMANTICS: tuple[Semantics, ...] = ("tts", "ftts", "core")
END = ("finished", "slice", "states", "endless", "memory", "stopped", "violated")
NOT_FOUND = -2  # instead of a state: there is no memory, or it was ended
STATES_AT_ONCE = 100_000  # between two chances to interrupt the making of a graph


class Figures(ctypes.Structure):
    """How far a search is; the last three say where and why a body was given up."""

    states: int
    transitions: int
    expanded: int
    depth: int
    level: int
    dropped: int
    events: int
    initials: int
    cause: int
    pc: int
    outer: int
    _fields_ = tuple(
        (name, ctypes.c_uint64)
        for name in (
            "states",
            "transitions",
            "expanded",
            "depth",
            "level",
            "dropped",
            "events",
            "initials",
            "cause",
            "pc",
            "outer",
        )
    )


class Event(ctypes.Structure):
    """Something wrong; `pc` is the number of a predicate when the kind is "property"."""

    kind: int
    pc: int
    rebec: int
    state: int
    ordinal: int
    _fields_ = (
        ("kind", ctypes.c_int32),
        ("pc", ctypes.c_int32),
        ("rebec", ctypes.c_int32),
        ("state", ctypes.c_int64),
        ("ordinal", ctypes.c_int64),
    )


class Measured(ctypes.Structure):
    """The extremes of a measure, in the order of `Extremes`."""

    _fields_ = tuple(
        (name, ctypes.c_int64)
        for name in ("least", "least_state", "greatest", "greatest_state", "undefined")
    )


class Arrays(ctypes.Structure):
    """Where the arrays of a graph are."""

    _fields_ = tuple(
        (name, ctypes.c_void_p) for name in ("first", "target", "actor", "time", "labels", "turn")
    )


_KINDS: tuple[Literal[FailureKind, "property", "deadlock"], ...] = (
    "assertion",
    "deadline",
    "overflow",
    "index",
    "division",
    "null",
    "time",
    "property",
    "deadlock",
)
KINDS = dict(enumerate(_KINDS, 1))


def numbers(values: Iterable[int]) -> ctypes.Array[ctypes.c_int32]:
    """Numbers as C reads them."""
    listed = tuple(values)
    return (ctypes.c_int32 * max(1, len(listed)))(*listed)


def persistent_table(persistent: PersistentSets, rebecs: int) -> Iterator[int]:
    """For each candidate its rebec, and then for every rebec whether that disturbs it."""
    for candidate in persistent:
        yield candidate.rebec
        yield from (int(rebec in candidate.disturbers) for rebec in range(rebecs))


class Symmetries(ctypes.Structure):
    """Symmetries as orbits.h reads them."""

    _fields_ = (
        ("order", ctypes.c_uint32),
        ("movable", ctypes.c_uint32),
        ("references", ctypes.c_uint32),
    )


def symmetry_tables(symmetry: Symmetry) -> tuple[object, ...]:
    """Symmetries as orbits.h reads them: sizes, what rebecs become, where they come from, the
    movable ones before the others, their orbits, and which cells hold rebecs."""
    movable, order = symmetry.movable, symmetry.order
    rebecs = range(len(symmetry.group[0]))
    orbit = {r: n for n, each in enumerate(symmetry.orbits) for r in each}
    found = symmetry.references
    owners = enumerate(
        (enumerate(found.variables), enumerate(found.arguments), found.frames.items())
    )
    references = [(kind, key, c) for kind, all_ in owners for key, cells in all_ for c in cells]
    return (
        Symmetries(order, len(movable), len(references)),
        numbers(r for names in (*symmetry.group, *symmetry.blinds) for r in names),
        numbers(r for names in symmetry.group for r in inverse(names)),
        numbers((*movable, *(r for r in rebecs if r not in movable))),
        numbers(orbit.get(r, len(rebecs) + r) for r in rebecs),
        numbers(number for reference in references for number in reference),
    )


def declare(library: ctypes.CDLL) -> None:
    """Says the types of the functions."""
    pointer, number, wide = ctypes.c_void_p, ctypes.c_int, ctypes.c_uint64
    signed, result = ctypes.c_int64, ctypes.POINTER(Event)
    library.rebsync_new.restype = pointer
    library.rebsync_new.argtypes = [pointer, number, number, pointer, number, pointer, number]
    library.rebsync_symmetry.restype = number
    library.rebsync_symmetry.argtypes = [pointer, Symmetries, *[pointer] * 5]
    library.rebsync_two_threads.restype = None
    library.rebsync_two_threads.argtypes = [pointer]
    library.rebsync_free.restype = None
    library.rebsync_free.argtypes = [pointer]
    library.rebsync_search.restype = number
    library.rebsync_search.argtypes = [pointer, wide, signed, signed, signed]
    library.rebsync_stop_at_first.restype = None
    library.rebsync_stop_at_first.argtypes = [pointer, pointer, number, number]
    library.rebsync_watch.restype = None
    library.rebsync_watch.argtypes = [pointer, Question]
    library.rebsync_figures.restype = None
    library.rebsync_figures.argtypes = [pointer, pointer]
    library.rebsync_events.restype = result
    library.rebsync_events.argtypes = [pointer]
    library.rebsync_measured.restype = ctypes.POINTER(Measured)
    library.rebsync_measured.argtypes = [pointer]
    library.rebsync_covered.restype = None
    library.rebsync_covered.argtypes = [pointer, pointer, pointer, pointer]
    library.rebsync_before.restype = signed
    library.rebsync_before.argtypes = [pointer, wide, pointer]
    library.rebsync_graph.restype = signed
    library.rebsync_graph.argtypes = [pointer, Arrays, wide, wide, wide]
    library.rebsync_standstill.restype = number
    library.rebsync_standstill.argtypes = [pointer, pointer, pointer, wide, pointer]
