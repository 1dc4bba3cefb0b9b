"""What names and members refer to, when they are read and when they are assigned."""

from __future__ import annotations

from rebsync.model import Expression, Member, Name, Paren, ReactiveClass, Self, Super, Type
from rebsync.static.scope import Body, Kind
from rebsync.static.symbols import BuiltinSymbol, ClassInfo, EnvSymbol, KnownRebecSymbol, Variable
from rebsync.static.types import is_rebec


def bare(expression: Expression) -> Expression:
    """The expression without the parentheses around it."""
    while isinstance(expression, Paren):
        expression = expression.inner
    return expression


def name_type(name: Name, body: Body) -> Type | None:
    """The type of the variable that a name reads."""
    symbol = _find(name, body)
    if symbol is None:
        return None
    body.read(symbol, name.span)
    return symbol.type


def place_of(place: Name | Member, body: Body, *, reads: bool) -> Type | None:
    """The type of the variable that an assignment sets; `reads` when it also uses the old value."""
    symbol = _find(place, body) if isinstance(place, Name) else _field(place, body)
    if symbol is None:
        return None
    if isinstance(symbol, EnvSymbol | KnownRebecSymbol | BuiltinSymbol):
        _constant_target(place, symbol, body)
        return None
    if reads:
        body.read(symbol, place.span)
    body.write(symbol, place.span)
    return symbol.type


def member_type(member: Member, inner: Expression, target: Type | None, body: Body) -> Type | None:
    """The type of `target.name` when it is read; `inner` is the target without parentheses."""
    facts = body.facts
    if isinstance(inner, Self | Super):
        symbol = _field(member, body)
        if symbol is None:
            return None
        body.read(symbol, member.span)
        return symbol.type
    if target is None:
        return None
    if is_rebec(target) and target.name != "null":
        message = f'the variable "{member.name}" of another rebec cannot be used'
        hint = "rebecs share nothing: let it send the value in a message"
        facts.error("RS211", member.name_span, message, hint)
    else:
        message = f'a value of type "{target}" has no variable "{member.name}"'
        facts.error("RS205", member.name_span, message)
    return None


def super_type(expression: Super, body: Body) -> Type | None:
    """The class that `super` stands for."""
    declaration = body.owner.declaration if body.owner is not None else None
    if isinstance(declaration, ReactiveClass) and declaration.extends is not None:
        type_ = Type(declaration.extends)
        body.facts.symbols[id(expression)] = BuiltinSymbol("super", type_)
        return type_ if declaration.extends in body.facts.classes else None
    message = '"super" needs a class that extends another'
    body.facts.error("RS214", expression.span, message)
    return None


def _find(name: Name, body: Body) -> Variable | None:
    symbol = body.find(name.name)
    if symbol is None:
        _unknown(name, body)
        return None
    if isinstance(symbol, BuiltinSymbol) and name.name == "sender" and body.kind is not Kind.SERVER:
        message = f"there is no sender in a {body.kind.value}"
        hint = "only a message server has one: pass it on as an argument"
        body.facts.error("RS213", name.span, message, hint)
        return None
    body.facts.symbols[id(name)] = symbol
    return symbol


def _unknown(name: Name, body: Body) -> None:
    if body.is_partial:
        return
    facts, legal, span = body.facts, body.names(), name.span
    if body.kind is Kind.MAIN:
        facts.unknown("RS212", span, f'unknown rebec "{name.name}"', name.name, legal)
        return
    callable_ = body.owner is not None and name.name in body.owner.callables
    hint = f"to send or to call it write {name.name}(...)" if callable_ else None
    facts.unknown("RS203", span, f'unknown variable "{name.name}"', name.name, legal, hint)


def _field(member: Member, body: Body) -> Variable | None:
    if body.owner is None:
        return None
    inner = bare(member.target)
    if not isinstance(inner, Self | Super):
        member_type(member, inner, body.facts.types.get(id(member.target)), body)
        return None
    owner: ClassInfo | None = body.owner
    if isinstance(inner, Super):
        target = body.facts.types.get(id(member.target))
        owner = body.facts.classes.get(target.name) if target is not None else None
    if owner is None:
        return None
    symbol = owner.variables.get(member.name)
    if symbol is None:
        if not body.is_partial:
            message = f'"{owner.name}" has no variable "{member.name}"'
            body.facts.unknown("RS205", member.name_span, message, member.name, owner.variables)
        return None
    body.facts.symbols[id(member)] = symbol
    return symbol


def _constant_target(place: Name | Member, symbol: Variable, body: Body) -> None:
    if isinstance(symbol, EnvSymbol):
        message, hint = f'"{symbol.name}" is a constant of the model', "use a state variable"
    elif isinstance(symbol, KnownRebecSymbol):
        message = f'"{symbol.name}" is a known rebec, bound once in main'
        hint = "use a state variable of its class"
    else:
        message, hint = f'"{symbol.name}" cannot be assigned', None
    body.facts.error("RS315", place.span, message, hint)
