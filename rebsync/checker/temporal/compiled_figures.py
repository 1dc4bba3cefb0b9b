"""The figures of untils in C, for large state spaces: templates/elapsed.c."""

from __future__ import annotations

import ctypes
from array import array
from collections.abc import Callable
from functools import cache, partial
from typing import Any

from rebsync.checker.asking import Question, asking
from rebsync.checker.build import Unit, header, libraries
from rebsync.checker.exploration import Unavailable
from rebsync.checker.graph import Graph
from rebsync.checker.look import Look
from rebsync.checker.temporal.figures import Figures
from rebsync.checker.temporal.outcome import Outcome
from rebsync.checker.temporal.timeline import Timeline

_STRETCH = 500_000  # edges between two looks at the bounds
_MOST = 2**31 - 1  # nodes, or edges
_SOON = 2**61  # no time, nor that of a way without a cycle, is as long
_FIGURES = ("earliest", "latest", "longest", "surest")
_POINTER, _WIDE, _LONG = ctypes.c_void_p, ctypes.c_uint64, ctypes.c_int64


class _Line(ctypes.Structure):
    """`struct line`."""

    nodes: int
    edges: int
    look: Any
    _fields_ = (
        ("nodes", _WIDE),
        ("edges", _WIDE),
        *((name, _POINTER) for name in ("first", "source", "target", "time", "entry")),
        *((name, _POINTER) for name in ("entering", "step", "origin")),
        ("look", Question),
        ("stretch", _WIDE),
        ("done", _WIDE),
    )


class _Outcome(ctypes.Structure):
    """`struct outcome`."""

    _fields_ = (
        *((name, _POINTER) for name in ("left", "right", "time")),
        ("low", _LONG),
        ("high", _LONG),
    )


def figures_for(graph: Graph, patience: int) -> Figures:
    """In C where that can be had and the numbers of a graph fit, else in Python."""
    try:
        library = _library()
    except Unavailable:
        return Figures()
    longest = _LONG()
    arrays = _address(graph.first), _address(graph.target), _address(graph.time)
    edges = library.rebsync_line_size(*arrays, len(graph), ctypes.byref(longest))
    if edges > _MOST or patience >= _SOON or longest.value * len(graph) >= _SOON:
        return Figures()
    return CompiledFigures(library, edges)


class CompiledFigures(Figures):
    """The same in C. Raises MemoryError, and what the look of a timeline raises."""

    def __init__(self, library: ctypes.CDLL, edges: int) -> None:
        self._library = library
        self._edges = edges

    def timeline(self, graph: Graph, patience: int, look: Look) -> Timeline:
        """The states of a graph as a timeline."""
        first, origin = _room("i", len(graph) + 1), _room("i", len(graph))
        source, target, step = (_room("i", self._edges) for _ in range(3))
        line = Timeline(first, source, target, _room("q", self._edges), step, origin, look)
        arrays = _address(graph.first), _address(graph.target), _address(graph.time)
        self._run(line, self._library.rebsync_line, *arrays, patience)
        return line

    def truth(self, graph: Graph, predicate: int) -> bytearray:
        """Where a predicate holds."""
        truth = bytearray(len(graph))
        labels = _address(graph.labels), graph.words
        self._library.rebsync_truth(*labels, len(graph), predicate, _bytes(truth))
        return truth

    def earliest(self, line: Timeline, left: bytearray, right: bytearray) -> array[int]:
        """The least time at which some run is fulfilled; FOREVER if none is."""
        return self._figure(self._library.rebsync_earliest, line, left, right)

    def latest(self, line: Timeline, left: bytearray, right: bytearray) -> array[int]:
        """The most that a run takes until it is fulfilled first; FOREVER if some run never is."""
        return self._figure(self._library.rebsync_latest, line, left, right)

    def longest(self, line: Timeline, left: bytearray, right: bytearray) -> array[int]:
        """The supremum of the times at which some run is fulfilled; NEVER if none is."""
        return self._figure(self._library.rebsync_longest, line, left, right)

    def surest(self, line: Timeline, left: bytearray, right: bytearray) -> array[int]:
        """The least supremum of a run; NEVER if some run is not fulfilled at all."""
        return self._figure(self._library.rebsync_surest, line, left, right)

    def holding(self, outcome: Outcome) -> bytearray:
        """Where an until holds."""
        if outcome.exact:
            return super().holding(outcome)
        truth = bytearray(len(outcome.line))
        self._library.rebsync_holding(ctypes.byref(_outcome(outcome)), len(truth), _bytes(truth))
        return truth

    def everywhere(self, outcome: Outcome) -> bytearray:
        """Where it holds; edges on which that changes are split."""
        if outcome.exact:
            return super().everywhere(outcome)
        line, truth = outcome.line, self.holding(outcome)
        known = ctypes.byref(_outcome(outcome))
        count = self._run(line, self._library.rebsync_changes, known, _bytes(truth))
        if len(line.target) + count > _MOST:
            raise MemoryError
        if count:
            truth.extend(bytes(count))
            for each in (line.first, line.source, line.target, line.time, line.step, line.origin):
                each.frombytes(bytes(each.itemsize * count))
            fields = _line(line)
            fields.nodes -= count
            fields.edges -= count
            self._library.rebsync_split(ctypes.byref(fields), known, _bytes(truth))
            line.entering = None
        return truth

    def _figure(
        self, figure: Callable[..., int], line: Timeline, left: bytearray, right: bytearray
    ) -> array[int]:
        if line.entering is None:
            entering = _room("i", len(line) + 1), _room("i", len(line.target))
            self._run(line, self._library.rebsync_entering, *map(_address, entering))
            line.entering = entering
        values = _room("q", len(line))
        self._run(line, figure, _bytes(left), _bytes(right), _address(values))
        return values

    def _run(self, line: Timeline, function: Callable[..., int], *arguments: object) -> int:
        """What C returns at its end; meanwhile it looks at the bounds."""
        fields = _line(line)
        with asking(line.look, partial(setattr, fields, "look")):
            found = function(ctypes.byref(fields), *arguments)
        if found < 0:
            raise MemoryError
        return found


