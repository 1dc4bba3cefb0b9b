"""Known rebecs of generated classes, those among them that no member holds.

Where a class only sends to a known rebec, its publishers tell all of it: the topic `robot/go` the
name, and the message type `RobotGo` the class.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from rebsync import model as m
from rebsync.names import message_class
from rebsync.source import Span

# By name, in the order of the set-up: the class that a publisher tells, None where a parameter is
# read, and the member that one of these is stored in.
Receivers: TypeAlias = "dict[str, tuple[str | None, str]]"


def add_receiver(receivers: Receivers, name: str, member: str, message: str, key: str) -> None:
    """Notes a publisher to a known rebec; `key` is the last part of its topic.

    Where people have changed the topic, the name of the publisher still tells the server.
    """
    own = member.strip("_").removeprefix(f"{name}_").removesuffix("_pub")
    classes = (message_class(message, server) for server in (key, own))
    class_name = next((of for of in classes if of is not None), None)
    if name.isidentifier() and class_name is not None:
        receivers.setdefault(name, (class_name, member))


def known_rebecs(
    members: Sequence[m.Declaration],
    state: Sequence[m.Declaration],
    receivers: Receivers,
    spans: Mapping[str, Span],
    above: Iterable[Receivers],
) -> list[m.Declaration]:
    """The known rebecs of a class, those of `members` and those that are only sent to.

    `spans` are the places of members, `above` the receivers of the classes above.
    """
    taken = {d.declarators[0].name for d in (*members, *state)}.union(*above)
    found = [
        m.Declaration(m.Type(of), (m.Declarator(name, None, spans[member]),), (), spans[member])
        for name, (of, member) in receivers.items()
        if of is not None and name not in taken and member in spans
    ]
    if not found:
        return list(members)
    order = {name: i for i, name in enumerate(receivers)}
    return sorted([*members, *found], key=lambda d: order.get(d.declarators[0].name, -1))
