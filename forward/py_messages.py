"""Messages of one class in Python: what unpacks those that come in and fills those that go out."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.forward.class_names import publisher_place
from rebsync.forward.py_class import PyClass, parameters_of
from rebsync.forward.py_layout import indented
from rebsync.forward.py_names import server_constant
from rebsync.forward.py_types import from_message, py_type
from rebsync.model import Parameter, Type
from rebsync.package import Field, NodeClass, Publisher, SelfSend, Subscription

# --- priorities ---------------------------------------------------------------------------------


def server_constants(c: PyClass) -> list[str]:
    """The descriptors of the servers that this module names: name and priority."""
    keys = [s.key for s in (*own_subscriptions(c), *_repeated(c))]
    keys += [s.key for s in _self_sends(c)]
    return [
        f"{server_constant(c.names, key)} = Server({_described(server)})"
        for key in dict.fromkeys(keys)
        if (server := _server(c, key)) is not None
    ]


def _described(server: Subscription) -> str:
    """Name and priority; the latter also tells which of the two kinds it is."""
    kinds = [a.name for a in server.annotations if a.name in ("priority", "globalPriority")]
    if server.priority is None or not kinds:
        return f'"{server.server}"'
    function = "priority" if kinds[0] == "priority" else "global_priority"
    return f'"{server.server}", {function}({server.priority})'


def _server(c: PyClass, key: str) -> Subscription | None:
    """The version of a server that this class runs."""
    servers = (s for n in (c.node, *c.ancestors) for s in n.subscriptions)
    return next((s for s in servers if s.key == key), None)


def _repeated(c: PyClass) -> list[Subscription]:
    """The servers of ancestors that have another priority here."""
    return [s for s in c.node.subscriptions if s.inherited and _has_other_priority(c.ancestors, s)]


def _has_other_priority(above: list[NodeClass], server: Subscription) -> bool:
    own = (s for n in above for s in n.subscriptions)
    return any(s.key == server.key and s.priority != server.priority for s in own)


# --- in -----------------------------------------------------------------------------------------


def own_subscriptions(c: PyClass) -> tuple[Subscription, ...]:
    """The servers whose subscription this class makes; its ancestors made the others."""
    return tuple(s for s in c.node.subscriptions if not s.inherited)


def shims(c: PyClass) -> list[list[str]]:
    """What unpacks a message and puts it into the mailbox."""
    return [_shim(c, s) for s in (*own_subscriptions(c), *_repeated(c))]


def _shim(c: PyClass, server: Subscription) -> list[str]:
    message = server.message
    pairs = zip(message.fields, server.parameters, strict=True)
    values = [from_message(f"msg.{f.name}", p.type) for f, p in pairs]
    handler = f"self.{c.names.function(server.server, server.parameters)}"
    arguments = [
        server_constant(c.names, server.key),
        "msg.timing",
        "msg.sender" if message.carries_sender else '""',
        f"text({', '.join(values)})" if values else '""',
        f"lambda: {handler}({', '.join(values)})" if values else handler,
    ]
    head = f"def {c.names.shims[server.key]}(self, msg: {message.name}) -> None:"
    return [head, *indented([f"self._mailbox.receive({', '.join(arguments)})"])]


# --- out ----------------------------------------------------------------------------------------


def sends(c: PyClass) -> list[list[str]]:
    """The helpers that fill a message and send it."""
    helpers = [_send(c, q) for q in c.node.publishers]
    return [*helpers, *(_self_send(c, s) for s in _self_sends(c))]


def _self_sends(c: PyClass) -> Iterator[SelfSend]:
    """Those that no ancestor has, and those that have another priority here."""
    above = {s.key: s for a in c.ancestors for s in a.self_sends}
    repeated = {s.key for s in _repeated(c)}
    yield from (s for s in c.node.self_sends if s.key not in above or s.key in repeated)
    own = {s.key for s in c.node.self_sends}
    yield from (s for key, s in above.items() if key in repeated - own)


def _send(c: PyClass, publisher: Publisher) -> list[str]:
    place = publisher_place(publisher)
    member, message = f"self.{c.names.publishers[place]}", publisher.message
    to = []
    if publisher.known is None:
        to = [f"to_: {py_type(Type(publisher.target))}"]
        member = f"to({member}, to_)"
    lines = [f"msg = {message.name}()"]
    lines += [
        f"msg.{f.name} = {to_message(f, c.names.local(p.name))}"
        for f, p in zip(message.fields, publisher.parameters, strict=True)
    ]
    if message.carries_sender:
        lines.append("msg.sender = self._mailbox.self()")
    lines.append(f"self._mailbox.publish({member}, msg, when)")
    marker = f"send {c.node.name}.{publisher.known or publisher.target}.{publisher.server}"
    return _helper(c, c.names.sends[place], to, publisher.parameters, lines, marker)


def _self_send(c: PyClass, send: SelfSend) -> list[str]:
    names = [c.names.local(p.name) for p in send.parameters]
    handler = f"self.{c.names.function(send.server, send.parameters)}"
    passed = ", ".join(names)
    arguments = [
        server_constant(c.names, send.key),
        "when",
        f"text({passed})" if names else '""',
        f"lambda: {handler}({passed})" if names else handler,
    ]
    lines = [f"self._mailbox.post({', '.join(arguments)})"]
    marker = f"send {c.node.name}.self.{send.server}"
    return _helper(c, c.names.self_sends[send.key], [], send.parameters, lines, marker)


def _helper(
    c: PyClass,
    name: str,
    to: list[str],
    parameters: tuple[Parameter, ...],
    lines: list[str],
    marker: str,
) -> list[str]:
    passed = ["self", *to, *parameters_of(c.names, parameters), "when: When = AT_ONCE"]
    head = f"def {name}({', '.join(passed)}) -> None:"
    return [f"# rebsync: {marker}", head, *indented(lines)]


def to_message(field: Field, value: str) -> str:
    """A value as the field of a message has it."""
    return f"flatten({value})" if field.type.dimensions else value
