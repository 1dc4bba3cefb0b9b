"""Operators, conversions and calls of objects of libraries in C++, as methods of their classes."""

from __future__ import annotations

from rebsync.reverse.analysis.client_times import ClientTimes
from rebsync.reverse.analysis.outcomes.stream_failures import STREAM_FAILURE, may_fail
from rebsync.reverse.analysis.problems import BEYOND_TIMES, ProblemNotes
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.libraries.client_times import THROWN
from rebsync.reverse.libraries.routines import Language


def is_standard(value: e.Expression) -> bool:
    """Whether a value in C++ is an object of the standard library, by its type."""
    type_ = getattr(value, "type", None)
    return isinstance(type_, t.Record) and type_.name.startswith("std::")


class LibraryOperators:
    """In one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self.notes = notes
        self._times = ClientTimes(notes.origins)

    def class_of(self, value: object) -> str | None:
        """The class of a library that an object in C++ is of, by its type."""
        type_ = getattr(value, "type", None)
        if self.notes.table.language is not Language.CPP or not isinstance(type_, t.Record):
            return None
        plain = type_.name.partition("<")[0]
        is_own = type_.name in self.notes.origins.graph.program.classes
        return None if is_own or plain.startswith("std::") else type_.name

    def check(self, value: e.Expression) -> None:
        """Operators and conversion functions that classes of libraries have."""
        if isinstance(value, e.Binary) and self._is_beyond(value):
            self.notes.problem(value, BEYOND_TIMES, THROWN)
        if may_fail(self.notes.origins, value):
            self.notes.problem(value, "a stream may raise an exception", STREAM_FAILURE)
        match value:
            case e.Binary(operator, left, right):
                found = [(left, operator.value), (right, operator.value)]
            case e.Unary(operator, operand):
                found = [(operand, operator.value)]
            case e.Index(operand):
                found = [(operand, "[]")]
            case e.Convert(_, operand, type_) if not isinstance(type_, t.Record):
                found = [(operand, " conversion")]
            case _:
                return
        for operand, sign in found:
            if (of := self.class_of(operand)) is None:
                continue
            for raised in self.notes.table.method(of, f"operator{sign}").raises:
                self.notes.problem(value, f'"{of}" may raise an exception', raised)

    def _is_beyond(self, value: e.Binary) -> bool:
        """Whether times may be computed or compared that are none of one clock, or none at all."""
        is_cpp = self.notes.table.language is Language.CPP
        return is_cpp and self._times.may_throw(value, self.notes.function.name)
