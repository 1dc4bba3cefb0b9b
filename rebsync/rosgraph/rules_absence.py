"""Rules about names with one kind of end only: what is missing, or is misspelled."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from rebsync.diagnostics import Severity
from rebsync.records import dataclass
from rebsync.rosgraph.ends import OTHER_END, SENDING, Channel, Role
from rebsync.rosgraph.findings import Evidence, GraphFinding
from rebsync.rosgraph.graph import NodeEnd, RosNode

NodeWithEnd = tuple[RosNode, NodeEnd]
_SHORTEST = 4  # letters of a part of a name in which a slip is told

# What every node has, or what the tools and the middleware serve.
_SYSTEM = re.compile(
    r"/(?:clock|tf|tf_static|rosout|rosout_agg|parameter_events|diagnostics|diagnostics_agg)\Z"
    r"|.*/(?:transition_event|get_state|change_state|get_available_states)\Z"
    r"|.*/(?:get_available_transitions|get_transition_graph|get_type_description)\Z"
    r"|.*/(?:get|set|list|describe)_parameters(?:_atomically)?\Z|.*/get_parameter_types\Z"
    r"|.*/(?:get|set)_loggers?(?:_level)?s?\Z|.*/(?:load|unload|list)_nodes?\Z"
)
_MISSING = {
    Role.SUBSCRIPTION: ("RS992", "publishes to", "the topic"),
    Role.PUBLISHER: ("RS993", "subscribes to", "the topic"),
    Role.CLIENT: ("RS997", "offers", "the service"),
    Role.SERVER: ("RS998", "calls", "the service"),
    Role.ACTION_CLIENT: ("RS997", "offers", "the action"),
    Role.ACTION_SERVER: ("RS998", "calls", "the action"),
}


@dataclass(frozen=True, slots=True)
class OneSided:
    """A name all of whose ends have one role."""

    channel: Channel
    name: str
    role: Role
    held: tuple[NodeWithEnd, ...]


def one_sided(known: Evidence) -> Iterator[OneSided]:
    """The names with one role, whose other end no unknown name can be."""
    every = [end for node in known.graph.nodes for end in node.ends]
    for (channel, name), held in known.graph.channels().items():
        roles = {end.end.role for _, end in held}
        role = held[0][1].end.role
        if len(roles) > 1 or not any(end.certain for _, end in held):
            continue
        if _SYSTEM.match(name) or name.rpartition("/")[2] in known.remapped:
            continue
        missing = OTHER_END[role]
        if any(_may_be(end, missing, name, held) for end in every):
            continue
        if not any(_may_become(end, missing, name, held) for end in known.loose):
            yield OneSided(channel, name, role, tuple(held))


def _may_be(end: NodeEnd, role: Role, name: str, held: Sequence[NodeWithEnd]) -> bool:
    """Whether an end whose name is not known may be the missing one."""
    if end.end.role is not role or not end.may_be(name):
        return False
    types = {t for _, other in held for t in other.types}
    return not end.types or not types or bool(types & set(end.types))


def _may_become(end: NodeEnd, role: Role, name: str, held: Sequence[NodeWithEnd]) -> bool:
    """Whether an end of code that some node runs, in its namespace, may be the missing one."""
    if end.name is not None and end.end.role is role:
        return end.name.rpartition("/")[2] == name.rpartition("/")[2]
    return _may_be(end, role, name, held)


def nobody(known: Evidence) -> Iterator[GraphFinding]:
    """RS992, RS993, RS997, RS998: the other end is nowhere in what was read."""
    every = list(one_sided(known))
    slipped = {(each.channel, each.name) for pair in _pairs(every) for each in pair}
    unread = sum(not node.is_read for node in known.graph.nodes)
    for each in every:
        if (each.channel, each.name) in slipped or all(e.end.is_lone for _, e in each.held):
            continue
        code, does, what = _MISSING[each.role]
        end = next(end for _, end in each.held if end.certain)
        message = f"nothing of what was read {does} {what} {each.name}"
        hint = f"not read of what the launch file starts: {unread}" if unread else None
        yield GraphFinding(code, end.end.place, message, hint, (), Severity.NOTE)


def slips(known: Evidence) -> Iterator[GraphFinding]:
    """RS994: two names with one role each, of the same type, that differ by one letter."""
    unread = any(not node.is_read for node in known.graph.nodes)
    for one, other in _pairs(list(one_sided(known))):
        end, usual = one.held[0][1], other.held[0][1]
        yield GraphFinding(
            "RS994",
            end.end.place,
            f"nothing has the other end of {one.name}, which is a letter off {other.name}",
            f'did you mean "{other.name}"?',
            ((usual.end.place, f"{usual.end.role.value} of {other.name}"),),
            Severity.NOTE if unread else Severity.WARNING,
        )


def _pairs(every: Sequence[OneSided]) -> Iterator[tuple[OneSided, OneSided]]:
    """A name that is sent to, with one that is received from, of which one is misspelled."""
    receiving = [e for e in every if e.role not in SENDING]
    for one in (e for e in every if e.role in SENDING):
        for other in receiving:
            same = OTHER_END[one.role] is other.role and _types(one) & _types(other)
            if same and is_slip(one.name, other.name):
                yield one, other


def _types(each: OneSided) -> set[str]:
    return {t for _, end in each.held for t in end.types}


def is_slip(one: str, other: str) -> bool:
    """Whether two names differ in one part, by one letter that is there, not there, or moved.

    Digits tell names apart that are meant to be different.
    """
    parts, others = one.split("/"), other.split("/")
    if len(parts) != len(others):
        return False
    different = [(a, b) for a, b in zip(parts, others, strict=True) if a != b]
    if len(different) != 1 or min(map(len, different[0])) < _SHORTEST:
        return False
    a, b = different[0]
    if sorted(re.findall(r"\d+", a)) != sorted(re.findall(r"\d+", b)):
        return False
    return a.casefold() == b.casefold() or _is_one_letter(*sorted((a, b), key=len))


def _is_one_letter(short: str, long: str) -> bool:
    start = next(
        (i for i, (a, b) in enumerate(zip(short, long, strict=False)) if a != b), len(short)
    )
    rest, more = short[start:], long[start:]
    if len(long) - len(short) == 1:
        return rest == more[1:]
    if len(long) != len(short):
        return False
    swapped = len(rest) > 1 and rest[:2] == more[1::-1] and rest[2:] == more[2:]
    return rest[1:] == more[1:] or swapped
