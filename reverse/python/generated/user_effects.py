"""The effects of users' own blocks in generated Python, by what the form says of their statements.

What they compute, keep for themselves and write to files is theirs; the rebec, its messages and its
time are the model's. Errors of files do not count: that they may be is said of no block.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import lru_cache

from rebsync.reverse.analysis.outcomes.outcomes import OutcomeAnalysis
from rebsync.reverse.analysis.problems import Problem
from rebsync.reverse.ir.program import Function
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import Py
from rebsync.source import Span

_FILES = "builtins.OSError"


class UserEffects:
    """One module of generated code; `modelled` are modules that have to do with the model."""

    def __init__(self, py: Py, modelled: Collection[str]) -> None:
        self.program = python_program(PyCode.of([py]))
        table = LibraryOutcomes(Language.PYTHON, frozenset(modelled))
        self.analysis = OutcomeAnalysis(self.program, table, self._is_model)

    @staticmethod
    def _is_model(name: str) -> bool:
        """Whether a function is one of a class of the module."""
        return "." in name.partition(":")[2]

    def acting(self, span: Span) -> Iterator[Problem]:
        """What the statements at a place may do besides to compute."""
        around = [f for f in map(self.program.function, self.program.functions) if _is_in(span, f)]
        if not around:
            return
        function = min(around, key=lambda f: f.place.end - f.place.start)
        found = self.analysis.of_statements(function, span)
        yield from sorted((p for p in found if p.raises != _FILES), key=str)


@lru_cache(maxsize=8)
def effects_of(py: Py, modelled: frozenset[str]) -> UserEffects:
    """The effects of a module, read once."""
    return UserEffects(py, modelled)


def _is_in(span: Span, function: Function) -> bool:
    return function.place.start <= span.start and span.end <= function.place.end
