"""What the members and functions of a class of generated Python are for.

By what they do: a handler is what a subscription puts into the mailbox, a function that publishes
or posts is a send. Markers only tell names that the code had to change.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection
from dataclasses import field as with_default

from tree_sitter import Node

from rebsync import model as m
from rebsync.names import carry, original, uncarry
from rebsync.records import dataclass
from rebsync.reserved import OWN_TOPICS, PYTHON_MEMBERS
from rebsync.reverse.bodies.overloads import Signature
from rebsync.reverse.build.field_order import are_named
from rebsync.reverse.generated.own_parameters import OwnParameter, only_once
from rebsync.reverse.generated.receivers import Receivers, add_receiver
from rebsync.reverse.generated.sensors import sensor_of
from rebsync.reverse.python.generated.descriptors import servers_of
from rebsync.reverse.python.generated.pair_methods import (
    is_alone,
    is_beside,
    is_inlined,
)
from rebsync.reverse.python.generated.parameters import (
    ParameterRead,
    declared_by,
    parameter_read,
)
from rebsync.reverse.python.generated.py_types import (
    call_parts,
    expression_in,
    field_read,
    handed_over,
    is_unset,
    literal_type,
    markers_above,
    markers_at,
    passed_on,
    string_value,
    type_made,
    type_of,
    without_parentheses,
)
from rebsync.reverse.python.generated.queues import PASSED, queue_in
from rebsync.reverse.python.generated.slicing.candidates import is_of_node
from rebsync.reverse.python.generated.slicing.exceptions import raising_again
from rebsync.reverse.python.generated.slicing.log_words import TEXTS
from rebsync.reverse.python.generated.slicing.logs import only_describes, own_method
from rebsync.reverse.python.generated.slicing.services import asked_back
from rebsync.reverse.python.generated.slicing.timers import (
    called_back,
    chosen_methods,
    only_logs_by_words,
)
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import FUNCTION, PyCode, PyParameter, Scope
from rebsync.reverse.syntax.py_tree import field, text_of

_RUNTIME = {"_mailbox", "_drive", "_state_pub"}
# What offers a server, and how many arguments that takes.
OFFERING: dict[str, tuple[int, ...]] = dict.fromkeys(("offer", "offer_on_bridge"), (6,))
OFFERING |= dict.fromkeys(("offer_action", "offer_action_on_bridge"), (6, 8))
_PLUMBING = {"__init__", "_wire", "_publish_state", "mailbox", *TEXTS}


@dataclass(frozen=True, slots=True)
class PySends:
    """A function that sends: `known` as in the model, "self", or None for any rebec of a class.

    `parameters` are all that it is given, the time among them. `types` are those of
    the arguments, `rivals` the types that other servers of the name take.
    """

    known: str | None
    server: str
    arguments: int
    parameters: tuple[PyParameter, ...] = ()
    types: Signature = ()
    rivals: frozenset[Signature] = frozenset()


@dataclass(frozen=True, slots=True)
class EnvUse:
    """A constant of the model that a class reads: its key, what stands in for it, and where."""

    key: str
    name: str
    type: m.Type
    default: Node | None
    statement: Node


@dataclass(eq=False, slots=True)
class PyRoles:
    """Of one class alone: what its attributes and functions stand for, by their names in Python."""

    owner: Scope
    functions: dict[str, Scope] = with_default(default_factory=dict)
    state: dict[str, tuple[str, m.Type, Node]] = with_default(default_factory=dict)
    initial: list[tuple[str, Node, Scope]] = with_default(default_factory=list)
    known: dict[str, tuple[str, m.Type, Node]] = with_default(default_factory=dict)
    receivers: Receivers = with_default(default_factory=dict)
    connected: dict[str, Node] = with_default(default_factory=dict)  # what sets members up
    env: dict[str, EnvUse] = with_default(default_factory=dict)
    publishers: dict[str, tuple[str | None, str, str]] = with_default(default_factory=dict)
    handlers: dict[str, str] = with_default(default_factory=dict)
    shown: dict[str, tuple[m.Annotation, ...]] = with_default(default_factory=dict)
    messages: dict[str, str] = with_default(default_factory=dict)
    signed: set[str] = with_default(default_factory=set)  # messages whose sender a shim tells
    sends: dict[str, PySends] = with_default(default_factory=dict)
    handler_names: dict[str, str] = with_default(default_factory=dict)
    by_shim: dict[str, str] = with_default(default_factory=dict)
    orders: list[tuple[str, tuple[str, ...]]] = with_default(default_factory=list)  # by shims
    shims: set[str] = with_default(default_factory=set)
    ticking: set[str] = with_default(default_factory=set)
    beside: dict[str, Scope] = with_default(default_factory=dict)  # gives what no variable holds
    inlined: dict[str, Scope] = with_default(default_factory=dict)  # what takes times of sends
    arguments: dict[str, str] = with_default(default_factory=dict)
    own: dict[str, tuple[OwnParameter, Node]] = with_default(default_factory=dict)
    told: list[OwnParameter] = with_default(default_factory=list)  # that people are told of
    declared: dict[str, ParameterRead] = with_default(default_factory=dict)
    stored: Counter[str] = with_default(default_factory=Counter)
    topics: dict[str, str] = with_default(default_factory=dict)
    offers: dict[str, m.Annotation] = with_default(default_factory=dict)
    sensors: set[str] = with_default(default_factory=set)
    posted: set[str] = with_default(default_factory=set)  # servers that no subscription is for
    constructed: bool = False  # while the set-up is read: the model's constructor has run
    has_mailbox: bool = False
    has_drive: bool = False
    on_bridge: bool = False
    queues: list[Node] = with_default(default_factory=list)
    queue: Node | None = None  # the length that heirs may hand on another one for

    def leave_out(self, members: Collection[str]) -> None:
        """Takes some variables out of the model, with parameters of the node's own or not."""
        self.told += [self.own.pop(name)[0] for name in self.own.keys() & members]
        self.initial = [each for each in self.initial if each[0] not in members]
        for name in self.state.keys() & members:
            del self.state[name]

    def served_by(self, shim: str) -> str | None:
        """The server whose messages a shim takes in."""
        return self.by_shim.get(shim)

    def handler_of(self, shim: str) -> Scope | None:
        """The function of this class that serves the messages of a shim."""
        return self.functions.get(self.handler_names.get(shim, ""))

    def is_plumbing(self, name: str) -> bool:
        """Whether a function is none of the model's."""
        added = self.ticking, self.beside, self.inlined
        return any(name in of for of in (_PLUMBING, self.shims, self.sends, *added))

    @property
    def is_executable(self) -> bool:
        return "_publish_state" in self.functions


