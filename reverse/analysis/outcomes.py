"""How functions may end, and what else they may do that is to be seen: one walk over the form.

A function is harmless if it comes back with a value, in bounded time, whatever it gets. Every place
that may do otherwise is listed: exceptions that nothing in the function handles, loops and
recursion that may not end, calls that wait or act, what is the model's, what has no lowering.

The types of values are trusted, as a type checker would: an operand of a wrong type, a name or an
attribute that is not there, is not looked for. So is what C++ leaves undefined.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import cached_property

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.element_counts import ElementCounts
from rebsync.reverse.analysis.endless_iterators import EndlessIterators
from rebsync.reverse.analysis.facts import NO_FACTS
from rebsync.reverse.analysis.held_locks import HeldLocks
from rebsync.reverse.analysis.implicit_calls import implicit_calls
from rebsync.reverse.analysis.origins import FunctionOrigin, Origins
from rebsync.reverse.analysis.outcome_statements import ENDLESS, OutcomeWalk
from rebsync.reverse.analysis.problems import TERMINATES, Problem, ProblemNotes
from rebsync.reverse.analysis.silent_calls import SilentCalls
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import ImplicitCall
from rebsync.reverse.ir.program import Function, Program
from rebsync.reverse.ir.walk import STATEMENTS, Node, parts, walk
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.source import NOWHERE, Span

_RECURSES = "this may call itself, and may not end"


class OutcomeAnalysis:
    """The functions of a program, each looked through once.

    `is_model` says of a module, class or function whether it is the model's: of generated code.
    """

    def __init__(
        self, program: Program, table: LibraryOutcomes, is_model: Callable[[str], bool]
    ) -> None:
        self.program = program
        self.table = table
        self.is_model = is_model
        self.graph = CallGraph(program)
        own = [name for name in program.functions if not is_model(name)]
        self.origins = Origins(self.graph, table, own)
        self.counts = ElementCounts(self.origins)
        self.locks = HeldLocks(self.origins)
        self.iterators = EndlessIterators(self.origins)
        self.elements: dict[str, int] = {}  # of what functions get, by their names
        self._found: dict[str, frozenset[Problem]] = {}
        self._active: list[str] = []

    def of(self, name: str) -> frozenset[Problem]:
        """What one call of a function may do besides giving a value."""
        if name in self._active:
            place = self.program.function(name).place
            return frozenset({Problem(name, place, _RECURSES)})
        if name not in self._found:
            self._active.append(name)
            self._found[name] = self._of_body(self.program.function(name))
            self._active.pop()
        return self._found[name]

    def functions(self, value: e.Expression) -> frozenset[str]:
        """The functions that a variable of a module may stand for."""
        held = self.origins.of(value, "")
        return frozenset(o.name for o in held if isinstance(o, FunctionOrigin))

    @cached_property
    def _silent(self) -> SilentCalls:
        return SilentCalls(self.origins)

    def of_statements(self, function: Function, span: Span) -> frozenset[Problem]:
        """What the statements of a function at a place may do besides to compute."""
        return self._of_body(replace(function, body=tuple(_within(function.body, span))))

    def raised_by(self, function: Function, span: Span) -> frozenset[Problem]:
        """The exceptions of statements at a place that leave the function, or end the program."""
        found = frozenset(p for p in self.of_statements(function, span) if p.raises)
        return found & self.of(function.name) if found else frozenset()

    def _of_body(self, function: Function) -> frozenset[Problem]:
        notes = ProblemNotes(function, self.origins, self.counts, self.is_model, self.elements)
        walk_ = OutcomeWalk(notes, self.of, self.iterators)
        walk_.defaults(self._defaults.get(function.name, ()))
        walk_.defaults(self._silent.factories(function, self._active))
        walk_.body(function.body, NO_FACTS)
        self.locks.check(function, notes)
        for node in self.iterators.gone_through(function):
            notes.problem(node, ENDLESS)
        found = implicit_calls(self.graph, function)
        implicit = found.functions | (self._silent.called(function).difference(self._active))
        if found.has_library:
            implicit |= self.origins.operators
        for name in sorted(implicit):
            if not self.is_model(name) and name != function.name:
                notes.take(self.of(name))
                if name in self._endless:
                    notes.take({Problem(name, self.program.function(name).place, ENDLESS)})
        if function.noexcept:
            return frozenset(replace(p, raises=p.raises and TERMINATES) for p in notes.found)
        return frozenset(notes.found)

    @cached_property
    def _endless(self) -> frozenset[str]:
        """The methods of iterators, of which nothing shows how often they give an element."""
        classes = self.program.classes.values()
        iterated = [c for c in classes if ImplicitCall.ITERATE in dict(c.operators)]
        names = {
            method
            for c in iterated
            for implicit, method in c.operators
            if implicit is ImplicitCall.NEXT
        }
        return frozenset(f for c in iterated for method, f in c.methods if method in names)

    @cached_property
    def _defaults(self) -> dict[str, tuple[tuple[str, e.Expression], ...]]:
        """What functions get for parameters that no argument is for, and where that stands."""
        found: dict[str, tuple[tuple[str, e.Expression], ...]] = {}
        for around in self.program.functions:
            for node in walk(self.program.function(around)):
                if isinstance(node, e.Closure) and node.defaults:
                    found[node.function] = tuple((around, value) for _, value in node.defaults)
        return found


def _within(body: Iterable[Node], span: Span) -> Iterator[s.Statement]:
    """The outermost statements that stand at a place.

    The rest of a block after a local, which its destruction ends, stands at the place of the local:
    of that only the destruction is the local's own.
    """
    for node in body:
        place = getattr(node, "place", NOWHERE)
        is_there = span.start <= place.start and place.end <= span.end
        if isinstance(node, s.Try) and any(isinstance(n, s.Destroy) for n in node.final):
            yield from _within(node.body, span)
            yield from node.final if is_there else _within(node.final, span)
        elif isinstance(node, STATEMENTS) and is_there:
            yield node  # type: ignore[misc]
        else:
            yield from _within(parts(node), span)
