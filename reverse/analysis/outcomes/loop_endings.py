"""Which loops end, whatever they get: one rule for both languages, and for all who ask.

Whether the statements within a loop end is asked of each of them by itself.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from functools import cache, cached_property

from rebsync.reverse.analysis.element_counts import ElementCounts
from rebsync.reverse.analysis.numbers.finite_numbers import FiniteNumbers
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.outcomes.bounded_loops import LoopEnds
from rebsync.reverse.analysis.outcomes.endless_iterators import EndlessIterators
from rebsync.reverse.analysis.outcomes.outcome_expressions import OutcomeExpressions
from rebsync.reverse.analysis.outcomes.outcome_sizes import OutcomeSizes
from rebsync.reverse.analysis.outcomes.size_changes import SizeChanges
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.program import Function
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.effects import of_function
from rebsync.source import Span

_VALUES = t.Integer | t.Float | t.Truth | t.Enumeration | t.Text


class LoopEndings:
    """The loops of one function."""

    def __init__(
        self, notes: ProblemNotes, sizes: OutcomeSizes, iterators: EndlessIterators
    ) -> None:
        self._iterators = iterators
        self._function = notes.function
        self._origins = notes.origins
        self._sizes = sizes
        self._changes = SizeChanges(notes, sizes)
        self._notes = notes

    @cached_property
    def _lent(self) -> frozenset[int]:
        return frozenset(_lent(self._notes, self._function))

    @cached_property
    def _bounded(self) -> LoopEnds:
        numbers = FiniteNumbers(self._origins, self._notes.table)
        name, in_bound = self._function.name, self._changes.in_bound
        return LoopEnds(numbers, name, self._sizes.is_bound, in_bound, self._lent)

    def ends(self, loop: s.Loop | s.ForEach) -> bool:
        """Whether a loop goes through its body finitely often, if each round ends."""
        if self._does_anything(loop):
            return False
        match loop:
            case s.ForEach(_, iterable):
                if self._iterators.may_be(iterable, self._function.name):
                    return False
                return not (self._changes.in_for_each(loop) or self._changes.is_own(loop))
            case s.Loop():
                is_bounded = self._bounded.ends(loop) or self._sizes.is_emptied(loop)
                return is_bounded and not (self._changes.in_loop(loop) or self._is_shared(loop))

    def _does_anything(self, loop: s.Loop | s.ForEach) -> bool:
        """Whether something that runs in a loop has no lowering."""
        bodies = self._origins.runs((loop,), self._function.name)
        return any(isinstance(n, s.Unsupported) for _, body in bodies for n in walk(body))

    def _is_shared(self, loop: s.Loop) -> bool:
        """Whether functions within share a variable that the test of a loop names."""
        stepped = [n for n in walk(loop.step) if isinstance(n, e.AddressOf)]
        every = [n for n in walk(self._function) if isinstance(n, e.AddressOf)]
        uses = [n for n in every if id(n) not in self._lent]
        own = {
            n.target.name for n in stepped if isinstance(n.target, e.Local) and uses.count(n) == 1
        }
        names = self._function.captured - own - self._only_lent(every) | self._unread
        return any(isinstance(n, e.Local) and n.name in names for n in walk(loop.test))

    @cached_property
    def _unread(self) -> frozenset[str]:
        """The variables that something names which has no lowering: it may keep references."""
        unread = [n for n in walk(self._function) if isinstance(n, s.Unsupported)]
        named = (p for n in unread for each in (*n.reads, *n.writes) for p in walk(each))
        return frozenset(p.name for p in named if isinstance(p, e.Local))

    def _only_lent(self, every: list[e.AddressOf]) -> frozenset[str]:
        """The variables that nothing shares but calls that get them."""
        targets = {n.target for n in every if id(n) not in self._lent}
        lent = {n.target for n in every} - targets
        closures = (n for n in walk(self._function) if isinstance(n, e.Closure))
        taken = {c.variable.name for closure in closures for c in closure.captures}
        return frozenset(v.name for v in lent if isinstance(v, e.Local)) - taken


def _lent(notes: ProblemNotes, function: Function) -> Iterator[int]:
    """The ids of references to numbers that calls of libraries get, and do not store by.

    Functions of libraries that no table knows are trusted to leave numbers as they are that they
    get by their names, and not by an address (`f(i)`, and not `f(&i)`): for references that calls
    make themselves, and that have their places. What a call gives may keep them, if that is kept.
    """
    nodes = list(walk(function))
    values = (n.value for n in nodes if isinstance(n, s.Assign | s.Declare))
    parts = (n for value in values if value is not None for n in walk(value))
    stored = {n for n in parts if isinstance(n, e.Temporary)}
    for call in nodes:
        if not isinstance(call, s.Call) or not _is_trusted(notes, call.callee):
            continue
        if _may_be_kept(call, stored):
            continue
        for argument in call.arguments:
            value = argument.value
            if isinstance(value, e.AddressOf) and value.place == call.place:
                yield id(value)


def _may_be_kept(call: s.Call, stored: Container[e.Expression]) -> bool:
    """Whether a variable or member gets what a call gives, and that is no number or text."""
    if call.target is None or isinstance(call.target.type, _VALUES):
        return False
    return not isinstance(call.target, e.Temporary) or call.target in stored


def _is_trusted(notes: ProblemNotes, callee: s.Callee) -> bool:
    match callee:
        case s.LibraryCallee(name):
            known = of_function(notes.table.language, name)
            return known.writes == frozenset() or (
                known.writes is None and "::" in name and not notes.table.is_standard(name)
            )
        case s.MethodCallee(_, name, None):
            return not notes.origins.methods_of_any(name)
        case _:
            return False


class ProgramLoops:
    """The loops of a program, by the places where they stand."""

    def __init__(self, origins: Origins) -> None:
        self._program = origins.graph.program
        self._origins = origins
        self._counts = ElementCounts(origins)
        self._iterators = EndlessIterators(origins, foreign=True)
        self.ends = cache(self._ends)

    def _ends(self, name: str, place: Span) -> bool:
        """Whether a loop that stands at a place in a function ends; False where there is none."""
        function = self._program.function(name)
        loops = [n for n in walk(function.body) if isinstance(n, s.Loop | s.ForEach)]
        found = [loop for loop in loops if loop.place == place]
        notes = ProblemNotes(function, self._origins, self._counts, lambda _: False, {})
        endings = LoopEndings(
            notes, OutcomeSizes(notes, OutcomeExpressions(notes)), self._iterators
        )
        return bool(found) and all(map(endings.ends, found))
