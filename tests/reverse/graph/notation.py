"""Facts on one line each, as the comments in the cases say them after `//=`.

A value is a JSON value, `{name = default : expression}` for that of a parameter, `a | b` for one
of several, `.../x` for a name under a handle from outside, and `?` for what is not known, with what
is known of it.
"""

from __future__ import annotations

import json

from rebsync.reverse.graph import (
    Callback,
    Callbacks,
    ClientFact,
    Fact,
    FromParameter,
    NodeFact,
    OneOf,
    ParameterFact,
    PublisherFact,
    RateFact,
    Resolved,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
    Under,
    Unresolved,
)
from rebsync.unions import assert_never


def noted(fact: Fact) -> str:
    """A fact on one line, without its place."""
    words = " ".join(word for word in _words(fact) if word)
    return f"{type(fact).__name__.removesuffix('Fact').lower()} {words}".strip()


def _words(fact: Fact) -> list[str]:
    match fact:
        case NodeFact():
            name = value_noted(fact.name) if fact.name is not None else ""
            return [
                name,
                "anonymous" * fact.anonymous,
                f"of {fact.nodelet}" if fact.nodelet else "",
            ]
        case PublisherFact():
            latched = "" if fact.latched is False else f"latched={value_noted(fact.latched)}"
            return [*_connected(fact), latched, fact.transport or ""]
        case SubscriptionFact():
            called = "single" if fact.single else _called(fact.callbacks)
            return [*_connected(fact), called, fact.transport or ""]
        case TimerFact():
            once = "" if fact.one_shot is False else f"one_shot={value_noted(fact.one_shot)}"
            start = "" if fact.autostart is True else f"autostart={value_noted(fact.autostart)}"
            clock = "wall" * fact.wall
            return [value_noted(fact.period), once, start, clock, _called(fact.callbacks)]
        case RateFact():
            return [value_noted(fact.hz), "wall" * fact.wall]
        case ParameterFact():
            default = f"= {value_noted(fact.default)}" if fact.default is not None else ""
            value = f":= {value_noted(fact.value)}" if fact.value is not None else ""
            access = "search" if fact.search else fact.access.value
            return [access, value_noted(fact.name), default, value]
        case ServiceFact():
            return [value_noted(fact.name), value_noted(fact.type), _called(fact.callbacks)]
        case ClientFact():
            return [value_noted(fact.name), value_noted(fact.type)]
        case _:
            assert_never(fact)


def _connected(fact: PublisherFact | SubscriptionFact) -> list[str]:
    return [value_noted(v) for v in (fact.topic, fact.type, fact.depth)]


def _called(callbacks: Callbacks) -> str:
    return "-> " + " | ".join(
        _callback(c) if isinstance(c, Callback) else value_noted(c) for c in callbacks
    )


def _callback(callback: Callback) -> str:
    through = f" by {callback.through}" if callback.through else ""
    bound = f" with {len(callback.bound)}" if callback.bound else ""
    return (callback.name or "lambda") + bound + through


def value_noted(value: Resolved) -> str:
    """A value in the notation."""
    match value:
        case FromParameter():
            default = f" = {value_noted(value.default)}" if value.default is not None else ""
            how = f" : {value.expression}" if value.expression is not None else ""
            search = "search " if value.search else ""
            return f"{{{search}{value_noted(value.name)}{default}{how}}}"
        case OneOf(values):
            return " | ".join(value_noted(v) for v in values)
        case Under(name, handles):
            return f".../{name}" + (f" of {', '.join(handles)}" if handles else "")
        case Unresolved():
            return "?" + (f" {json.dumps(value.partial)}" if value.partial else "")
        case _:
            return json.dumps(value)
