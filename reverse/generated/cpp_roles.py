"""What the functions and members of a class of generated code are for.

They are known by what they do: a handler is what a subscription puts into the mailbox, a function
that publishes or posts is a send. Names and markers decide nothing here.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.names import original, uncarry
from rebsync.records import dataclass
from rebsync.reserved import OWN_TOPICS
from rebsync.reverse.bodies.scope import Sends
from rebsync.reverse.generated.cpp_descriptors import priority_of, server_of, tells_priority
from rebsync.reverse.generated.cpp_idle import working
from rebsync.reverse.generated.cpp_parameters import (
    constants_read,
    deciding_parameter,
    own_parameters,
)
from rebsync.reverse.generated.cpp_queues import queue_length
from rebsync.reverse.generated.own_parameters import OwnParameter
from rebsync.reverse.generated.parameters import READS, read_by
from rebsync.reverse.generated.receivers import Receivers, add_receiver
from rebsync.reverse.generated.ros2_words import (
    constant_of_model,
    declared_array,
    known_rebec,
    message_name,
)
from rebsync.reverse.generated.sensors import sensor_of
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall, assigned_in, call_of, calls_in, string_of
from rebsync.reverse.syntax.cpp_declarations import parameters_in
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction, CppParameter
from rebsync.reverse.syntax.cpp_numerals import whole_number
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, last_name, named, part, text_of

_DEEP = 100
# The calls that offer a server, and how many arguments each takes.
OFFERING = {
    **dict.fromkeys(("offer", "offerOnBridge"), (4,)),
    **dict.fromkeys(("offerAction", "offerActionOnBridge"), (4, 5)),
}
# Handles of the rebec's own topics.
_OWN_HANDLES = ("node", "ros::NodeHandle(node)")
Overload: TypeAlias = tuple[str, int]  # a server, and how many arguments it takes


@dataclass(frozen=True, slots=True)
class Advertised:
    """A publisher: to a known rebec, or to all of a class, and the last part of its topic."""

    known: str | None
    key: str
    message: str


@dataclass(frozen=True, slots=True)
class Taken:
    """A call that puts a message into the mailbox: `message` is the parameter that has it.

    `handler` is the function that serves it; None where a lambda does all that itself. `shim` is
    what the subscription calls, a function or a lambda.
    """

    server: str
    handler: str | None
    message: CppParameter
    shim: Node
    topic: str
    function: CppFunction
    call: CppCall

    @property
    def tells_sender(self) -> bool:
        """Whether the message says who has sent it."""
        return "".join(text_of(self.call.arguments[2]).split()).endswith("->sender")

    @property
    def type(self) -> str:
        """The message's type, without its package."""
        return message_name(text_of(self.message.type))


@dataclass(slots=True)
class Roles:
    """Of one class alone: by function what it serves or sends, by member what that stands for.

    `handlers` and `messages` give the server's name in the model, `globals` the entry of the
    parameter server and the default, `odd_globals` are members that get more than that,
    `annotations` those that the set-up of a server shows; of overloads that take equally many
    arguments the first one's first. `receivers` are known rebecs by their names. `topics` are
    those of shims by their names, `offers` as what those of shims are offered, `wired` the calls
    that make them and publishers of the rebec; `own` are parameters of the node that state
    variables get, `reading` the statements that do that, and
    `asked` those that read constants in people's words, with the members that get these; `told` are
    those that people are told of,
    `silent` the variables of them that are only logged; `passing` are callbacks of timers that only
    post a message; `odd_sends` what functions that send do besides; `posted` are the servers that
    no subscription takes messages to, `lost` the calls that send there all the same.
    """

    handlers: dict[str, str] = field(default_factory=dict)
    messages: dict[str, str] = field(default_factory=dict)
    shims: set[str] = field(default_factory=set)
    sends: dict[str, Sends] = field(default_factory=dict)
    odd_sends: dict[str, list[Node]] = field(default_factory=dict)
    publishers: dict[str, Advertised] = field(default_factory=dict)
    known: dict[str, str] = field(default_factory=dict)
    receivers: Receivers = field(default_factory=dict)
    globals: dict[str, tuple[str, Node]] = field(default_factory=dict)
    odd_globals: set[str] = field(default_factory=set)
    constants: set[str] = field(default_factory=set)
    annotations: dict[Overload, list[tuple[m.Annotation, ...]]] = field(default_factory=dict)
    on_bridge: bool = False
    sensors: set[str] = field(default_factory=set)
    topics: dict[str, str] = field(default_factory=dict)
    offers: dict[str, m.Annotation] = field(default_factory=dict)
    taken: list[Taken] = field(default_factory=list)
    wired: set[int] = field(default_factory=set)
    own: dict[str, OwnParameter] = field(default_factory=dict)
    told: list[OwnParameter] = field(default_factory=list)
    asked: dict[int, str] = field(default_factory=dict)
    reading: set[int] = field(default_factory=set)
    silent: set[str] = field(default_factory=set)
    posted: set[str] = field(default_factory=set)
    lost: set[int] = field(default_factory=set)
    passing: set[str] = field(default_factory=set)
    queue_length: int | None = None


