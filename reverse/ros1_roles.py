"""What the functions and members of a class of generated code are for.

They are known by what they do: a handler is what a subscription puts into the mailbox, a function
that publishes or posts is a send. Names and markers decide nothing here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.names import original, uncarry
from rebsync.records import dataclass
from rebsync.reserved import OWN_TOPICS, RUNTIME_TOPICS
from rebsync.reverse.cpp_calls import CppCall, assigned_in, call_of, calls_in, string_of
from rebsync.reverse.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.cpp_tree import Cpp, named, text_of
from rebsync.reverse.scope import Sends

_SENSOR = "_sensor_"
Overload: TypeAlias = tuple[str, int]  # a server, and how many arguments it takes


@dataclass(frozen=True, slots=True)
class Advertised:
    """A publisher: to a known rebec, or to all of a class, and the last part of its topic."""

    known: str | None
    key: str
    message: str


@dataclass(slots=True)
class Roles:
    """Of one class alone: by function what it serves or sends, by member what that stands for.

    `handlers` and `messages` give the server's name in the model, `globals` the entry of the
    parameter server and the default, `annotations` those that the set-up of a server shows; of
    overloads that take equally many arguments the first one's first.
    """

    handlers: dict[str, str] = field(default_factory=dict)
    messages: dict[str, str] = field(default_factory=dict)
    shims: set[str] = field(default_factory=set)
    sends: dict[str, Sends] = field(default_factory=dict)
    publishers: dict[str, Advertised] = field(default_factory=dict)
    known: dict[str, str] = field(default_factory=dict)
    globals: dict[str, tuple[str, Node]] = field(default_factory=dict)
    constants: set[str] = field(default_factory=set)
    annotations: dict[Overload, list[tuple[m.Annotation, ...]]] = field(default_factory=dict)
    on_bridge: bool = False
    sensors: set[str] = field(default_factory=set)
    topics: dict[str, str] = field(default_factory=dict)
    queue_length: int | None = None


def roles_of(code: Code, owner: CppClass) -> Roles:
    """Reads what a class's constructors set up, and what its functions do with it.

    Sends are left out here: `add_sends` needs the handlers of all classes.
    """
    roles = Roles()
    functions = list(code.functions_of(owner))
    for member in owner.fields:
        if member.name.endswith(_SENSOR) and text_of(member.type).startswith("Sensor<"):
            roles.sensors.add(original(member.name.removesuffix(_SENSOR)))
    for function in functions:
        if function.name == owner.name:
            _wired(roles, function)
    for constructor in (*owner.functions, *functions):
        if constructor.name == owner.name:
            roles.queue_length = _queue_length(constructor) or roles.queue_length
    for function in functions:
        for call in code.calls_of(function):
            if call.name == "receive" and len(call.arguments) == 5:
                _received(code, roles, function, call)
    return roles


def add_sends(code: Code, owner: CppClass, all_roles: dict[str, Roles]) -> None:
    """Reads which functions of a class send what to whom."""
    lineage = [all_roles[c.name] for c in code.lineage(owner.name)]
    publishers = {n: p for roles in reversed(lineage) for n, p in roles.publishers.items()}
    servers = {m: s for roles in all_roles.values() for m, s in roles.messages.items()}
    roles = all_roles[owner.name]
    for function in code.functions_of(owner):
        for call in code.calls_of(function):
            sends = _sent(code, function, call, publishers, servers)
            if sends is not None:
                roles.sends[function.name] = sends


def _port(roles: Roles, shim: str) -> Iterator[m.Annotation]:
    """`@Port` of a server whose topic says so."""
    if roles.topics.get(shim, "").startswith("port/"):
        yield m.Annotation("Port")


def _priority(code: Code, function: CppFunction, call: CppCall) -> Iterator[m.Annotation]:
    """`@priority(n)` or `@globalPriority(n)` of a server's descriptor."""
    found = code.constant(function.cpp, text_of(call.arguments[0]))
    for given in calls_in(found[1] if found is not None else None):
        if given.name in ("priority", "globalPriority") and len(given.arguments) == 1:
            number = text_of(given.arguments[0])
            value = m.IntLiteral(int(number.lstrip("-")))
            signed = m.Unary("-", value) if number.startswith("-") else value
            yield m.Annotation(given.name, (signed,))


