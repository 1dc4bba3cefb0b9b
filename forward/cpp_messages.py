"""Messages of one class in C++: what unpacks those that come in and fills those that go out."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.forward.class_names import publisher_place
from rebsync.forward.cpp_class import CppClass, Piece, braced
from rebsync.forward.cpp_layout import call_lines
from rebsync.forward.cpp_types import cpp_type, parameter_type
from rebsync.forward.lineage import descendants
from rebsync.model import Parameter
from rebsync.package import Field, NodeClass, Publisher, SelfSend, Subscription

# --- priorities ---------------------------------------------------------------------------------


def server_constants(c: CppClass) -> list[str]:
    """The descriptors of the servers that this file names: name and priority."""
    keys = [s.key for s in (*own_subscriptions(c), *_repeated(c))]
    keys += [s.key for s in _self_sends(c)]
    return [
        f'constexpr Server {c.names.servers[key]}{{"{server.server}", {_priority(server)}}};'
        for key in dict.fromkeys(keys)
        if (server := _server(c, key)) is not None
    ]


def _priority(server: Subscription) -> str:
    """The priority as an expression that also tells which of the two kinds it is."""
    kinds = [a.name for a in server.annotations if a.name in ("priority", "globalPriority")]
    if server.priority is None or not kinds:
        return "kNoPriority"
    return f"{kinds[0]}({server.priority})"


def _server(c: CppClass, key: str) -> Subscription | None:
    """The version of a server that this class runs."""
    servers = (s for n in (c.node, *c.ancestors) for s in n.subscriptions)
    return next((s for s in servers if s.key == key), None)


def _repeated(c: CppClass) -> list[Subscription]:
    """The servers of ancestors that have another priority here."""
    return [s for s in c.node.subscriptions if s.inherited and _changes_priority(c, c.node, s)]


def _changes_priority(c: CppClass, node: NodeClass, server: Subscription) -> bool:
    above = (s for n in c.package.classes if n.name in _line(c, node) for s in n.subscriptions)
    return any(s.key == server.key and s.priority != server.priority for s in above)


def _line(c: CppClass, node: NodeClass) -> set[str]:
    found = set()
    for base in map(c.package.node_class, node.bases):
        if not base.interface:
            found |= {base.name} | _line(c, base)
    return found


def _is_repeated_below(c: CppClass, key: str) -> bool:
    return any(
        s.key == key and s.inherited and _changes_priority(c, n, s)
        for n in descendants(c.package, c.node)
        for s in n.subscriptions
    )


def _qualified(c: CppClass, key: str, line: str) -> str:
    """A declaration that descendants with another priority replace, or that replaces one."""
    if any(s.key == key for s in _repeated(c)):
        return f"{line} override;"
    return f"virtual {line};" if _is_repeated_below(c, key) else f"{line};"


# --- in -----------------------------------------------------------------------------------------


def own_subscriptions(c: CppClass) -> tuple[Subscription, ...]:
    """The servers whose subscription this class makes; its ancestors made the others."""
    return tuple(s for s in c.node.subscriptions if not s.inherited)


def shims(c: CppClass) -> tuple[Piece, ...]:
    """What unpacks a message and puts it into the mailbox."""
    return tuple(_shim(c, s) for s in (*own_subscriptions(c), *_repeated(c)))


def _shim(c: CppClass, server: Subscription) -> Piece:
    message = server.message
    values = [_unpacked(c, f, p) for f, p in zip(message.fields, server.parameters, strict=True)]
    name = c.names.shims[server.key]
    head = f"const {c.words.received(message.name)}& msg"
    sender = "msg->sender" if message.carries_sender else '""'
    text = f"text({', '.join(values)})" if values else '""'
    capture = "this, msg" if values else "this"
    call = _called(c, server.server, server.parameters, ["msg"] if values else [])
    body = f"[{capture}] {{ {call}({', '.join(values)}); }}"
    arguments = [c.names.servers[server.key], "msg->timing", sender, text, body]
    head_line = f"void {c.type_name}::{name}({head})"
    return Piece(
        "",
        (f"  {_qualified(c, server.key, f'void {name}({head})')}",),
        tuple(braced([head_line], call_lines("mailbox_.receive", arguments, ";"))),
    )


def _called(c: CppClass, name: str, parameters: tuple[Parameter, ...], hiding: list[str]) -> str:
    """The handler in a place where variables may hide its name."""
    function = c.names.function(name, parameters)
    return f"this->{function}" if function in hiding else function


def _unpacked(c: CppClass, field: Field, parameter: Parameter) -> str:
    """The field of a received message as a value of the parameter's type."""
    type_ = parameter.type
    if type_.dimensions:
        return f"unflatten<{cpp_type(type_)}>(msg->{field.name})"
    text = f"msg->{field.name}"
    return c.words.truth(text) if type_.name == "boolean" else text


