"""The message servers of a unit: one for each callback of subscriptions, timers and services."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.build.message_types import Fields, MessageTypes
from rebsync.reverse.graph import Callback, Fact, ServiceFact, SubscriptionFact, TimerFact
from rebsync.reverse.nodes.node_names import Names, model_word
from rebsync.reverse.nodes.node_taken import declared, uses
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_calls import calls_in
from rebsync.reverse.syntax.cpp_declarations import lambda_parameters, name_of_parameter
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of

Asking: TypeAlias = SubscriptionFact | TimerFact | ServiceFact
_HEADER = "header."
_PLACE = re.compile(r"(^|::)_\d$")


@dataclass(frozen=True, slots=True)
class ParameterField:
    """A field of a message that a server gets as a parameter."""

    path: str
    name: str
    type: m.Type


@dataclass(frozen=True, slots=True)
class Server:
    """A message server to be.

    `message` is the name of the callback's parameter that is the message, or the timer's event;
    `arguments` are those that a bind fills, by name.
    """

    name: str
    callback: Callback
    cpp: Cpp
    body: Node
    message: str
    arguments: tuple[tuple[str, Node], ...]
    type: str | None = None
    parameters: tuple[ParameterField, ...] = ()
    subscriptions: tuple[SubscriptionFact, ...] = ()
    timers: tuple[TimerFact, ...] = ()
    service: ServiceFact | None = None

    @property
    def fields(self) -> tuple[str, ...]:
        """The paths of the fields that it gets."""
        return tuple(p.path for p in self.parameters)


def servers(unit: Unit, types: MessageTypes, names: Names) -> tuple[Server, ...]:
    """The servers of a unit, in the order of its subscriptions and timers."""
    found: dict[tuple[object, ...], Server] = {}
    never = replaced(unit.facts)
    for fact in unit.facts:
        if not isinstance(fact, SubscriptionFact | TimerFact | ServiceFact) or fact in never:
            continue
        for callback in fact.callbacks:
            body = _body(callback, unit.code) if isinstance(callback, Callback) else None
            if not isinstance(callback, Callback) or body is None:
                continue
            _, bound = _arguments(callback, fact)
            given = tuple(text_of(node) for _, node in bound)
            key = body[1].id, given, _kind(fact, callback, types)
            known = found.get(key)
            if known is None:
                found[key] = _server(unit.code, fact, callback, body, types, names)
            elif isinstance(fact, SubscriptionFact):
                found[key] = replace(known, subscriptions=(*known.subscriptions, fact))
            elif isinstance(fact, TimerFact):
                found[key] = replace(known, timers=(*known.timers, fact))
    return tuple(found.values())


def _kind(fact: Asking, callback: Callback, types: MessageTypes) -> object:
    """What callbacks must have in common to be one server: a timer that goes on is alone."""
    if isinstance(fact, SubscriptionFact):
        return "message", _type(fact, callback, types), topic_of(fact)
    if isinstance(fact, ServiceFact):
        return "service"
    return "once" if fact.one_shot is True else id(fact)


def topic_of(fact: SubscriptionFact) -> str:
    """The topic of a subscription: one callback for two topics is a server for each of them."""
    return fact.topic if isinstance(fact.topic, str) else ""


def beside_topic(name: str, fact: Fact) -> tuple[str, ...]:
    """What a server is called whose name another one of the same callback has."""
    topic = topic_of(fact) if isinstance(fact, SubscriptionFact) else ""
    return (model_word(f"{name}_{topic.strip('/')}"),) if topic else ()


def _body(callback: Callback, code: Code) -> tuple[Cpp, Node] | None:
    """What is called, and the file that it is in: a lambda may come from another one."""
    if callback.function is not None and callback.function.body is not None:
        return callback.function.cpp, callback.function.body
    body = callback.lambda_.child_by_field_name("body") if callback.lambda_ is not None else None
    return (code.file_of(body), body) if body is not None else None


def _server(
    code: Code,
    fact: Asking,
    callback: Callback,
    body: tuple[Cpp, Node],
    types: MessageTypes,
    names: Names,
) -> Server:
    wish = callback.name.rpartition("::")[2] or _kept(fact) or "callback"
    message, bound = _arguments(callback, fact)
    wish = wish if wish != "operator()" else _of_functor(callback.through or "")
    name = names.give(wish, *beside_topic(wish, fact))
    if isinstance(fact, ServiceFact):
        return Server(name, callback, *body, "", (), service=fact)
    if isinstance(fact, TimerFact):
        return Server(name, callback, *body, message, bound, timers=(fact,))
    type_ = _type(fact, callback, types)
    fields = types.fields(type_) if type_ is not None else None
    carried = tuple(_carried(code, fields or {}, message, body, names.used))
    return Server(name, callback, *body, message, bound, type_, carried, (fact,))


def _arguments(callback: Callback, fact: Asking) -> tuple[str, tuple[tuple[str, Node], ...]]:
    """The callback's parameter for the message, and those that a bind fills with what."""
    names = [n for n, _ in _parameters(callback)]
    for call in calls_in(fact.site.call) if b"bind" in fact.site.cpp.words else ():
        if call.name.rpartition("::")[2] != "bind" or not call.arguments:
            continue
        given = list(call.arguments[1:])
        owner = callback.function.owner if callback.function is not None else ""
        if owner and given:
            given = given[1:]
        pairs = list(zip(names, given, strict=False))
        message = next((n for n, node in pairs if _PLACE.search(text_of(node))), "")
        return message, tuple((n, node) for n, node in pairs if not _PLACE.search(text_of(node)))
    return names[0] if names else "", ()


