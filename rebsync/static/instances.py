"""Checks `main`: the instances, their bindings and the arguments of their constructors."""

from __future__ import annotations

from rebsync.model import Main, Rebec, Type
from rebsync.static.annotations import check_annotations
from rebsync.static.expressions import type_of
from rebsync.static.facts import Access, Facts
from rebsync.static.overloads import select
from rebsync.static.resolve import resolve_class
from rebsync.static.scope import Body, Kind, check_name
from rebsync.static.symbols import ClassInfo, RebecSymbol
from rebsync.static.types import converts, is_rebec


def check_main(facts: Facts, main: Main) -> None:
    """Checks all instances; each may be bound to any other."""
    infos = [_declare(facts, rebec) for rebec in main.rebecs]
    body = Body(facts, Kind.MAIN, visible=facts.rebecs)
    for rebec, info in zip(main.rebecs, infos, strict=True):
        bindings = [type_of(b, body) for b in rebec.bindings]
        arguments = [type_of(a, body) for a in rebec.arguments]
        if info is not None and not info.partial:
            _check_bindings(facts, rebec, info, bindings)
            _check_arguments(facts, rebec, info, arguments)
    facts.outside.extend(e for e in body.events if isinstance(e, Access))


def _declare(facts: Facts, rebec: Rebec) -> ClassInfo | None:
    check_annotations(facts, rebec.annotations, "an instance")
    type_ = resolve_class(facts, rebec.type)
    info = facts.classes.get(type_.name) if type_ is not None else None
    if type_ is not None:
        info = _check_instantiable(facts, rebec, type_, info)
    symbol = RebecSymbol(rebec.name, type_, rebec)
    facts.symbols[id(rebec)] = symbol
    _enter(facts, symbol)
    return info


def _check_instantiable(
    facts: Facts, rebec: Rebec, type_: Type, info: ClassInfo | None
) -> ClassInfo | None:
    if info is not None and not info.is_abstract and not type_.dimensions:
        return info
    if info is None or type_.dimensions:
        message = f'"{type_}" is not a class'
    else:
        message = f'"{info.name}" is {"an interface" if info.is_interface else "abstract"}'
    hint = "an instance needs a class that has all bodies"
    facts.error("RS410", rebec.type.span, f"{message} and has no instances", hint)
    return None


def _enter(facts: Facts, symbol: RebecSymbol) -> None:
    name, span = symbol.name, symbol.declaration.name_span
    check_name(facts, name, span)
    first = facts.rebecs.get(name)
    env = facts.env.get(name)
    if first is not None:
        place = ((first.declaration.name_span, "first declared here"),)
        facts.error("RS209", span, f'the rebec "{name}" is already declared', related=place)
        return
    if env is not None:
        place = ((env.declaration.name_span, "the env variable"),)
        facts.error("RS209", span, f'"{name}" is already an env variable', related=place)
    facts.rebecs[name] = symbol


def _check_bindings(
    facts: Facts, rebec: Rebec, info: ClassInfo, bindings: list[Type | None]
) -> None:
    wanted = ", ".join(f"{k.type or '?'} {k.name}" for k in info.known)
    if len(bindings) != len(info.known):
        count = len(info.known)
        message = (
            f'"{info.name}" knows {count} rebec{"" if count == 1 else "s"}, not {len(bindings)}'
        )
        hint = f"bind in this order: {wanted}" if wanted else "write () before the colon"
        facts.error("RS411", rebec.name_span, message, hint)
        return
    for binding, given, symbol in zip(rebec.bindings, bindings, info.known, strict=True):
        if given is None or symbol.type is None or converts(given, symbol.type, facts.classes):
            continue
        what = f'a rebec of "{given}"' if is_rebec(given) else f'a value of type "{given}"'
        message = f'"{symbol.name}" must be a rebec of "{symbol.type}", this is {what}'
        place = ((symbol.declaration.name_span, "the known rebec"),)
        hint = f"bind in this order: {wanted}"
        facts.error("RS411", binding.span, message, hint, related=place)


def _check_arguments(
    facts: Facts, rebec: Rebec, info: ClassInfo, arguments: list[Type | None]
) -> None:
    if not info.constructors:
        if arguments:
            message = f'"{info.name}" has no constructor that takes arguments'
            facts.error("RS310", rebec.name_span, message)
        return
    chosen = select(
        info.constructors, arguments, rebec.arguments, info.name, rebec.name_span, facts
    )
    if chosen is not None:
        facts.constructors[id(rebec)] = chosen