# --- out ----------------------------------------------------------------------------------------


def sends(c: CppClass) -> tuple[Piece, ...]:
    """The helpers that fill a message and send it."""
    return (
        *(_send(c, q) for q in c.node.publishers),
        *(_self_send(c, s) for s in _self_sends(c)),
    )


def _self_sends(c: CppClass) -> Iterator[SelfSend]:
    """Those that no ancestor has, and those that have another priority here."""
    above = {s.key: s for a in c.ancestors for s in a.self_sends}
    repeated = {s.key for s in _repeated(c)}
    yield from (s for s in c.node.self_sends if s.key not in above or s.key in repeated)
    own = {s.key for s in c.node.self_sends}
    yield from (s for key, s in above.items() if key in repeated - own)


def _send(c: CppClass, publisher: Publisher) -> Piece:
    place = publisher_place(publisher)
    member, message = c.names.publishers[place], publisher.message
    parameters = publisher.parameters
    msg, when, rebec = (c.names.beside(n, parameters) for n in ("msg", "when", "recipient"))
    passed = _passed(c, parameters, when)
    where = member
    if publisher.known is None:
        passed.insert(0, f"const std::string& {rebec}")
        where = f"to({member}, {rebec})"
    lines = [f"{c.words.message(message.name)} {msg};"]
    lines += [
        stored_in(f"{msg}.", f, c.names.local(p.name))
        for f, p in zip(message.fields, parameters, strict=True)
    ]
    if message.carries_sender:
        lines.append(f"{msg}.sender = mailbox_.self();")
    lines.append(f"mailbox_.publish({where}, {msg}, {when});")
    marker = f"send {c.node.name}.{publisher.known or publisher.target}.{publisher.server}"
    return _helper(c, c.names.sends[place], passed, lines, marker)


def _self_send(c: CppClass, send: SelfSend) -> Piece:
    names = [c.names.local(p.name) for p in send.parameters]
    text = f"text({', '.join(names)})" if names else '""'
    call = _called(c, send.server, send.parameters, names)
    body = f"[=] {{ {call}({', '.join(names)}); }}"
    when = c.names.beside("when", send.parameters)
    arguments = [c.names.servers[send.key], when, text, body]
    lines = call_lines("mailbox_.post", arguments, ";")
    marker = f"send {c.node.name}.self.{send.server}"
    helper = c.names.self_sends[send.key]
    return _helper(c, helper, _passed(c, send.parameters, when), lines, marker, send.key)


def _passed(c: CppClass, parameters: tuple[Parameter, ...], when: str) -> list[str]:
    """What a helper takes: the arguments of the message, and when it arrives and expires."""
    own = [f"{parameter_type(p.type)} {c.names.local(p.name)}" for p in parameters]
    return [*own, f"const When& {when}"]


def _helper(
    c: CppClass, name: str, passed: list[str], lines: list[str], marker: str, key: str = ""
) -> Piece:
    declared = [*passed[:-1], f"{passed[-1]} = When()"]
    before, _, after = _qualified(c, key, "|").partition("|")
    definition = [f"// rebsync: {marker}"]
    definition += braced(call_lines(f"void {c.type_name}::{name}", passed, ""), lines)
    declaration = call_lines(f"{before}void {name}", declared, after, "  ")
    return Piece(marker, tuple(declaration), tuple(definition))


def stored_in(message: str, field: Field, value: str) -> str:
    """The statement that stores a value in the field of a message."""
    if field.type.dimensions:
        return f"flatten({value}, {message}{field.name});"
    return f"{message}{field.name} = {value};"
