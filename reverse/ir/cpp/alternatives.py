"""Calls of which types do not say what they run: each function that may be meant, one of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import Context, Value
from rebsync.reverse.ir.cpp.objects import address, as_value, dereferenced
from rebsync.reverse.ir.cpp.overloads import Ambiguous, ArgumentValue, resolve
from rebsync.reverse.ir.cpp.symbols import FunctionSymbol
from rebsync.reverse.ir.operators import Conversion
from rebsync.source import Span

Calling = Callable[[FunctionSymbol], Value]


def call_chosen(
    context: Context,
    candidates: Sequence[FunctionSymbol],
    arguments: Sequence[ArgumentValue],
    call: Calling,
    place: Span,
) -> Value:
    """A call of the overload that the arguments choose, or of any that they may."""
    try:
        function = resolve(context, candidates, arguments)
    except Ambiguous as error:
        functions = error.functions
    else:
        return call(function)
    ways: list[tuple[list[s.Statement], Value]] = []
    for each in functions:
        with context.body() as body:
            ways.append((body, call(each)))
    return _joined(context, ways, place)


def one_of(context: Context, bodies: Sequence[s.Body], place: Span) -> None:
    """Emits bodies of which one runs."""
    *others, last = bodies
    for body in reversed(others):
        which = e.LibraryReference("the overload", t.UNKNOWN, place)
        test = e.Convert(Conversion.TRUTH, which, t.TRUTH, True, place)
        last = (s.If(test, body, last, False, place),)
    context.emit(*last)


def _joined(
    context: Context, ways: Sequence[tuple[list[s.Statement], Value]], place: Span
) -> Value:
    kinds = {value.type for _, value in ways}
    type_ = kinds.pop() if len(kinds) == 1 else t.UNKNOWN
    if type_ == t.NOTHING:
        one_of(context, [tuple(body) for body, _ in ways], place)
        return Value(e.Literal(None, t.NOTHING, place=place), t.NOTHING)
    is_place = any(value.is_lvalue for _, value in ways)
    target = context.temporary(t.Reference(type_) if is_place else type_, place)
    for body, value in ways:
        with context.within(body):
            found = (address if is_place else as_value)(context, value, place)
            context.emit(s.Assign(target, found, place))
    one_of(context, [tuple(body) for body, _ in ways], place)
    return dereferenced(target, type_, place) if is_place else Value(target, type_)
