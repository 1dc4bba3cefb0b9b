"""Name resolution for editors: every place where a named element is declared or used."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rebsync import model as m
from rebsync import properties as p
from rebsync.records import dataclass
from rebsync.source import Span
from rebsync.static import Analysis
from rebsync.static.symbols import (
    BuiltinFunctionSymbol,
    BuiltinSymbol,
    Callable,
    ClassInfo,
    EnvSymbol,
    KnownRebecSymbol,
    LocalSymbol,
    MethodSymbol,
    ParameterSymbol,
    RebecSymbol,
    ServerSymbol,
    StateSymbol,
    Symbol,
)


@dataclass(frozen=True, slots=True)
class Entity:
    """What a name refers to; kinds are those of markers, and `local`, `define` and `property`.

    `owner` is the class that declares it. Message servers and methods that override or implement
    each other are one entity, as are overloads. Of locals and parameters it is their place.
    """

    kind: str
    owner: str
    name: str


@dataclass(frozen=True, slots=True)
class Occurrence:
    """A name at a place; `declares` is the node, where it is the declaration."""

    span: Span
    entity: Entity
    declares: object = None


def of_model(analysis: Analysis) -> Iterator[Occurrence]:
    """The occurrences in a model."""
    resolver = _Resolver(analysis)
    for each in analysis.model.classes:
        yield from resolver.head(each)
    for node in m.walk(analysis.model):
        yield from resolver.node(node)


def of_properties(properties: p.Properties, analysis: Analysis | None) -> Iterator[Occurrence]:
    """The occurrences in a property file; of names of the model where there is one."""
    defines = {define.name for define in properties.defines}
    for define in properties.defines:
        yield Occurrence(define.name_span, Entity("define", "", define.name), define)
        yield from _in_formula(define.value, defines, analysis)
    for each in properties.all:
        yield Occurrence(each.name_span, Entity("property", "", each.name), each)
        yield from _in_formula(each.formula, defines, analysis)


def _in_formula(
    formula: p.Formula, defines: set[str], analysis: Analysis | None
) -> Iterator[Occurrence]:
    for expression in _expressions(formula):
        for node in m.walk(expression):
            match node:
                case m.Name(name, span) if name in defines:
                    yield Occurrence(span, Entity("define", "", name))
                case m.Name(name, span) if analysis is not None and name in _rebecs(analysis):
                    yield Occurrence(span, Entity("rebec", "", name))
                case m.Name(name, span) if analysis is not None and name in analysis.env:
                    yield Occurrence(span, Entity("env", "", name))
                case m.Member(m.Name(rebec), name) if analysis is not None:
                    type_ = _rebecs(analysis).get(rebec)
                    info = analysis.classes.get(type_.name) if type_ is not None else None
                    symbol = info.variables.get(name) if info is not None else None
                    if isinstance(symbol, StateSymbol):
                        yield Occurrence(node.name_span, Entity("statevar", symbol.owner, name))


def _expressions(formula: p.Formula) -> Iterator[m.Expression]:
    if isinstance(formula, p.Tctl) and formula.bound is not None:
        yield formula.bound.limit
    below = p.operands(formula)
    for each in below:
        yield from _expressions(each)
    if not below and not isinstance(formula, p.Not | p.And | p.Or | p.Implies | p.Ltl | p.Tctl):
        yield formula


def _rebecs(analysis: Analysis) -> dict[str, m.Type]:
    main = analysis.model.main
    return {rebec.name: rebec.type for rebec in (main.rebecs if main is not None else ())}


class _Resolver:
    """Tells of each node of a model which names it has and what they refer to."""

    def __init__(self, analysis: Analysis) -> None:
        self.analysis = analysis
        self.roots = families(analysis.classes.values())
        self.members: dict[int, StateSymbol | KnownRebecSymbol | Callable] = {}
        for info in analysis.classes.values():
            for variable in info.variables.values():
                self.members[id(variable.declaration)] = variable
            callables: tuple[Callable, ...] = (*info.servers, *info.methods)
            for each in callables:
                self.members[id(each.declaration)] = each

    def head(self, of: m.ReactiveClass | m.Interface) -> Iterator[Occurrence]:
        yield Occurrence(of.name_span, Entity("reactiveclass", "", of.name), of)
        for name, span in _ancestors(of):
            if name in self.analysis.classes:
                yield Occurrence(span, Entity("reactiveclass", "", name))

    def node(self, node: m.Node) -> Iterator[Occurrence]:
        match node:
            case m.Type(name, _, span) if name in self.analysis.classes and span.end:
                yield Occurrence(
                    Span(span.start, span.start + len(name)), Entity("reactiveclass", "", name)
                )
            case m.Constructor(name):
                yield Occurrence(node.name_span, Entity("reactiveclass", "", name))
            case m.Name():
                yield from self._use(node, node.span)
            case m.Member() | m.Call():
                yield from self._use(node, node.name_span)
            case m.Declarator() | m.Parameter() | m.Rebec() | m.MessageServer() | m.Method():
                symbol = self.members.get(id(node)) or self.analysis.symbol_of(node)
                entity = self.entity(symbol) if symbol is not None else None
                if entity is not None:
                    yield Occurrence(node.name_span, entity, node)

    def _use(self, node: object, span: Span) -> Iterator[Occurrence]:
        symbol = self.analysis.symbol_of(node)
        entity = self.entity(symbol) if symbol is not None else None
        if entity is not None:
            yield Occurrence(span, entity)

    def entity(self, symbol: Symbol) -> Entity | None:
        match symbol:
            case EnvSymbol():
                return Entity("env", "", symbol.name)
            case StateSymbol():
                return Entity("statevar", symbol.owner, symbol.name)
            case KnownRebecSymbol():
                return Entity("knownrebec", symbol.owner, symbol.name)
            case RebecSymbol():
                return Entity("rebec", "", symbol.name)
            case LocalSymbol() | ParameterSymbol():
                return Entity("local", str(symbol.declaration.name_span.start), symbol.name)
            case ServerSymbol():
                return Entity("msgsrv", self._root(symbol.owner, symbol.name), symbol.name)
            case MethodSymbol():
                return Entity("method", self._root(symbol.owner, symbol.name), symbol.name)
            case BuiltinSymbol() | BuiltinFunctionSymbol():
                return None

    def _root(self, owner: str, name: str) -> str:
        return self.roots.get((owner, name), owner)


def _ancestors(of: m.ReactiveClass | m.Interface) -> Iterator[tuple[str, Span]]:
    match of:
        case m.ReactiveClass():
            if of.extends is not None:
                yield of.extends, of.extends_span
            yield from zip(of.implements, of.implements_spans, strict=True)
        case m.Interface():
            yield from zip(of.extends, of.extends_spans, strict=True)


def families(classes: Iterable[ClassInfo]) -> dict[tuple[str, str], str]:
    """For each callable of each class one class of all that declare it, by union-find."""
    parent: dict[tuple[str, str], tuple[str, str]] = {}

    def find(key: tuple[str, str]) -> tuple[str, str]:
        while parent.setdefault(key, key) != key:
            key = parent[key]
        return key

    every = {info.name: info for info in classes}
    for info in every.values():
        first: dict[str, tuple[str, str]] = {}
        for name in info.lineage:
            own = every.get(name, info)
            callables: tuple[Callable, ...] = (*own.servers, *own.methods)
            for symbol in callables:
                key = find((symbol.owner, symbol.name))
                parent[key] = find(first.setdefault(symbol.name, key))
    return {key: find(key)[0] for key in list(parent)}
