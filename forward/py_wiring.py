"""How a class of nodes in Python is set up: its members, publishers and subscriptions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from rebsync.forward.class_names import publisher_place
from rebsync.forward.lineage import base_of
from rebsync.forward.py_class import PyClass, annotation_markers
from rebsync.forward.py_layout import indented
from rebsync.forward.py_messages import own_subscriptions, to_message
from rebsync.forward.py_types import first_value, py_type
from rebsync.model import Type
from rebsync.names import graph_name
from rebsync.package import ConstructorOf, GlobalParameter, Offer, Publisher


class PyWords(Protocol):
    """What one generation of ROS has other words for."""

    def messages(self, package: str) -> str:
        """The module of the package's own messages."""

    def base(self) -> str:
        """The class that all nodes derive from; empty where there is none."""

    def offers(self, package: str, is_action: bool) -> str:
        """The module of the package's own service or action types."""

    def offer(self, offer: Offer) -> str:
        """A service or action type."""

    def argument(self, key: str, type_: Type) -> tuple[str, list[str]] | None:
        """What a constructor calls, with which arguments, to read one of its own.

        None: it is passed.
        """

    def mailbox(self, arguments: str) -> str:
        """Makes the mailbox of a node."""

    def private(self, topic: str) -> str:
        """A topic below the node's own name."""

    def drive(self) -> str:
        """Makes the drive of a robot."""

    def sensor(self, topic: str, type_: str) -> str:
        """Makes a sensor."""

    def known(self, key: str) -> str:
        """The name of a known rebec, as the launch file tells it."""

    def env(self, env: GlobalParameter) -> str:
        """The value of a constant of the model."""

    def state(self, type_: str) -> str:
        """Makes the publisher of the node's state."""


def class_lines(c: PyClass, words: PyWords) -> list[list[str]]:
    """The constructor, and what an heir calls instead of it."""
    if c.node.interface:
        return []
    wires_itself = c.node.executable and not c.node.inherited_from
    found = []
    if c.node.executable:
        own = _wired(c, words, *_capacity(c)) if wires_itself else [f"self._wire({_call(c)})"]
        found.append(_constructor(c, words, [*_node(c, words), *own]))
    if not wires_itself:
        passed = ["self", f"queue_length: int = {c.node.queue_length}"]
        passed.append("best_priority: int = NO_PRIORITY")
        lines = _wired(c, words, "queue_length", "best_priority")
        found.append([f"def _wire({', '.join(passed)}) -> None:", *indented(lines)])
    return found


def _node(c: PyClass, words: PyWords) -> list[str]:
    """Makes the node that an object of the class is; a base would make one of its own name."""
    if not words.base():
        return []
    of_base = base_of(c.package, c.node) is not None
    made = f"{words.base()}.__init__(self, " if of_base else "super().__init__("
    return [f'{made}"{c.node.file}")']


def _constructor(c: PyClass, words: PyWords, wired: list[str]) -> list[str]:
    chosen = constructor_of(c)
    names = [c.names.local(p.name) for p in chosen.parameters]
    typed = [f"{n}: {py_type(p.type)}" for n, p in zip(names, chosen.parameters, strict=True)]
    pairs = zip(chosen.keys, chosen.parameters, strict=True)
    reads = [words.argument(key, p.type) for key, p in pairs]
    passed = [] if all(reads) else typed
    lines = wired
    lines.append(f"self._state_pub = {words.state(c.node.state.name)}")
    lines.append("self._mailbox.on_served(self._publish_state)")
    if chosen.body is not None:
        for target, read in zip(typed, reads, strict=True):
            lines += [f"{target} = {read[0]}({', '.join(read[1])})"] if read is not None else []
        construct = f"self.{c.construct(chosen)}"
        body = f"lambda: {construct}({', '.join(names)})" if names else construct
        lines.append(f"self._mailbox.construct({body})")
    return [f"def __init__({', '.join(['self', *passed])}) -> None:", *indented(lines)]


def constructor_of(c: PyClass) -> ConstructorOf:
    """The constructor that `main` uses."""
    chosen = [i for i in c.node.constructors if i.runs]
    return (chosen or c.node.constructors)[0]


def _capacity(c: PyClass) -> tuple[str, str]:
    own = [c.node, *c.ancestors]
    priorities = [s.priority for n in own for s in n.subscriptions if s.priority is not None]
    return str(c.node.queue_length), str(min(priorities)) if priorities else ""


def _call(c: PyClass) -> str:
    queue, best = _capacity(c)
    return ", ".join([queue, best or "NO_PRIORITY"])


