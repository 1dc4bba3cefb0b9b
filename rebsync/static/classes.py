"""Builds what is known of each class: its own members over those of its ancestors."""

from __future__ import annotations

from dataclasses import field
from typing import TypeVar

from rebsync.model import (
    ClassMember,
    Constructor,
    Declaration,
    Interface,
    KnownRebecs,
    MessageServer,
    Method,
    Parameter,
    ReactiveClass,
    StateVars,
    Type,
)
from rebsync.records import dataclass
from rebsync.source import Span
from rebsync.static.facts import Facts
from rebsync.static.heritage import Heritage, ancestors_first
from rebsync.static.resolve import resolve, resolve_class, resolve_returned
from rebsync.static.scope import FUNCTIONS, check_name, redeclared
from rebsync.static.symbols import (
    Callable,
    ClassInfo,
    ConstructorInfo,
    KnownRebecSymbol,
    MethodSymbol,
    ServerSymbol,
    StateSymbol,
)
from rebsync.static.types import is_rebec

V = TypeVar("V", StateSymbol, KnownRebecSymbol)
Key = tuple[str, tuple[str, ...]]


@dataclass(slots=True)
class _Members:
    """The members of one class while they are gathered; `inherited` are those of its parents."""

    facts: Facts
    owner: str
    inherited: dict[str, StateSymbol | KnownRebecSymbol] = field(default_factory=dict)
    variables: dict[str, StateSymbol | KnownRebecSymbol] = field(default_factory=dict)
    overridden: dict[Key, Callable] = field(default_factory=dict)
    callables: dict[Key, Callable] = field(default_factory=dict)
    constructors: dict[Key, ConstructorInfo] = field(default_factory=dict)


def build_classes(facts: Facts, declarations: tuple[ReactiveClass | Interface, ...]) -> None:
    """Fills `facts.classes`, and `facts.infos` in the order of the text."""
    built: dict[int, ClassInfo] = {}
    for heritage in ancestors_first(facts, declarations):
        info = _build(facts, heritage, [built[id(p)] for p in heritage.parents])
        built[id(heritage.declaration)] = info
        facts.classes.setdefault(info.name, info)
    facts.classes.update({name: built[id(d)] for name, d in facts.declared.items()})
    facts.infos.extend(built[id(d)] for d in declarations)


def _build(facts: Facts, heritage: Heritage, parents: list[ClassInfo]) -> ClassInfo:
    declaration = heritage.declaration
    members = _Members(facts, declaration.name)
    for parent in parents:
        members.inherited.update(parent.variables)
        _inherit(members, parent, declaration.name_span)
    if isinstance(declaration, ReactiveClass):
        for member in declaration.members:
            _add(members, member)
    else:
        for server in declaration.servers:
            _add_callable(members, _server(members, server))
    everything = {**members.overridden, **members.callables}
    return ClassInfo(
        declaration.name,
        declaration,
        tuple(dict.fromkeys(name for p in parents for name in p.lineage)),
        (*(v for p in parents for v in p.state), *_of_kind(members, StateSymbol)),
        (*(v for p in parents for v in p.known), *_of_kind(members, KnownRebecSymbol)),
        tuple(c for c in everything.values() if isinstance(c, ServerSymbol)),
        tuple(c for c in everything.values() if isinstance(c, MethodSymbol)),
        tuple(members.constructors.values()),
        {**members.inherited, **members.variables},
        _by_name(everything),
        heritage.partial or any(p.partial for p in parents),
    )


def _of_kind(members: _Members, kind: type[V]) -> tuple[V, ...]:
    return tuple(v for v in members.variables.values() if isinstance(v, kind))


def _by_name(everything: dict[Key, Callable]) -> dict[str, tuple[Callable, ...]]:
    grouped: dict[str, list[Callable]] = {}
    for symbol in everything.values():
        grouped.setdefault(symbol.name, []).append(symbol)
    return {name: tuple(symbols) for name, symbols in grouped.items()}


def _inherit(members: _Members, parent: ClassInfo, place: Span) -> None:
    symbols: tuple[Callable, ...] = (*parent.servers, *parent.methods)
    for symbol in symbols:
        present = members.overridden.setdefault(_key(symbol), symbol)
        if present is not symbol and not _compatible(present, symbol):
            _collision(members.facts, place, present, symbol)


def _add(members: _Members, member: ClassMember) -> None:
    match member:
        case KnownRebecs(declarations):
            for declaration in declarations:
                _add_known(members, declaration)
        case StateVars(declarations):
            for declaration in declarations:
                _add_state(members, declaration)
        case Constructor():
            _add_constructor(members, member)
        case MessageServer():
            _add_callable(members, _server(members, member))
        case Method():
            _add_callable(members, _method(members, member))


