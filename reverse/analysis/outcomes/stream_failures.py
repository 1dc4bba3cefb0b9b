"""Operations on streams of C++ that throw, where a program asks any stream to ([iostate.flags])."""

from __future__ import annotations

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.libraries.outcome_classes import STREAM_FUNCTIONS, STREAM_OBJECTS, is_stream
from rebsync.reverse.libraries.routines import Language

STREAM_FAILURE = "std::ios_base::failure"
_SHIFTS = (Operator.SHIFT_LEFT, Operator.SHIFT_RIGHT)


def may_fail(origins: Origins, node: s.Call | e.Expression) -> bool:
    """Whether a call or an operator may end with the failure of a stream.

    Which stream was asked to throw is not looked for: any may be that one by another name.
    """
    is_cpp = origins.table.language is Language.CPP
    if not is_cpp or not origins.of_cpp.has_throwing_streams:
        return False
    match node:
        case s.Call(_, s.LibraryCallee(name, receiver)):
            of_class = is_stream(name.rpartition("::")[0]) and receiver is not None
            return of_class or name in STREAM_FUNCTIONS
        case e.Binary(operator, left) if operator in _SHIFTS:
            return _is_stream(left)
        case _:
            return False


def _is_stream(value: e.Expression) -> bool:
    """Whether a value is a stream, by its type, or by what is written to it first."""
    match value:
        case e.Binary(operator, left) if operator in _SHIFTS:
            return _is_stream(left)
        case e.LibraryReference(name):
            return name in STREAM_OBJECTS
        case _:
            type_ = getattr(value, "type", t.UNKNOWN)
            type_ = type_.to if isinstance(type_, t.Reference) else type_
            return isinstance(type_, t.Record) and is_stream(type_.name)