def roles_of(code: Code, owner: CppClass) -> Roles:
    """Reads what a class's constructors set up, and what its functions do with it.

    Sends are left out here: `ros1_sends.add_sends` needs the handlers of all classes.
    """
    roles = Roles()
    functions = list(code.functions_of(owner))
    for member in owner.fields:
        sensor = sensor_of(member.name)
        if sensor is not None and text_of(member.type).startswith("Sensor<"):
            roles.sensors.add(sensor)
    for function in functions:
        if function.name == owner.name:
            _wired(roles, function, {f.name: text_of(f.type) for f in owner.fields})
            for name, key, default, statement in constants_read(code, owner, function):
                if name not in roles.globals:
                    roles.globals[name] = key, default
                    roles.asked[statement] = name
    for member in owner.fields:
        if any(marker.startswith("statevar ") for marker in member.markers):
            roles.odd_globals.discard(member.name)
    roles.own, roles.reading = own_parameters(code, owner)
    for constructor in (*owner.functions, *functions):
        if constructor.name == owner.name:
            for asking in named(constructor.body) if constructor.body is not None else ():
                told = deciding_parameter(code, constructor, asking)
                roles.told += [told] if told is not None else []
            roles.queue_length = queue_length(code, constructor) or roles.queue_length
    for function in functions:
        for call in code.calls_of(function) if _says(function, b"receive") else ():
            if call.name == "receive" and len(call.arguments) == 5:
                _received(code, owner, roles, function, call)
    return roles


def _port(topic: str) -> Iterator[m.Annotation]:
    """`@Port` of a server whose topic says so."""
    if topic.startswith("port/"):
        yield m.Annotation("Port")


def _offered(call: CppCall) -> m.Annotation:
    """`@Service(reply)` or `@Action(reply, feedback)` of what a call offers."""
    name = "Action" if call.name.startswith("offerAction") else "Service"
    replies = (string_of(call.arguments[i]) for i in (1, 4) if i < len(call.arguments))
    return m.Annotation(name, tuple(m.Name(reply or "") for reply in replies))


def odd_priorities(code: Code, roles: Roles) -> Iterator[tuple[Cpp, Node]]:
    """The descriptors of servers whose priority is told in a way that the model does not have."""
    for taken in roles.taken:
        descriptor = text_of(taken.call.arguments[0])
        found = code.constant(taken.function.cpp, descriptor)
        if found is None:
            continue
        if not tells_priority(code, taken.function.cpp, descriptor):
            yield found


# --- set up by constructors ---------------------------------------------------------------------


def _wired(roles: Roles, constructor: CppFunction, types: Mapping[str, str]) -> None:
    for member, value in assigned_in(constructor.body):
        read = read_by(value, types.get(member, ""))
        for call in calls_in(value):
            if call.name not in READS or (read is not None and call.node == read.node):
                _member(roles, member, call)
            elif call.on == "global" or any(map(_is_constant, call.arguments[:1])):
                roles.odd_globals.add(member)
    for member, value in assigned_in(constructor.body):
        declared = call_of(value)
        if declared is not None and (array := declared_array(declared)) is not None:
            roles.globals[member] = array
    for call in calls_in(constructor.body) if _says(constructor, b"readArray") else ():
        given = [text_of(a) for a in call.arguments]
        if call.name == "readArray" and len(given) == 3 and given[0] == "global":
            key = string_of(call.arguments[1])
            if key is not None:
                member = text_of(call.arguments[2])
                values = dict(assigned_in(constructor.body))
                roles.globals[member] = key, values.get(member, call.node)


def _is_constant(key: Node) -> bool:
    return constant_of_model(string_of(key) or "") is not None


def _says(function: CppFunction, word: bytes) -> bool:
    """Whether a word stands in a body at all, which is quickly told."""
    return function.body is not None and word in (function.body.text or b"")


def _member(roles: Roles, member: str, call: CppCall) -> None:
    first = string_of(call.arguments[0]) if call.arguments else None
    if first is None:
        return
    match call.name, call.on:
        case "param", "node" if first.startswith("knownrebecs/"):
            _known(roles, member, original(first.partition("/")[2]))
        case "param", "global" if len(call.arguments) == 2:
            roles.globals[member] = first, call.arguments[1]
        case "declare_parameter", "" | "this" if (known := known_rebec(first)) is not None:
            _known(roles, member, original(known))
        case "declare_parameter", "" | "this" if (env := constant_of_model(first)) is not None:
            roles.globals[member] = env, (call.arguments[1:2] or [call.node])[0]
        case "subscribe", on if on in _OWN_HANDLES and len(call.arguments) in (3, 4):
            if _is_deep(call.arguments[1]):
                roles.wired.add(call.node.id)
                roles.topics[last_name(call.arguments[2])] = first
        case "advertise", "mailbox_" if call.types:
            roles.wired.add(call.node.id)
            known, _, key = first.rpartition("/")
            to, message = uncarry(known, OWN_TOPICS), message_name(text_of(call.types[0]))
            roles.publishers[member] = Advertised(to, key, message)
            add_receiver(roles.receivers, to, member, message, key)
        case "subscribe" | "subscribeOnBridge", "mailbox_" if len(call.arguments) == 3:
            roles.wired.add(call.node.id)
            roles.on_bridge = roles.on_bridge or call.name == "subscribeOnBridge"
            roles.topics[last_name(call.arguments[1])] = first
        case name, "mailbox_" if name in OFFERING and len(call.arguments) in OFFERING[name]:
            roles.wired.add(call.node.id)
            roles.on_bridge = roles.on_bridge or name.endswith("OnBridge")
            roles.offers[last_name(call.arguments[2])] = _offered(call)
        case "advertiseAll", "mailbox_" if call.types and len(call.arguments) == 2:
            roles.wired.add(call.node.id)
            key = string_of(call.arguments[1]) or ""
            roles.publishers[member] = Advertised(None, key, message_name(text_of(call.types[0])))


