"""Goes through the classes and checks every body."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.model import (
    Constructor,
    Declaration,
    KnownRebecs,
    MessageServer,
    Method,
    ReactiveClass,
    StateVars,
    Type,
)
from rebsync.static.annotations import check_annotations
from rebsync.static.facts import BodyFacts, Facts
from rebsync.static.resolve import known
from rebsync.static.scope import Body, Kind
from rebsync.static.statements import check_statements
from rebsync.static.symbols import BuiltinSymbol, ClassInfo, ParameterSymbol
from rebsync.static.types import VOID

_WHAT = {
    Constructor: "a constructor",
    MessageServer: "a message server",
    Method: "a method",
}


def check_bodies(facts: Facts, info: ClassInfo) -> None:
    """Checks the annotations and bodies of one class or interface."""
    declaration = info.declaration
    kind = "a class" if isinstance(declaration, ReactiveClass) else "an interface"
    check_annotations(facts, declaration.annotations, kind)
    if not isinstance(declaration, ReactiveClass):
        for server in declaration.servers:
            check_annotations(facts, server.annotations, "a message server")
        return
    me = BuiltinSymbol("self", Type(info.name))
    for member in declaration.members:
        if isinstance(member, Constructor | MessageServer | Method):
            check_annotations(facts, member.annotations, _WHAT[type(member)])
            _check_body(facts, info, member, me)
        else:
            for variables in _declarations(member):
                check_annotations(facts, variables.annotations, "a variable")


def _declarations(member: KnownRebecs | StateVars) -> Iterator[Declaration]:
    yield from member.declarations


def _check_body(
    facts: Facts,
    info: ClassInfo,
    member: Constructor | MessageServer | Method,
    me: BuiltinSymbol,
) -> None:
    kind, returns = _kind(facts, info, member)
    body = Body(facts, kind, info, returns, info.variables, self_symbol=me)
    with body.block():
        for parameter in member.parameters:
            symbol = ParameterSymbol(parameter.name, known(facts, parameter.type), parameter)
            body.declare(symbol)
        if member.body is not None:
            check_statements(member.body.statements, body)
    facts.bodies.append(BodyFacts(info, member, body.events))


def _kind(
    facts: Facts, info: ClassInfo, member: Constructor | MessageServer | Method
) -> tuple[Kind, Type | None]:
    match member:
        case MessageServer():
            return Kind.SERVER, VOID
        case Method(type=written):
            return Kind.METHOD, VOID if written.name == "void" else known(facts, written)
        case Constructor(name) if name == info.name:
            return Kind.CONSTRUCTOR, VOID
        case _:
            return Kind.METHOD, None