def _wired(c: PyClass, words: PyWords, queue: str, best: str) -> list[str]:
    arguments = f"{queue}, {best}" if best else queue
    if base_of(c.package, c.node) is None:
        lines = [f"self._mailbox = {words.mailbox(arguments)}"]
    else:
        lines = [f"super()._wire({queue}, {best or 'NO_PRIORITY'})"]
    if c.owns_drive:
        lines.append(f"self._drive = {words.drive()}")
    for sensor in c.node.sensors:
        made = words.sensor(f"sensor/{sensor.name}", sensor.type.rpartition("/")[2])
        lines.append(f"self.{c.names.sensors[sensor.server]} = {made}")
    return [
        *lines,
        *_members(c, words),
        *_publishers(c, words, c.node.other_publishers),
        *_subscriptions(c, words),
        *_offers(c, words),
    ]


def _members(c: PyClass, words: PyWords) -> list[str]:
    """State variables, known rebecs and env values, each with its marker beside it."""
    names = c.names
    lines: list[str] = []
    for member in c.node.members:
        lines += (f"# rebsync: {a}" for a in annotation_markers(member.annotations))
        typed = f"self.{names.members[member.name]}: {py_type(member.type)}"
        value = first_value(member.type)
        lines.append(f"{typed} = {value}  # rebsync: statevar {member.path}")
    for known in c.node.known:
        if not known.is_value:
            first, *rest = _publishers(c, words, c.node.publishers_to(known))
            lines += [f"{first}  # rebsync: knownrebec {known.path}", *rest]
            continue
        lines += (f"# rebsync: {a}" for a in annotation_markers(known.annotations))
        value = words.known(f"knownrebecs/{graph_name(known.name)}")
        typed = f"self.{names.members[known.name]}: {py_type(Type(known.type))}"
        lines.append(f"{typed} = {value}  # rebsync: knownrebec {known.path}")
    lines += [
        f"self.{names.env[e.name]}: {py_type(e.type)} = {words.env(e)}  # rebsync: env {e.name}"
        for e in c.node.env
    ]
    return lines


def _publishers(c: PyClass, words: PyWords, publishers: Iterable[Publisher]) -> list[str]:
    lines = []
    for publisher in publishers:
        member = c.names.publishers[publisher_place(publisher)]
        topic, message = words.private(publisher.topic), publisher.message.name
        if publisher.known is not None:
            made = f'advertise("{topic}", {message})'
        else:
            made = f'advertise_all("{publisher.topic}", "{publisher.key}", {message})'
        lines.append(f"self.{member} = self._mailbox.{made}")
    return lines


def _subscriptions(c: PyClass, words: PyWords) -> list[str]:
    lines = []
    for server in own_subscriptions(c):
        member, shim = c.names.subscribers[server.key], c.names.shims[server.key]
        function = "subscribe_on_bridge" if server.on_bridge else "subscribe"
        topic = server.topic if server.on_bridge else words.private(server.topic)
        made = f'{function}("{topic}", {server.message.name}, self.{shim})'
        lines.append(f"self.{member} = self._mailbox.{made}")
    return lines


def _offers(c: PyClass, words: PyWords) -> list[str]:
    lines = []
    for server in own_subscriptions(c):
        if (offer := server.offer) is None:
            continue
        function = f"offer{'_action' * offer.is_action}{'_on_bridge' * server.on_bridge}"
        topic = server.topic if server.on_bridge else words.private(server.topic)
        types = [words.offer(offer), server.message.name, offer.reply.name]
        shim = f"self.{c.names.shims[server.key]}"
        arguments = [f'"{topic}"', f'"{offer.server}"', *types, shim]
        if offer.feedback is not None:
            arguments += [f'"{offer.feedback_server}"', offer.feedback.name]
        made = f"{function}({', '.join(arguments)})"
        lines.append(f"self.{c.names.offers[server.key]} = self._mailbox.{made}")
    return lines


def publish_state(c: PyClass) -> list[str]:
    """What publishes the served message and the state variables, inherited ones included."""
    heads = ("server", "arguments", "arrival", "start", "now")
    lines = [f"msg = {c.node.state.name}()", *(f"msg.{h} = served.{h}" for h in heads)]
    lines += [
        f"msg.{f.name} = {to_message(f, f'self.{c.names.members[f.source]}')}"
        for f in c.node.state.fields
    ]
    lines.append("self._state_pub.publish(msg)")
    return ["def _publish_state(self, served: Served) -> None:", *indented(lines)]
