"""Which attributes the functions of a program name, and how."""

from __future__ import annotations

from functools import cached_property

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Program
from rebsync.reverse.ir.walk import walk_all

_SETTERS = frozenset({"builtins.setattr", "builtins.vars"})


class ProgramNames:
    """The attributes of one program."""

    def __init__(self, program: Program) -> None:
        self._program = program

    @cached_property
    def read_attributes(self) -> frozenset[str]:
        """The attributes that code reads other than to call them: methods that it hands over."""
        nodes = (n for _, n in walk_all(self._program))
        return frozenset(n.name for n in nodes if isinstance(n, e.Attribute))

    @cached_property
    def naming(self) -> dict[str, frozenset[str]]:
        """By each name of an attribute the functions that read or call it."""
        found: dict[str, set[str]] = {}
        for function, node in walk_all(self._program):
            match node:
                case e.Attribute(_, name) | s.Call(_, s.MethodCallee(_, name)):
                    found.setdefault(name, set()).add(function)
                case _:
                    pass
        return {name: frozenset(functions) for name, functions in found.items()}

    @cached_property
    def sets_by_text(self) -> bool:
        """Whether code of Python sets attributes whose names it computes."""
        return any(
            (isinstance(node, e.Attribute) and node.name == "__dict__")
            or (isinstance(node, e.LibraryReference | s.LibraryCallee) and node.name in _SETTERS)
            for _, node in walk_all(self._program)
        )
