"""Message servers of an extracted model that get messages from outside of what was read."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reserved import OPEN
from rebsync.reverse.nodes.node_joined import Joined
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.nodes.node_wiring import unfed


@dataclass(frozen=True, slots=True)
class OpenEnd:
    """A server of a rebec to which something outside sends: who publishes to a topic, or a client.

    `name` is that of the topic or service, None where it is not known; `fields` are the paths of
    the message's fields that the server's parameters get, in their order. `depth` is how many
    messages wait at most, None where that is not known, or without an end.
    """

    owner: str
    rebec: str
    server: str
    name: str | None
    type: str | None
    fields: tuple[str, ...]
    is_service: bool = False
    depth: int | None = None


def open_ends(joined: Joined) -> tuple[OpenEnd, ...]:
    """The open ends of a system that is wired: subscriptions that no rebec feeds, and services."""
    wiring = joined.wiring
    fed = [
        replace(_end(joined, i, s, i.topic(f.topic), False), depth=_depth(i.value(f.depth)))
        for i, s, f in unfed(wiring)
    ]
    return tuple(dict.fromkeys((*fed, *_services(joined))))


def receivers(joined: Joined) -> Iterator[OpenEnd]:
    """The servers of all subscriptions of rebecs that are started."""
    for instance in (i for i in joined.wiring.instances if not i.idle):
        for server in joined.wiring.servers[instance.start.unit.name]:
            for fact in server.subscriptions:
                end = _end(joined, instance, server, instance.topic(fact.topic), False)
                yield replace(end, depth=_depth(instance.value(fact.depth)))


def _depth(found: object) -> int | None:
    if not isinstance(found, int) or isinstance(found, bool) or found <= 0:
        return None  # roscpp takes 0 for no end
    return found


def wholly_open(joined: Joined) -> set[tuple[str, str]]:
    """The servers, by their classes, that in all rebecs of the class get messages from outside."""
    ends = {(e.owner, e.rebec, e.server) for e in open_ends(joined)}
    rebecs: dict[str, list[str]] = {}
    for instance in joined.wiring.instances:
        rebecs.setdefault(joined.class_of(instance), []).append(instance.name)
    pairs = {(owner, server) for owner, _, server in ends}
    return {(o, s) for o, s in pairs if all((o, rebec, s) in ends for rebec in rebecs[o])}


def _services(joined: Joined) -> Iterator[OpenEnd]:
    for instance in joined.wiring.instances:
        for server in joined.wiring.servers[instance.start.unit.name]:
            if server.service is not None:
                yield _end(joined, instance, server, instance.topic(server.service.name), True)


def _end(
    joined: Joined, instance: Instance, server: Server, name: object, is_service: bool
) -> OpenEnd:
    known = name if isinstance(name, str) else None
    fields = joined.taken(instance.start.unit.name, server)
    class_ = joined.class_of(instance)
    return OpenEnd(class_, instance.name, server.name, known, server.type, fields, is_service)


def with_open_servers(
    classes: Iterable[m.ReactiveClass], ends: Collection[OpenEnd]
) -> tuple[m.ReactiveClass, ...]:
    """The classes with `@Open` at the servers that something outside sends to.

    What the model is printed to then says of itself that it is no closed system.
    """
    opened = {(e.owner, e.server) for e in ends}
    return tuple(
        replace(c, members=tuple(_marked(x, c.name, opened) for x in c.members)) for c in classes
    )


def _marked(
    member: m.ClassMember, owner: str, opened: Collection[tuple[str, str]]
) -> m.ClassMember:
    if not isinstance(member, m.MessageServer) or (owner, member.name) not in opened:
        return member
    return replace(member, annotations=(m.Annotation(OPEN), *member.annotations))