def server_of(code: Code, cpp: Cpp, constant: str) -> str | None:
    """The server that a descriptor `constexpr Server kX{"x", priority}` is about."""
    found = code.constant(cpp, constant)
    if found is None or found[1].type != "initializer_list":
        return None
    values = named(found[1])
    return string_of(values[0]) if values else None


# --- set up by constructors ---------------------------------------------------------------------


def _wired(roles: Roles, constructor: CppFunction) -> None:
    for member, value in assigned_in(constructor.body):
        for call in calls_in(value):
            _member(roles, member, call)
    for call in calls_in(constructor.body):
        if call.name == "readArray" and len(call.arguments) == 3:
            key = string_of(call.arguments[1])
            if key is not None:
                member = text_of(call.arguments[2])
                values = dict(assigned_in(constructor.body))
                roles.globals[member] = key, values.get(member, call.node)


def _member(roles: Roles, member: str, call: CppCall) -> None:
    first = string_of(call.arguments[0]) if call.arguments else None
    if first is None:
        return
    match call.name, call.on:
        case "param", "node" if first.startswith("knownrebecs/"):
            roles.known[member] = original(first.partition("/")[2])
        case "param", "global" if len(call.arguments) == 2:
            roles.globals[member] = first, call.arguments[1]
        case "advertise", "mailbox_" if call.types:
            known, _, key = first.rpartition("/")
            to = uncarry(known, OWN_TOPICS)
            roles.publishers[member] = Advertised(to, key, text_of(call.types[0]))
        case "subscribe" | "subscribeOnBridge", "mailbox_" if len(call.arguments) == 3:
            roles.on_bridge = roles.on_bridge or call.name == "subscribeOnBridge"
            roles.topics[text_of(call.arguments[1]).rpartition("::")[2]] = first
        case "advertiseAll", "mailbox_" if call.types and len(call.arguments) == 2:
            key = string_of(call.arguments[1]) or ""
            roles.publishers[member] = Advertised(None, key, text_of(call.types[0]))


def _queue_length(constructor: CppFunction) -> int | None:
    """The number given to the mailbox, or as default to the parameter that is passed on to it."""
    if constructor.initialisers is not None:
        for initialiser in named(constructor.initialisers):
            for argument in named(initialiser.named_children[-1]):
                if argument.type == "number_literal":
                    return int(text_of(argument))
    for parameter in constructor.parameters:
        default = parameter.node.child_by_field_name("default_value")
        if default is not None and default.type == "number_literal":
            return int(text_of(default))
    return None


# --- what functions do --------------------------------------------------------------------------


def _received(code: Code, roles: Roles, function: CppFunction, call: CppCall) -> None:
    server = server_of(code, function.cpp, text_of(call.arguments[0]))
    handler = next(_own_calls(call.arguments[4]), None)
    if server is None or handler is None or not function.parameters:
        return
    message = text_of(function.parameters[0].type).partition("::ConstPtr")[0]
    roles.shims.add(function.name)
    roles.handlers[handler.name] = server
    shown = *_port(roles, function.name), *_priority(code, function, call)
    roles.annotations.setdefault((server, len(handler.arguments)), []).append(shown)
    roles.messages[message.rpartition("::")[2]] = server
    roles.constants.add(text_of(call.arguments[0]))


def _sent(
    code: Code,
    function: CppFunction,
    call: CppCall,
    publishers: dict[str, Advertised],
    servers: dict[str, str],
) -> Sends | None:
    if call.name == "post" and len(call.arguments) == 4 and call.on == "mailbox_":
        server = server_of(code, function.cpp, text_of(call.arguments[0]))
        return Sends("self", server, len(function.parameters) - 1) if server else None
    if call.name != "publish" or call.on != "mailbox_" or len(call.arguments) != 3:
        return None
    where, others = call.arguments[0], 1
    chosen = call_of(where)
    if chosen is not None and chosen.name == "to" and chosen.arguments:
        where, others = chosen.arguments[0], 2
    publisher = publishers.get(text_of(where))
    if publisher is None:
        return None
    server = servers.get(publisher.message) or uncarry(publisher.key, RUNTIME_TOPICS)
    return Sends(publisher.known, server, len(function.parameters) - others)


def _own_calls(node: Node) -> Iterator[CppCall]:
    """The calls of functions of the class in a lambda."""
    for call in calls_in(node):
        if call.target is None or call.target.type == "this":
            yield call
