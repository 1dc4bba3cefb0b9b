"""Rules about the shape of classes: bodies, abstract members, constructors, queue lengths."""

from __future__ import annotations

from rebsync.diagnostics import did_you_mean
from rebsync.model import Constructor, MessageServer, Method, ReactiveClass, Refused
from rebsync.static.classes import described
from rebsync.static.facts import Facts
from rebsync.static.symbols import Callable, ClassInfo
from rebsync.static.types import INT_MAX

_REFUSED = {
    "featurevar": "a generated ROS system has no features: keep one model per variant",
    "record": "use parameters or state variables, one for each field",
    "package": "a model stands for itself",
    "import": "a model is one file",
}


def check_refused(facts: Facts, refused: Refused) -> None:
    """Says why a part of the language is not supported."""
    hint = _REFUSED.get(refused.keyword)
    facts.error("RS110", refused.span, f'"{refused.keyword}" is not supported', hint)


def check_class(facts: Facts, info: ClassInfo) -> None:
    """Checks one class or interface, its bodies left aside."""
    declaration = info.declaration
    if not isinstance(declaration, ReactiveClass):
        return
    if declaration.queue_length < 1:
        message = f'the queue of "{info.name}" has no place for a message'
        facts.error("RS431", declaration.queue_span, message, "write at least (1)")
    if declaration.queue_length > INT_MAX:
        message = f'the queue of "{info.name}" is larger than {INT_MAX}'
        facts.error("RS305", declaration.queue_span, message)
    for member in declaration.members:
        match member:
            case Constructor():
                _check_constructor(facts, info, member)
            case MessageServer() | Method():
                _check_member(facts, info, member)
    if not info.is_abstract and not info.partial:
        _check_complete(facts, info)


def _check_constructor(facts: Facts, info: ClassInfo, constructor: Constructor) -> None:
    name, span = constructor.name, constructor.name_span
    if name != info.name:
        hint = did_you_mean(name, [info.name])
        hint = hint or f"write its type, such as void {name}(...), or msgsrv for a message server"
        facts.error("RS412", span, f'"{name}" has no type and is not the constructor', hint)
    if constructor.body is None:
        facts.error("RS409", span, f'the constructor "{name}" has no body')


def _check_member(facts: Facts, info: ClassInfo, member: MessageServer | Method) -> None:
    name, span = member.name, member.name_span
    kind = "method" if isinstance(member, Method) else "message server"
    if name == info.name:
        hint = f"a constructor is written {name}(...), without msgsrv and without a type"
        facts.error("RS413", span, f'the {kind} "{name}" has the name of its class', hint)
    if member.abstract and member.body is not None:
        hint = "write ; in place of the body, or take abstract away"
        facts.error("RS409", span, f'the abstract {kind} "{name}" has a body', hint)
    if not member.abstract and member.body is None:
        hint = "write its body between { and }, or declare it abstract"
        facts.error("RS409", span, f'the {kind} "{name}" has no body', hint)
    if member.abstract and not info.is_abstract:
        message = f'"{info.name}" is not abstract but has the abstract {kind} "{name}"'
        facts.error("RS432", span, message, f"write abstract reactiveclass {info.name}")


def _check_complete(facts: Facts, info: ClassInfo) -> None:
    symbols: tuple[Callable, ...] = (*info.servers, *info.methods)
    for symbol in symbols:
        if symbol.owner != info.name and _is_open(facts, symbol):
            kind = "message server" if isinstance(symbol.declaration, MessageServer) else "method"
            facts.error(
                "RS408",
                info.declaration.name_span,
                f'"{info.name}" must define the {kind} "{described(symbol)}" of "{symbol.owner}"',
                "define it, or declare the class abstract",
                related=((symbol.declaration.name_span, "declared here without a body"),),
            )


def _is_open(facts: Facts, symbol: Callable) -> bool:
    owner = facts.classes.get(symbol.owner)
    return symbol.declaration.abstract or (owner is not None and owner.is_interface)
