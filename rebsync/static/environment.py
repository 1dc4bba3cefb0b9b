"""The `env` constants of a model."""

from __future__ import annotations

from rebsync.diagnostics import Severity
from rebsync.model import (
    ArrayInitializer,
    Declaration,
    Declarator,
    Expression,
    Initializer,
    Type,
)
from rebsync.static.annotations import check_annotations
from rebsync.static.constants import Value
from rebsync.static.facts import Access, Facts
from rebsync.static.resolve import resolve
from rebsync.static.scope import Body, Kind, check_name, redeclared
from rebsync.static.statements import check_initializer
from rebsync.static.symbols import EnvSymbol
from rebsync.static.types import is_floating, is_rebec


def check_env(facts: Facts, declaration: Declaration) -> None:
    """Enters the constants of one declaration; later ones may use earlier ones."""
    check_annotations(facts, declaration.annotations, "an env variable")
    type_ = resolve(facts, declaration.type)
    if type_ is not None and is_rebec(type_):
        message = f'an env variable must be a number or a boolean, not "{type_}"'
        facts.error("RS404", declaration.type.span, message)
        type_ = None
    for declarator in declaration.declarators:
        _check_declarator(facts, declarator, type_)


def _check_declarator(facts: Facts, declarator: Declarator, type_: Type | None) -> None:
    name, span = declarator.name, declarator.name_span
    check_name(facts, name, span)
    value = None
    if declarator.initial is None:
        message = f'the env variable "{name}" has no value'
        facts.error("RS403", span, message, f"write {name} = ...")
    else:
        body = Body(facts, Kind.ENV)
        reported = len(facts.diagnostics)
        check_initializer(declarator.initial, type_, body)
        facts.outside.extend(e for e in body.events if isinstance(e, Access))
        found = facts.diagnostics[reported:]
        if type_ is not None and not any(d.severity is Severity.ERROR for d in found):
            value = _value(facts, declarator.initial, type_)
    if name in facts.env:
        redeclared(facts, name, span, facts.env[name].declaration)
        return
    symbol = EnvSymbol(name, type_, declarator, value)
    facts.env[name] = symbol
    facts.symbols[id(declarator)] = symbol


def _value(facts: Facts, initial: Initializer, type_: Type | None) -> Value | None:
    """The value of a constant; reports each part of it that is none."""
    if isinstance(initial, ArrayInitializer):
        for part in initial.values:
            _value(facts, part, None)
        return None
    return _scalar(facts, initial, type_)


def _scalar(facts: Facts, initial: Expression, type_: Type | None) -> Value | None:
    value = facts.value(initial)
    if value is None:
        message = "the value of an env variable must be constant"
        facts.error("RS404", initial.span, message, "use literals and earlier env variables")
        return None
    return float(value) if type_ is not None and is_floating(type_) else value