def roles_of(code: PyCode, owner: Scope) -> PyRoles:
    """Reads what the constructor of a class sets up, and what its functions do with it."""
    roles = PyRoles(owner)
    for bindings in owner.names.values():
        for binding in bindings:
            if binding.how == "scope":
                scope = code.scope_of(binding.node, owner.py)
                if scope.kind == FUNCTION and not only_describes(scope, owner.names):
                    roles.functions[scope.name] = scope
    for name in ("__init__", "_wire"):
        if name in roles.functions:
            _wired(roles, roles.functions[name])
    own = only_once((name, own) for name, (own, _) in roles.own.items())
    roles.own = {n: t for n, t in roles.own.items() if n in own and roles.stored[n] == 1}
    servers = servers_of(owner.module)
    for function in roles.functions.values():
        if function.name not in _PLUMBING:
            _does(roles, function, servers)
    chosen = frozenset[str]().union(*map(chosen_methods, roles.functions.values()))
    handed = [n for n, f in roles.functions.items() if only_logs_by_words(f) and n not in chosen]
    for set_up in (roles.functions[n] for n in ("__init__", "_wire") if n in roles.functions):
        handed += [*called_back(set_up), *asked_back(set_up)]
    if "_publish_state" in roles.functions:
        handed += filter(None, map(own_method, nodes_in(roles.functions["_publish_state"].node)))
    roles.ticking.update(n for n in handed if is_people_own(roles, n))
    added = (f for n, f in roles.functions.items() if is_people_own(roles, n))
    alone = [f for f in added if is_alone(code, f)]
    roles.beside = {f.name: f for f in alone if is_beside(f)}
    calling = [f for n, f in roles.functions.items() if not roles.is_plumbing(n)]
    roles.inlined = {f.name: f for f in alone if is_inlined(code, f, calling)}
    return roles


