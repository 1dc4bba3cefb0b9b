"""What a program of C++ says as a whole: which parameters are declared, what runs at the start."""

from __future__ import annotations

from functools import cached_property

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import FunctionKind, Program
from rebsync.reverse.ir.walk import walk


class CppFacts:
    """Of one program; each is looked for when it is first asked for."""

    def __init__(self, program: Program) -> None:
        self._program = program

    @cached_property
    def constructing(self) -> frozenset[str]:
        """The constructors of C++, and what these call at once."""
        program = self._program
        kinds = {f: program.function(f).kind for f in program.functions}
        found = {f for f, kind in kinds.items() if kind is FunctionKind.CONSTRUCTOR}
        waiting = [*found]
        while waiting:
            body = program.function(waiting.pop()).body
            calls = (n.callee for n in walk(body) if isinstance(n, s.Call))
            called = {c.name for c in calls if isinstance(c, s.FunctionCallee)}
            waiting += [name for name in called - found if name in program]
            found |= called
        return frozenset(found)

    @cached_property
    def declared_parameters(self) -> frozenset[str]:
        """The names that stand in calls which declare a parameter of a node in C++."""
        every = (self._program.function(name) for name in self._program.functions)
        calls = (n for f in every for n in walk(f) if isinstance(n, s.Call))
        declaring = (c for c in calls if "declare_parameter" in getattr(c.callee, "name", ""))
        texts = (
            n.value
            for c in declaring
            for a in c.arguments
            for n in walk(a.value)
            if isinstance(n, e.Literal)
        )
        return frozenset(text for text in texts if isinstance(text, str))
