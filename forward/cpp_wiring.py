"""The members of one class in C++, and how its constructor sets them up."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rebsync.forward.class_names import publisher_place
from rebsync.forward.cpp_class import CppClass
from rebsync.forward.cpp_layout import indented, statement_lines, with_trailing_comments
from rebsync.forward.cpp_messages import own_subscriptions, stored_in
from rebsync.forward.cpp_types import cpp_type, cpp_value
from rebsync.model import Annotation, Type
from rebsync.package import Draw, Publisher, Sensor
from rebsync.printing import print_line


def members(c: CppClass) -> list[str]:
    """State variables, known rebecs and env values, each with its marker beside it."""
    lines: list[tuple[str, str]] = []
    for member in c.node.members:
        lines += _annotations(member.annotations)
        declared = f"{cpp_type(member.type)} {c.names.members[member.name]}{{}};"
        lines.append((declared, f"rebsync: statevar {member.path}"))
    for known in c.node.values_known:
        lines += _annotations(known.annotations)
        declared = f"{cpp_type(Type(known.type))} {c.names.members[known.name]};"
        lines.append((declared, f"rebsync: knownrebec {known.path}"))
    lines += [
        (f"{cpp_type(e.type)} {c.names.env[e.name]}{{}};", f"rebsync: env {e.name}")
        for e in c.node.env
    ]
    return indented(with_trailing_comments(lines))


def _annotations(annotations: tuple[Annotation, ...]) -> Iterator[tuple[str, str]]:
    """The markers of annotations, each on a line of its own."""
    return ((f"// rebsync: annotation {print_line(a).strip()}", "") for a in annotations)


def ros_members(c: CppClass) -> list[str]:
    """Publishers, subscribers and sensors."""
    lines = [
        f"  Sensor<{c.words.message(s.type)}> {c.names.sensors[s.server]};" for s in c.node.sensors
    ]
    for publisher in c.node.publishers:
        lines += [f"  // rebsync: knownrebec {k.path}" for k in c.node.told_by(publisher)]
        kind = c.words.publisher if publisher.known is not None else c.words.publishers
        lines.append(
            f"  {kind(publisher.message.name)} {c.names.publishers[publisher_place(publisher)]};"
        )
    lines += [
        f"  {c.words.subscriber(s.message.name)} {c.names.subscribers[s.key]};"
        for s in own_subscriptions(c)
    ]
    lines += [
        f"  {c.words.offered(s.offer)} {c.names.offers[s.key]};"
        for s in own_subscriptions(c)
        if s.offer is not None
    ]
    return lines


def wiring(c: CppClass) -> list[str]:
    """The part of the constructor's body that makes the other publishers and subscriptions."""
    return [*advertised(c, c.node.other_publishers), *_subscribed(c), *_offered(c)]


def advertised(c: CppClass, publishers: Iterable[Publisher]) -> list[str]:
    """Makes publishers."""
    lines = []
    for publisher in publishers:
        member = c.names.publishers[publisher_place(publisher)]
        message = c.words.message(publisher.message.name)
        if publisher.known is not None:
            arguments = [f'"{publisher.topic}"']
            function = "advertise"
        else:
            arguments = [f'"{publisher.topic}"', f'"{publisher.key}"']
            function = "advertiseAll"
        lines += _set_up(c, f"{member} = mailbox_.{function}<{message}>", arguments)
    return lines


def _subscribed(c: CppClass) -> list[str]:
    """Makes the subscriptions."""
    lines = []
    for server in own_subscriptions(c):
        member, shim = c.names.subscribers[server.key], c.names.shims[server.key]
        arguments = [f'"{server.topic}"', f"&{c.type_name}::{shim}", "this"]
        function = "subscribeOnBridge" if server.on_bridge else "subscribe"
        lines += _set_up(c, f"{member} = mailbox_.{function}", arguments)
    return lines


def _offered(c: CppClass) -> list[str]:
    """Offers servers as services and actions."""
    lines = []
    for server in own_subscriptions(c):
        if (offer := server.offer) is None:
            continue
        types = [c.words.offer(offer), c.words.message(offer.reply.name)]
        shim = f"&{c.type_name}::{c.names.shims[server.key]}"
        arguments = [f'"{server.topic}"', f'"{offer.server}"', shim, "this"]
        if offer.feedback is not None:
            types.append(c.words.message(offer.feedback.name))
            arguments.append(f'"{offer.feedback_server}"')
        kind, bridge = "Action" * offer.is_action, "OnBridge" * server.on_bridge
        function = f"offer{kind}{bridge}<{', '.join(types)}>"
        lines += _set_up(c, f"{c.names.offers[server.key]} = mailbox_.{function}", arguments)
    return lines


def _set_up(c: CppClass, head: str, arguments: list[str]) -> list[str]:
    if c.words.BREAKS_LINES:
        return statement_lines(head, arguments, ";")
    return [f"{head}({', '.join(arguments)});"]


def state_lines(c: CppClass) -> list[str]:
    """Fills the state message from the state variables, inherited ones included."""
    return [stored_in("msg.", f, c.names.members[f.source]) for f in c.node.state.fields]


def seen_functions(c: CppClass) -> list[tuple[str, str, str, str]]:
    """The user functions of the sensors: result, name, parameter, expression."""
    found = []
    for sensor in c.node.sensors:
        for index, (draw, name) in enumerate(
            zip(sensor.draws, c.names.seen[sensor.server], strict=True)
        ):
            read = _read(c, sensor, draw, index)
            type_ = c.words.message(sensor.type)
            used = sensor.stands_in or "msg" in read
            parameter = f"const {type_}& {'msg' if used else '/* msg */'}"
            found.append((cpp_type(draw.type), name, parameter, read))
    return found


def _read(c: CppClass, sensor: Sensor, draw: Draw, index: int) -> str:
    if sensor.stands_in:
        field = f"msg.{draw.field}"
        return c.words.truth(field) if draw.type.name == "boolean" else field
    if sensor.seen and index == 0:
        return sensor.seen
    return cpp_value(draw.alternatives[0]) if draw.alternatives else "{}"
