"""From the types that a model writes to the types that it has."""

from __future__ import annotations

from rebsync.model import Type
from rebsync.source import Span
from rebsync.static.facts import Facts
from rebsync.static.types import INT_MAX, PRIMITIVES, REFUSED, TYPE_NAMES


def resolve(facts: Facts, written: Type, kind: str = "type") -> Type | None:
    """The type of a variable or parameter, or None when it is a mistake, which is reported."""
    name = written.name
    if name in PRIMITIVES or name in facts.declared or name == "ReactiveClass":
        if 0 in written.dimensions:
            facts.error("RS431", written.span, f'the array type "{written}" has no elements')
            return None
        if any(length > INT_MAX for length in written.dimensions):
            message = f'the array type "{name}" has more than {INT_MAX} elements'
            facts.error("RS305", written.span, message)
            return None
        return written
    _refuse(facts, written, kind)
    return None


def known(facts: Facts, written: Type) -> Type | None:
    """Like `resolve`, for a type whose mistakes have been reported already."""
    name = written.name
    if name in PRIMITIVES or name in facts.declared or name == "ReactiveClass":
        return None if 0 in written.dimensions else written
    return None


def resolve_returned(facts: Facts, written: Type) -> Type | None:
    """The type that a method returns; `void` is one."""
    if written.name == "void" and not written.dimensions:
        return written
    return resolve(facts, written)


def resolve_class(facts: Facts, written: Type) -> Type | None:
    """The class that a known rebec, an instance, a cast or `instanceof` names."""
    if written.name in facts.declared or written.name in TYPE_NAMES:
        return resolve(facts, written)
    return resolve(facts, written, "class")


def name_span(written: Type) -> Span:
    """The place of the name alone, without dimensions."""
    start = written.span.start
    return Span(start, start + len(written.name)) if written.span.end else written.span


def _refuse(facts: Facts, written: Type, kind: str) -> None:
    base = written.name.partition("<")[0]
    span = name_span(written)
    if base in REFUSED:
        facts.error("RS110", span, f'variables of type "{base}" are not supported', REFUSED[base])
    elif base == "void":
        facts.error("RS201", span, 'a variable cannot have the type "void"')
    else:
        legal = {*facts.declared} if kind == "class" else {*PRIMITIVES, *facts.declared}
        message = f'unknown {kind} "{written.name}"'
        facts.unknown("RS201", span, message, written.name, legal, certain=True)