def _of_functor(class_: str) -> str:
    """What an object that is called has as its server's name: not that of its class."""
    plain = class_.rpartition("::")[2]
    name = plain[:1].lower() + plain[1:]
    return name if name not in ("", plain) else f"{name}_called".lstrip("_")


def replaced(facts: Sequence[Fact]) -> list[TimerFact]:
    """The timers that never go off: their variables get other timers in the same run."""
    timers = [f for f in facts if isinstance(f, TimerFact) and f.site.kept]
    sure = [f for f in timers if _is_flat(f)]
    return [f for f in timers if any(_is_after(later, f) for later in sure)]


def share_variable(first: TimerFact, other: TimerFact) -> bool:
    """Whether two timers are put into one variable, one after the other."""
    return (
        first is not other
        and bool(first.site.kept)
        and first.site.kept.removeprefix("this->") == other.site.kept.removeprefix("this->")
        and first.site.owner == other.site.owner
        and (bool(first.site.owner) or _function(first) == _function(other))
    )


def _is_after(later: TimerFact, fact: TimerFact) -> bool:
    together = share_variable(fact, later) and _function(later) == _function(fact)
    return together and later.site.call.start_byte > fact.site.call.start_byte


def _function(fact: TimerFact) -> int | None:
    return fact.site.function.node.id if fact.site.function is not None else None


def _is_flat(fact: TimerFact) -> bool:
    """Whether a timer is made whenever its function runs."""
    ends = ("compound_statement", "if_statement", "conditional_expression", "lambda_expression")
    at = climb(fact.site.call, lambda n: n.type in ends)
    if at is None or at.type != "compound_statement":
        return False
    return at.parent is not None and at.parent.type == "function_definition"


def _kept(fact: Asking) -> str:
    return fact.site.kept.removeprefix("this->").rstrip("_")


def _type(fact: SubscriptionFact, callback: Callback, types: MessageTypes) -> str | None:
    """The type of the messages: as the subscription or the callback's signature says."""
    if isinstance(fact.type, str):
        return fact.type
    message, _ = _arguments(callback, fact)
    spelled = dict(_parameters(callback)).get(message)
    return types.named(spelled) if spelled is not None else None


def _parameters(callback: Callback) -> list[tuple[str, str]]:
    """Name and type of each parameter of a callback."""
    if isinstance(callback.function, CppFunction):
        return [(p.name, text_of(p.type)) for p in callback.function.parameters]
    listed = lambda_parameters(callback.lambda_) if callback.lambda_ is not None else []
    types = (p.child_by_field_name("type") for p in listed)
    texts = [text_of(type_) if type_ is not None else "" for type_ in types]
    return [*zip(map(name_of_parameter, listed), texts, strict=True)]


# --- which fields are used ----------------------------------------------------------------------


def _carried(
    code: Code, fields: Fields, message: str, body: tuple[Cpp, Node], taken: set[str]
) -> Iterator[ParameterField]:
    """The fields of the model's types that a body uses, in the order of the message."""
    used = set(_used_paths(fields, uses(code, *body, message)))
    carried = [(path, type_) for path, type_ in fields.items() if path in used]
    names = Names.beside(declared(code, *body) | taken if carried else ())
    for path, type_ in carried:
        if type_ is not None:
            yield ParameterField(path, names.give(path.replace(".", "_")), type_)


def _used_paths(fields: Fields, uses: Iterable[Node]) -> Iterator[str]:
    """The paths of a variable's fields that are named; all where it is used as a whole."""
    for node in uses if fields else ():
        path = _path(node)
        if path in fields:
            yield path
            continue
        inner = f"{path}." if path else ""
        for each, type_ in fields.items():
            plain = type_ is not None and not type_.dimensions
            counted = each.endswith("header.seq") or (not inner and _of_header(each))
            if each.startswith(inner) and plain and not counted:
                yield each


def _of_header(path: str) -> bool:
    return path.startswith(_HEADER) or f".{_HEADER}" in path


def _path(node: Node) -> str:
    """The fields that follow a variable: `linear.x` of `msg->linear.x` and `(*msg).linear.x`."""
    at, parts = node, list[str]()
    while at.parent is not None:
        around = at.parent
        if around.type == "field_expression" and around.child_by_field_name("argument") == at:
            field = around.child_by_field_name("field")
            call = around.parent
            function = call.child_by_field_name("function") if call is not None else None
            if field is None or function == around:
                break
            parts.append(text_of(field))
        elif around.type == "field_expression" and text_of(around).startswith("this->"):
            pass
        elif around.type not in ("pointer_expression", "parenthesized_expression") or parts:
            break
        at = around
    return ".".join(parts)