def is_people_own(roles: PyRoles, name: str) -> bool:
    """Whether a function is one that people added beside what sends and serves."""
    function = roles.functions.get(name)
    is_made = roles.is_plumbing(name) or name in roles.handlers or is_of_node(name)
    is_made = is_made or name.startswith("construct")
    return function is not None and not (is_made or markers_above(function.py, function.node))


# --- set up -------------------------------------------------------------------------------------


def _wired(roles: PyRoles, function: Scope) -> None:
    roles.constructed = False  # also of `_wire`, which `__init__` calls before
    for statement in body_of(function):
        inner = expression_in(statement)
        if inner is not None and inner.type == "call":
            _called(roles, inner)
            if (told := declared_by(inner)) is not None:
                roles.declared[told[0]] = told[1]
        elif inner is not None and inner.type == "assignment":
            left = text_of(field(inner, "left"))
            value = inner.child_by_field_name("right")
            if value is None:
                continue
            value = without_parentheses(value)
            if left.startswith("self."):
                _member(roles, function, left.removeprefix("self."), inner, value)
            elif left.isidentifier():
                read = parameter_read(value, roles.declared)
                if read is not None and read.is_own:
                    roles.arguments[left] = read.key
    for parameter in function.parameters:
        if parameter.name == PASSED and parameter.default is not None:
            roles.queue = parameter.default


def _called(roles: PyRoles, call: Node) -> None:
    """`self._wire(4, NO_PRIORITY)` says how long the queue is."""
    function, arguments = call_parts(call) or ("", [])
    roles.constructed |= function == "self._mailbox.construct"
    if function.endswith("._wire") and (given := queue_in(arguments)) is not None:
        roles.queues.append(given)


def _member(roles: PyRoles, function: Scope, name: str, statement: Node, value: Node) -> None:
    called, arguments = call_parts(value) or ("", [])
    said = statement.child_by_field_name("type")
    type_ = type_of(said) if said is not None else type_made(value) or literal_type(value)
    if type_ is None and said is None and (read := parameter_read(value, roles.declared)):
        type_ = read.type
    if called == "Mailbox":
        roles.has_mailbox = True
        if (given := queue_in(arguments)) is not None:
            roles.queues.append(given)
    elif called == "Drive":
        roles.has_drive = True
    elif called == "Sensor":
        roles.sensors.add(sensor_of(name) or original(name.removeprefix("_")))
    elif called.startswith("self._mailbox."):
        roles.connected[name] = statement
        _connected(roles, name, called.removeprefix("self._mailbox."), arguments)
    elif type_ is not None and name not in _RUNTIME:
        _variable(roles, function, name, statement, value, type_)


def _connected(roles: PyRoles, member: str, method: str, arguments: list[Node]) -> None:
    first = _topic(roles, arguments[0]) if arguments else None
    topic = (first or "").removeprefix("~/").removeprefix("~")
    if method == "advertise" and len(arguments) == 2:
        known, _, key = topic.rpartition("/")
        message = text_of(arguments[1])
        to = uncarry(known, OWN_TOPICS)
        roles.publishers[member] = to, key, message
        add_receiver(roles.receivers, to, member, message, key)
    elif method == "advertise_all" and len(arguments) == 3:
        key = string_value(arguments[1]) or ""
        roles.publishers[member] = None, key, text_of(arguments[2])
    elif method in ("subscribe", "subscribe_on_bridge") and len(arguments) == 3:
        roles.on_bridge = roles.on_bridge or method == "subscribe_on_bridge"
        roles.topics[handed_over(arguments[2]).removeprefix("self.")] = topic
    elif len(arguments) in OFFERING.get(method, ()):
        roles.on_bridge = roles.on_bridge or method.endswith("_on_bridge")
        shim = handed_over(arguments[5]).removeprefix("self.")
        name = "Action" if method.startswith("offer_action") else "Service"
        replies = (string_value(arguments[i]) for i in (1, 6) if i < len(arguments))
        roles.offers[shim] = m.Annotation(name, tuple(m.Name(reply or "") for reply in replies))


def _topic(roles: PyRoles, node: Node) -> str | None:
    """A text, or one that the module gives a name to."""
    bound = roles.owner.module.names.get(text_of(node), [])
    if len(bound) != 1 or bound[0].how != "value" or bound[0].path:
        return string_value(node)
    is_local = any(text_of(node) in f.names for f in roles.functions.values())
    return None if is_local else string_value(bound[0].value)


