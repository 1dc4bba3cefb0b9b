"""What the bodies of a class send, and to whom."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from rebsync.model import (
    Block,
    Call,
    Constructor,
    Expression,
    MessageServer,
    Method,
    Name,
    Paren,
    ReactiveClass,
    Self,
    walk,
)
from rebsync.records import dataclass
from rebsync.static import Analysis
from rebsync.static.symbols import KnownRebecSymbol, ServerSymbol


@dataclass(frozen=True, slots=True)
class ToSelf:
    """A send to the rebec itself."""


@dataclass(frozen=True, slots=True)
class ToKnown:
    """A send to a known rebec, by its name in the class."""

    known: str


@dataclass(frozen=True, slots=True)
class ToAny:
    """A send to a rebec that a variable or `sender` holds, known by its class only."""

    class_name: str


Target = ToSelf | ToKnown | ToAny


@dataclass(frozen=True, slots=True)
class Send:
    """One send: to whom, and which server."""

    target: Target
    server: ServerSymbol


def bodies(declaration: ReactiveClass) -> Iterator[Block]:
    """The bodies that a class declares itself."""
    for member in declaration.members:
        if isinstance(member, Constructor | MessageServer | Method) and member.body is not None:
            yield member.body


def sends(declaration: ReactiveClass, analysis: Analysis) -> Iterator[Send]:
    """Every send in the bodies of a class, in the order of the text."""
    for body in bodies(declaration):
        for node in walk(body):
            if isinstance(node, Call):
                send = send_of(node, analysis)
                if send is not None:
                    yield send


def send_of(call: Call, analysis: Analysis) -> Send | None:
    """The send that a call is; None for calls of methods and built-ins."""
    server = analysis.symbols.get(id(call))
    if not isinstance(server, ServerSymbol):
        return None
    return Send(_target(call.target, server, analysis), server)


def known_as_values(declaration: ReactiveClass, analysis: Analysis) -> Iterator[KnownRebecSymbol]:
    """The known rebecs with which the bodies of a class do more than send to them."""
    nodes = [node for body in bodies(declaration) for node in walk(body)]
    names = Counter(id(n) for n in nodes if isinstance(n, Name))
    receivers = (r for n in nodes if isinstance(n, Call) and (r := _receiver(n, analysis)))
    names.subtract(map(id, receivers))  # one node may stand at several places
    for node in nodes:
        symbol = analysis.symbols.get(id(node)) if names[id(node)] > 0 else None
        if isinstance(symbol, KnownRebecSymbol):
            yield symbol


def _receiver(call: Call, analysis: Analysis) -> Expression | None:
    """What a send names as its receiver, parentheses apart."""
    target = call.target if send_of(call, analysis) is not None else None
    while isinstance(target, Paren):
        target = target.inner
    return target


def _target(target: Expression | None, server: ServerSymbol, analysis: Analysis) -> Target:
    match target:
        case None | Self():
            return ToSelf()
        case Paren(inner):
            return _target(inner, server, analysis)
        case Name(name) if isinstance(analysis.symbols.get(id(target)), KnownRebecSymbol):
            return ToKnown(name)
        case _:
            type_ = analysis.types.get(id(target))
            return ToAny(type_.name if type_ is not None else server.owner)