def _known(roles: Roles, member: str, name: str) -> None:
    roles.known[member] = name
    roles.receivers.setdefault(name, (None, member))


# --- what functions do --------------------------------------------------------------------------


def _received(
    code: Code, owner: CppClass, roles: Roles, function: CppFunction, call: CppCall
) -> None:
    server = server_of(code, function.cpp, text_of(call.arguments[0]))
    shim = _around(call.node, function, "lambda_expression")
    parameters = function.parameters if shim is None else parameters_of(shim)
    if server is None or not parameters:
        return
    if shim is None:
        roles.shims.add(function.name)
        topic = roles.topics.get(function.name, "")
    else:
        topic = _topic_around(shim, function)
    called = call_in(call.arguments[4])
    handler = called[0] if called is not None and _is_plain(code, owner, called[0]) else None
    taken = Taken(server, handler, parameters[0], shim or function.node, topic, function, call)
    roles.taken.append(taken)
    if handler is not None:
        roles.handlers[handler] = server
        arguments = len(called[1]) if called is not None else 0
        offer = (o for shim, o in roles.offers.items() if shim == function.name)
        shown = *_port(topic), *offer, *priority_of(code, function.cpp, text_of(call.arguments[0]))
        roles.annotations.setdefault((server, arguments), []).append(shown)
    roles.messages[taken.type] = server
    roles.constants.add(text_of(call.arguments[0]))


def shown_of(code: Code, taken: Taken) -> tuple[m.Annotation, ...]:
    """The annotations that the set-up of a server shows whose handler is a lambda."""
    descriptor = text_of(taken.call.arguments[0])
    return *_port(taken.topic), *priority_of(code, taken.function.cpp, descriptor)


def _is_plain(code: Code, owner: CppClass, name: str) -> bool:
    """Whether it is a function of the class or above that does not just send."""
    found = [f for c in code.lineage(owner.name) for f in c.functions if f.name == name]
    return any(not f.types or f.types[-1] != "When" for f in found)


def _around(node: Node, function: CppFunction, kind: str) -> Node | None:
    """The innermost node of a kind around one, with parameters if it is a lambda."""
    above = ancestors(node, lambda n: n == function.node)
    found = (
        n for n in above if n.type == kind and (kind != "lambda_expression" or parameters_of(n))
    )
    return next(found, None)


def _topic_around(shim: Node, function: CppFunction) -> str:
    """The topic of the subscription whose callback a lambda is."""
    around = _around(shim, function, "call_expression")
    call = call_of(around) if around is not None else None
    if call is None or not call.name.startswith("subscribe") or not call.arguments:
        return ""
    return string_of(call.arguments[0]) or ""


def parameters_of(lambda_: Node) -> tuple[CppParameter, ...]:
    """The parameters of a lambda."""
    declarator = lambda_.child_by_field_name("declarator")
    found = declarator.child_by_field_name("parameters") if declarator is not None else None
    return tuple(parameters_in(found)) if found is not None else ()


def call_in(body: Node) -> tuple[str, list[Node]] | None:
    """The function of the class that a lambda only calls, or that is bound, and the arguments."""
    if body.type == "call_expression":
        bound = call_of(body)
        if bound is None or not bound.name.endswith("bind") or len(bound.arguments) < 2:
            return None
        return last_name(bound.arguments[0]), list(bound.arguments[2:])
    statements = working(part(body, "body")) if body.type == "lambda_expression" else []
    inner = named(statements[0]) if len(statements) == 1 else []
    call = call_of(inner[0]) if len(inner) == 1 else None
    if call is None or not (call.target is None or call.target.type == "this"):
        return None
    return (
        None
        if call.target is None and call.name in held_by(body)
        else (call.name, list(call.arguments))
    )


def held_by(lambda_: Node) -> set[str]:
    """The names that a lambda declares itself: what it captures under them, and its parameters."""
    held = inside(lambda_, "lambda_capture_initializer")
    return {text_of(part(each, "left")) for each in held} | {p.name for p in parameters_of(lambda_)}


def _is_deep(depth: Node) -> bool:
    """Whether so deep a queue loses nothing before the mailbox takes it in."""
    text = text_of(depth)
    return text == "kQueueSize" or (whole_number(text) or 0) >= _DEEP
