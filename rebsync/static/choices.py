"""The rules of nondeterministic expressions: `?(a, b)`."""

from __future__ import annotations

from rebsync.model import Choice, Expression, Name, Type, walk
from rebsync.static.constants import Value, constant
from rebsync.static.scope import Body, Kind
from rebsync.static.symbols import EnvSymbol
from rebsync.static.types import common

_HERE = {
    Kind.CONSTRUCTOR: "a constructor",
    Kind.METHOD: "a method",
    Kind.MAIN: "main",
    Kind.ENV: "an env variable",
}


def check_choice(choice: Choice, types: list[Type | None], body: Body) -> Type | None:
    """The type of a choice: the widest of its options."""
    facts = body.facts
    if len(choice.options) < 2:
        hint = "write at least two options, or the value alone"
        facts.error("RS420", choice.span, "there is nothing to choose from", hint)
    if body.kind is not Kind.SERVER:
        message = f"{_HERE[body.kind]} cannot choose: only a message server can"
        hint = "choose in the server and pass the value on"
        facts.error("RS422", choice.span, message, hint)
    seen: set[tuple[type, Value]] = set()
    for option, type_ in zip(choice.options, types, strict=True):
        if type_ is not None:
            _check_option(option, seen, body)
    return _widest(choice, types, body)


def _check_option(option: Expression, seen: set[tuple[type, Value]], body: Body) -> None:
    value = constant(option)
    if value is None:
        hint = "write literals; in their place an if can choose between other values"
        if any(_is_env(n, body) for n in walk(option) if isinstance(n, Name)):
            hint = "an env variable may change at the start: write its value as a literal"
        message = "an option of ?(...) must be constant"
        body.facts.error("RS421", option.span, message, hint)
    elif (type(value), value) in seen:
        message = f"the option {str(value).lower()} stands here twice"
        body.facts.warn("RS512", option.span, message, "each counts as a choice of its own")
    else:
        seen.add((type(value), value))


def _is_env(name: Name, body: Body) -> bool:
    return isinstance(body.facts.symbols.get(id(name)), EnvSymbol)


def _widest(choice: Choice, types: list[Type | None], body: Body) -> Type | None:
    widest: Type | None = None
    for type_ in types:
        if type_ is None:
            return None
        both = type_ if widest is None else common(widest, type_, body.facts.classes)
        if both is None:
            message = f'the options have the types "{widest}" and "{type_}"'
            body.facts.error("RS307", choice.span, message, "all must be of one type")
            return None
        widest = both
    return widest
