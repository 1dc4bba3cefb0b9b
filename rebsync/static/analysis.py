"""The static semantics of a model: every rule, in one pass over each part of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from rebsync.diagnostics import Diagnostic, Severity
from rebsync.model import Call, Constructor, Env, Expression, Model, Rebec, Type
from rebsync.records import dataclass
from rebsync.source import Span
from rebsync.static.bodies import check_bodies
from rebsync.static.classes import build_classes
from rebsync.static.constants import Value, constant
from rebsync.static.environment import check_env
from rebsync.static.facts import Facts
from rebsync.static.heritage import declare_classes
from rebsync.static.instances import check_main
from rebsync.static.structure import check_class, check_refused
from rebsync.static.symbols import ClassInfo, ConstructorInfo, EnvSymbol, ServerSymbol, Symbol
from rebsync.static.warnings import check_warnings


@dataclass(frozen=True, slots=True)
class Analysis:
    """What is known of a model; `types` and `symbols` go by the `id` of a node of `model`."""

    model: Model
    diagnostics: tuple[Diagnostic, ...]
    types: Mapping[int, Type] = field(repr=False)
    symbols: Mapping[int, Symbol] = field(repr=False)
    classes: Mapping[str, ClassInfo] = field(repr=False)
    env: Mapping[str, EnvSymbol] = field(repr=False)
    constructors: Mapping[int, ConstructorInfo] = field(repr=False)

    @property
    def errors(self) -> tuple[Diagnostic, ...]:
        return tuple(d for d in self.diagnostics if d.severity is Severity.ERROR)

    def type_of(self, expression: Expression) -> Type | None:
        """The static type of an expression of the model."""
        return self.types.get(id(expression))

    def symbol_of(self, node: object) -> Symbol | None:
        """What a name, member or call refers to; for a declaration, its own symbol."""
        return self.symbols.get(id(node))

    def server_of(self, call: Call) -> ServerSymbol | None:
        """The message server that a call sends to, when it is a send."""
        symbol = self.symbols.get(id(call))
        return symbol if isinstance(symbol, ServerSymbol) else None

    def constructor_of(self, rebec: Rebec) -> Constructor | None:
        """The constructor that an instance runs; None is the empty one that a class has anyway."""
        info = self.constructors.get(id(rebec))
        return info.declaration if info is not None else None

    def value_of(self, expression: Expression) -> Value | None:
        """The value of a constant expression, env constants included."""
        return constant(expression, lambda name: self._env_value(id(name)))

    def _env_value(self, key: int) -> Value | None:
        symbol = self.symbols.get(key)
        return symbol.value if isinstance(symbol, EnvSymbol) else None


def analyse(
    model: Model,
    *,
    fragment: bool = False,
    incomplete: bool = False,
    observed: frozenset[str] = frozenset(),
) -> Analysis:
    """Checks a model.

    A `fragment` may lack `main` and whatever else would use its classes. Of an `incomplete`
    model some text could not be read, so that nothing is said about what it does not use.
    `observed` are names of state variables that properties read.
    """
    facts = Facts(fragment, incomplete, observed)
    try:
        _check(facts, model)
    except RecursionError:
        message = "an expression or statement nests deeper than rebsync reads"
        facts.error("RS111", model.span, message, "give parts of it names of their own")
    unique = dict.fromkeys(facts.diagnostics)
    return Analysis(
        model,
        tuple(sorted(unique, key=lambda d: (d.span.start, d.span.end, d.code))),
        facts.types,
        facts.symbols,
        facts.classes,
        facts.env,
        facts.constructors,
    )


def _check(facts: Facts, model: Model) -> None:
    declare_classes(facts, model.classes)
    for head in model.heads:
        if isinstance(head, Env):
            check_env(facts, head.declaration)
        else:
            check_refused(facts, head)
    build_classes(facts, model.classes)
    for info in facts.infos:
        check_class(facts, info)
        check_bodies(facts, info)
    if model.main is not None:
        check_main(facts, model.main)
    _check_whole(facts, model)
    check_warnings(facts, model)


def _check_whole(facts: Facts, model: Model) -> None:
    if facts.fragment or facts.incomplete:
        return
    start, end = (Span(at, at) for at in (model.span.start, model.span.end))
    if model.main is None:
        facts.error("RS401", end, "the model has no main", "declare its rebecs: main { ... }")
    if not model.classes:
        facts.error("RS402", start, "the model has no class")