def _variable(
    roles: PyRoles, function: Scope, attribute: str, statement: Node, value: Node, type_: m.Type
) -> None:
    markers = markers_at(function.py, statement)
    name = variable_name(attribute, markers)
    read = parameter_read(value, roles.declared)
    roles.stored[attribute] += not is_unset(value)
    if is_unset(value) or literal_type(value) is not None:
        roles.state[attribute] = name, type_, statement
        if not (is_unset(value) or roles.constructed):
            roles.initial.append((attribute, value, function))
    elif read is not None and read.is_own and read.key.startswith("knownrebecs/"):
        known = original(read.key.partition("/")[2])
        roles.known[attribute] = known, type_, statement
        roles.receivers.setdefault(known, (None, attribute))
    elif read is not None and not read.is_own:
        roles.env[attribute] = EnvUse(read.key, name, type_, read.default, statement)
    elif read is not None and (own := read.own()) is not None and own.fits(type_):
        roles.own[attribute] = own, statement
        roles.state.setdefault(attribute, (name, type_, statement))


def variable_name(attribute: str, markers: Collection[str]) -> str:
    """The model's name of an attribute, from its marker unless it was renamed."""
    for marker in markers:
        kind, path, *_ = [*marker.split(), "", ""]
        name = path.rpartition(".")[2]
        carried = re.escape(carry(name, PYTHON_MEMBERS)) if name else ""
        if kind in ("statevar", "env", "knownrebec") and re.fullmatch(
            rf"_{carried}(_\d+)?", attribute
        ):
            return name
    return uncarry(attribute.removeprefix("_"), PYTHON_MEMBERS)


# --- what functions do --------------------------------------------------------------------------


def _does(
    roles: PyRoles, function: Scope, servers: dict[str, tuple[str, tuple[m.Annotation, ...]]]
) -> None:
    passed = tuple(function.parameters[1:])
    is_timed = "when" in {p.name for p in passed}
    body = (raising_again(s) or ([s], []) for s in body_of(function))
    for statement in (s for inner, _ in body for s in inner):
        called, arguments = call_parts(expression_in(statement)) or ("", [])
        if called == "self._mailbox.receive" and len(arguments) == 5 and function.parameters:
            _received(roles, function, arguments, servers)
        elif called == "self._mailbox.post" and arguments and is_timed:
            server, _ = servers.get(text_of(arguments[0]), ("", ()))
            roles.sends[function.name] = PySends("self", server, len(passed) - 1, passed)
        elif called == "self._mailbox.publish" and len(arguments) == 3 and is_timed:
            _published(roles, function, arguments[0], passed)


def _received(
    roles: PyRoles,
    function: Scope,
    arguments: list[Node],
    servers: dict[str, tuple[str, tuple[m.Annotation, ...]]],
) -> None:
    server, annotations = servers.get(text_of(arguments[0]), ("", ()))
    handler, values = passed_on(arguments[4]) or ("", [])
    handler = handler.removeprefix("self.")
    if not server or not handler.isidentifier():
        return
    roles.shims.add(function.name)
    roles.by_shim[function.name] = server
    roles.handler_names[function.name] = handler
    roles.handlers[handler] = server
    offer = roles.offers.get(function.name)
    roles.shown[handler] = (
        *((m.Annotation("Port"),) if roles.topics.get(function.name, "")[:5] == "port/" else ()),
        *((offer,) if offer is not None else ()),
        *annotations,
    )
    parameter = field(function.node, "parameters").named_children[-1]
    message = parameter.child_by_field_name("type")
    if message is not None:
        roles.messages[text_of(message)] = server
        given, serves = function.parameters[-1].name, roles.functions.get(handler)
        if text_of(arguments[2]) == f"{given}.sender":
            roles.signed.add(text_of(message))
        fields = tuple(field_read(v, given) for v in values)
        if serves is not None and are_named(fields, [p.name for p in serves.parameters[1:]]):
            roles.orders.append((text_of(message), fields))


def _published(roles: PyRoles, function: Scope, by: Node, passed: tuple[PyParameter, ...]) -> None:
    parts = call_parts(by)
    member = parts[1][0] if parts is not None and parts[0] == "to" else by
    found = roles.publishers.get(text_of(member).removeprefix("self."))
    if found is not None:
        known, key, message = found
        count = len(passed) - 1 - (known is None)
        roles.sends[function.name] = PySends(known, f"{message} {key}", count, passed)