def _line(line: Timeline) -> _Line:
    arrays = (line.first, line.source, line.target, line.time)
    behind = line.entering or (None, None)
    return _Line(
        len(line),
        len(line.target),
        *map(_address, (*arrays, *behind, line.step, line.origin)),
        stretch=_STRETCH,
    )


def _outcome(outcome: Outcome) -> _Outcome:
    assert isinstance(outcome.times, array)
    sides = _bytes(outcome.left), _bytes(outcome.right)
    places = (ctypes.addressof(each) for each in sides)
    return _Outcome(*places, _address(outcome.times), outcome.window.low, outcome.window.high)


def _room(code: str, count: int) -> array[int]:
    empty: array[int] = array(code, [0])
    return empty * count


def _address(values: array[int] | None) -> int | None:
    return values.buffer_info()[0] if values is not None else None


def _bytes(values: bytearray) -> ctypes.Array[ctypes.c_ubyte]:
    """The bytes themselves, which cannot grow as long as this is there."""
    return (ctypes.c_ubyte * max(1, len(values))).from_buffer(values or bytearray(1))


@cache
def _library() -> ctypes.CDLL:
    parts = tuple(header(name) for name in ("elapsed.c", "pearce.h", "radix.h"))
    (library,) = libraries((Unit("elapsed", partial(header, "elapsed.c"), parts, "-O2"),))
    library.rebsync_line_size.restype = _WIDE
    library.rebsync_line_size.argtypes = [*[_POINTER] * 3, _WIDE, _POINTER]
    library.rebsync_line.argtypes = [*[_POINTER] * 4, _LONG]
    library.rebsync_entering.argtypes = [_POINTER] * 3
    library.rebsync_truth.restype = None
    library.rebsync_truth.argtypes = [_POINTER, _WIDE, _WIDE, ctypes.c_uint32, _POINTER]
    for name in _FIGURES:
        getattr(library, f"rebsync_{name}").argtypes = [_POINTER] * 4
    library.rebsync_holding.restype = None
    library.rebsync_holding.argtypes = [_POINTER, _WIDE, _POINTER]
    library.rebsync_changes.restype = _LONG
    library.rebsync_changes.argtypes = [_POINTER] * 3
    library.rebsync_split.restype = None
    library.rebsync_split.argtypes = [_POINTER] * 3
    return library