def _add_state(members: _Members, declaration: Declaration) -> None:
    type_ = resolve(members.facts, declaration.type)
    for d in declaration.declarators:
        if d.initial is not None:
            hint = "set it in the constructor"
            message = f'the state variable "{d.name}" cannot have an initial value here'
            members.facts.error("RS405", d.span, message, hint)
        _add_variable(members, StateSymbol(d.name, type_, members.owner, d))


def _add_known(members: _Members, declaration: Declaration) -> None:
    type_ = resolve_class(members.facts, declaration.type)
    if type_ is not None and type_.dimensions:
        hint = "declare the known rebecs one by one"
        members.facts.error(
            "RS110", declaration.type.span, "arrays of known rebecs are not supported", hint
        )
        type_ = None
    elif type_ is not None and not is_rebec(type_):
        message = f'a known rebec must be of a class, not of type "{type_}"'
        members.facts.error("RS426", declaration.type.span, message, "declare it under statevars")
        type_ = None
    for d in declaration.declarators:
        if d.initial is not None:
            hint = "main binds known rebecs: C name(bindings):(arguments);"
            message = f'the known rebec "{d.name}" cannot have an initial value'
            members.facts.error("RS405", d.span, message, hint)
        _add_variable(members, KnownRebecSymbol(d.name, type_, members.owner, d))


def _add_variable(members: _Members, symbol: StateSymbol | KnownRebecSymbol) -> None:
    span, facts = symbol.declaration.name_span, members.facts
    check_name(facts, symbol.name, span)
    own = members.variables.get(symbol.name)
    if own is not None:
        redeclared(facts, symbol.name, span, own.declaration)
        return
    inherited = members.inherited.get(symbol.name)
    if inherited is not None:
        message = f'"{symbol.name}" hides the variable that "{inherited.owner}" declares'
        place = ((inherited.declaration.name_span, "the hidden one"),)
        facts.warn("RS511", span, message, "choose another name", related=place)
    members.variables[symbol.name] = symbol


def _signature(facts: Facts, parameters: tuple[Parameter, ...]) -> tuple[Type | None, ...]:
    return tuple(resolve(facts, p.type) for p in parameters)


def _server(members: _Members, server: MessageServer) -> ServerSymbol:
    signature = _signature(members.facts, server.parameters)
    return ServerSymbol(server.name, members.owner, signature, server)


def _method(members: _Members, method: Method) -> MethodSymbol:
    returned = resolve_returned(members.facts, method.type)
    signature = _signature(members.facts, method.parameters)
    return MethodSymbol(method.name, returned, members.owner, signature, method)


def _key(symbol: Callable) -> Key:
    return symbol.name, tuple(str(p.type) for p in symbol.declaration.parameters)


def _add_callable(members: _Members, symbol: Callable) -> None:
    facts, span, key = members.facts, symbol.declaration.name_span, _key(symbol)
    if symbol.name in FUNCTIONS:
        message = f'"{symbol.name}" hides the built-in of that name'
        facts.warn("RS511", span, message, "choose another name")
    own, inherited = members.callables.get(key), members.overridden.get(key)
    if own is not None:
        place = ((own.declaration.name_span, "first declared here"),)
        message = f'"{described(symbol)}" is already declared in "{members.owner}"'
        facts.error("RS208", span, message, related=place)
        return
    if inherited is not None and not _compatible(inherited, symbol):
        _collision(facts, span, inherited, symbol)
    members.callables[key] = symbol


def _add_constructor(members: _Members, constructor: Constructor) -> None:
    signature = _signature(members.facts, constructor.parameters)
    key = constructor.name, tuple(str(p.type) for p in constructor.parameters)
    first = members.constructors.get(key)
    if first is not None and constructor.name == members.owner:
        place = ((first.declaration.name_span, "first declared here"),)
        message = f'"{members.owner}({", ".join(key[1])})" is already declared'
        members.facts.error("RS208", constructor.name_span, message, related=place)
    elif constructor.name == members.owner:
        members.constructors[key] = ConstructorInfo(signature, constructor)


def _compatible(old: Callable, new: Callable) -> bool:
    if isinstance(old, MethodSymbol) and isinstance(new, MethodSymbol):
        return old.type is None or new.type is None or old.type == new.type
    return type(old) is type(new)


def _collision(facts: Facts, span: Span, old: Callable, new: Callable) -> None:
    message = f'"{described(new)}" of "{new.owner}" does not fit the one of "{old.owner}"'
    hint = "both must be message servers, or methods that return the same type"
    place = ((old.declaration.name_span, f'the one of "{old.owner}"'),)
    facts.error("RS414", span, message, hint, related=place)


def described(symbol: Callable) -> str:
    """A server or method with the types of its parameters."""
    return f"{symbol.name}({', '.join('?' if t is None else str(t) for t in symbol.signature)})"
