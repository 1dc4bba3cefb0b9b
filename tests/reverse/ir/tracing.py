"""Which functions run while a function of an interpreted program does, held against its calls."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import Any

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.origins import AnyOrigin, Origins
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Program
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from tests.reverse.ir.evaluation import Frame
from tests.reverse.ir.interpreter import Interpreter

# What tells the tests something, and calls nothing of what it gets.
KEEPING: frozenset[str] = frozenset(
    {".append", "note", "builtins.str", "builtins.len", "builtins.print"}
)


class Tracer(Interpreter):
    """Notes for each function which ones run meanwhile."""

    def __init__(self, program: Program) -> None:
        super().__init__(program)
        self.seen: set[tuple[str, str]] = set()

    def _function(self, frame: Frame) -> Generator[Any, Any, Any]:
        self.seen.update((function, frame.function.name) for function in set(self.calls))
        return (yield from super()._function(frame))


class Reach:
    """What functions of a program may run; libraries' `keeping` callables call nothing they get."""

    def __init__(
        self, program: Program, language: Language, keeping: frozenset[str] = KEEPING
    ) -> None:
        self.program = program
        self.keeping = keeping
        self.origins = Origins(CallGraph(program), LibraryOutcomes(language), program.functions)

    def of(self, name: str) -> frozenset[str] | None:
        """The functions that run with one, itself included; None where any may."""
        names = set()
        for function, body in self.origins.runs(self.program.function(name).body, name):
            names.add(function)
            if any(self._is_unknown(node, function) for node in walk(body)):
                return None
        return frozenset(names)

    def _is_unknown(self, node: Node, function: str) -> bool:
        """Whether it is not known what a node calls, or hands on to be called."""
        match node:
            case s.Unsupported() | s.Await():
                return True
            case s.Call(_, callee, arguments):
                around = self.program.function(function)
                targets = self.origins.graph.callee(callee, around)
                held = (self.origins.of(a.value, function) for a in arguments)
                may_call = not targets.libraries <= self.keeping and any(
                    AnyOrigin() in each for each in held
                )
                return targets.unknown or may_call
            case _:
                return False

    def missed(self, tracer: Tracer) -> Iterator[tuple[str, str]]:
        """What ran while a function did, and cannot for all that the analyses know."""
        for function, ran in sorted(tracer.seen):
            known = self.of(function)
            if known is not None and ran not in known:
                yield function, ran
