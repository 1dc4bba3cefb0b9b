"""Handlers of exceptions: what they are for of what a block raises."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache, partial

from rebsync.reverse.analysis.origins import ClassOrigin, LibraryOrigin
from rebsync.reverse.analysis.problems import Called, Problem, ProblemNotes
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.libraries.outcome_classes import TERMINATES

_SUPPRESS = "contextlib.suppress"


class Handlers:
    """The handlers of one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self._suppressed: dict[e.Expression, s.Handler] = {}

    def note(self, call: s.Call) -> None:
        """Notes a context that ends exceptions: `contextlib.suppress(KeyError)`."""
        match call:
            case s.Call(e.Temporary() as target, s.LibraryCallee(name), given):
                if name == _SUPPRESS and not any(a.stars for a in given):
                    self._suppressed[target] = s.Handler(tuple(a.value for a in given), ())
            case _:
                pass

    def suppresses(self, context: e.Expression) -> bool:
        """Whether a context ends exceptions that are known."""
        return context in self._suppressed

    def passed(self, context: e.Expression, raised: set[Problem | Called]) -> set[Problem | Called]:
        """What leaves the block of a context of what the block raises."""
        handler = self._suppressed.get(context)
        return raised if handler is None else self.split(raised, handler)[1]

    def may_swallow(self, context: e.Expression) -> bool:
        """Whether leaving a context may end an exception, so that its block was left before."""
        held = self._notes.origins.of(context, self._notes.function.name)
        return any(isinstance(o, ClassOrigin) or o == LibraryOrigin(_SUPPRESS, True) for o in held)

    def split(
        self, raised: set[Problem | Called], handler: s.Handler
    ) -> tuple[set[Problem | Called], set[Problem | Called]]:
        """What a handler is for of what a block raises, and what it lets through."""
        catches = cache(partial(self._catches, handler))
        passes = cache(lambda problem: not catches(problem))
        caught, passed = set[Problem | Called](), set[Problem | Called]()
        for each in raised:
            match each:
                case Called(name, tests, gives):
                    caught.add(Called(name, (*tests, catches), gives))
                    passed.add(Called(name, (*tests, passes), gives))
                case Problem():
                    (caught if catches(each) else passed).add(each)
        return caught, passed

    def _catches(self, handler: s.Handler, problem: Problem) -> bool:
        """Whether a handler is for what a place raises."""
        if problem.raises in ("", TERMINATES):
            return False
        if handler.types is None:
            return True
        names = self._above(problem.raises)
        origins = (self._notes.origins.of(t, self._notes.function.name) for t in handler.types)
        types = {
            o.name for held in origins for o in held if isinstance(o, ClassOrigin | LibraryOrigin)
        }
        return not types.isdisjoint(names)

    def _above(self, name: str) -> Iterable[str]:
        """An exception and all classes that it extends."""
        bases = [name, *self._notes.origins.graph.bases(name)]
        return [above for base in bases for above in self._notes.table.are_above(base)]
