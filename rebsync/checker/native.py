"""The interface of the search in C, as runtime.c and engine.h define it."""

from __future__ import annotations

import ctypes
from collections.abc import Iterable
from typing import Literal

from rebsync.checker.steps import FailureKind, Semantics

PARTS = (
    "machine.h",
    "engine.h",
    "components.h",
    "endless.h",
    "outcomes.h",
    "visited.h",
    "storing.h",
    "expansion.h",
    "standstill.h",
)
SEMANTICS: tuple[Semantics, ...] = ("tts", "ftts", "core")
END = ("finished", "slice", "states", "endless", "memory", "stopped", "violated")
NOT_FOUND = -2  # instead of a state: there is no memory, or it was ended
Question = ctypes.CFUNCTYPE(None, ctypes.POINTER(ctypes.c_int))
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
        (name, ctypes.c_void_p) for name in ("first", "target", "actor", "time", "labels")
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


def declare(library: ctypes.CDLL) -> None:
    """Says the types of the functions."""
    pointer, number, wide = ctypes.c_void_p, ctypes.c_int, ctypes.c_uint64
    signed, result = ctypes.c_int64, ctypes.POINTER(Event)
    library.rebsync_new.restype = pointer
    library.rebsync_new.argtypes = [pointer, number, number, pointer, number, pointer, number]
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
