"""Rules about ends that have one name: their types, and their qualities of service."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rebsync.diagnostics import Severity
from rebsync.rosgraph.ends import Role
from rebsync.rosgraph.findings import Evidence, GraphFinding
from rebsync.rosgraph.graph import NodeEnd, RosNode
from rebsync.rosgraph.quality import misfits

_MESSAGES = ("_msgs", "_srvs", "_interfaces", "_msg")
NodeWithEnd = tuple[RosNode, NodeEnd]


def different_types(known: Evidence) -> Iterator[GraphFinding]:
    """RS990: ends of one name whose types are known, certain, and not the same."""
    for (channel, name), held in known.graph.channels().items():
        plain = [h for h in _fixed(held) if _is_interface(known, h[1].types[0])]
        for flat in (True, False):
            of_ros = [h for h in plain if _is_flat(h[0]) is flat]
            yield from _of_types(known, channel.value, name, of_ros)


def _of_types(
    known: Evidence, channel: str, name: str, held: Sequence[NodeWithEnd]
) -> Iterator[GraphFinding]:
    by_type: dict[str, list[NodeWithEnd]] = {}
    for node, end in held:
        by_type.setdefault(end.types[0], []).append((node, end))
    if len(by_type) < 2:
        return
    most = max(by_type, key=lambda t: len(by_type[t]))
    for type_, odd in by_type.items():
        if type_ == most:
            continue
        node, end = odd[0]
        other, usual = next(
            (h for h in by_type[most] if known.together(h[0], node)),
            by_type[most][0],
        )
        sure = known.together(node, other)
        yield GraphFinding(
            "RS990",
            end.end.place,
            f"the {channel} {name} is {type_} here, and {most} elsewhere"
            + ("" if sure else ", if both run in one system"),
            None,
            ((usual.end.place, f"{usual.end.role.value} with {most}"),),
            Severity.WARNING if sure else Severity.NOTE,
        )


def _fixed(held: Sequence[NodeWithEnd]) -> Iterator[NodeWithEnd]:
    """The ends with one type; a node with several types of one name chooses among them."""
    chosen: dict[int, set[str]] = {}
    for node, end in held:
        chosen.setdefault(id(node), set()).update(end.types or ("?",))
    for node, end in held:
        if end.certain and len(end.types) == 1 and len(chosen[id(node)]) == 1:
            yield node, end


def _is_interface(known: Evidence, type_: str) -> bool:
    """Whether this is a type of messages: another class may only be converted to one."""
    return type_.partition("/")[0].endswith(_MESSAGES) or type_ in known.interfaces


def _is_flat(node: RosNode) -> bool:
    return node.code is not None and node.code.is_flat


def misfit_qualities(known: Evidence) -> Iterator[GraphFinding]:
    """RS991: a subscription and a publisher whose qualities of service never match."""
    for (_, name), held in known.graph.channels().items():
        sent = [h for h in held if h[1].end.role is Role.PUBLISHER and h[1].end.policies]
        for node, end in held:
            if end.end.role is Role.SUBSCRIPTION and end.end.policies and end.certain:
                yield from _misfits(known, name, (node, end), sent)


def _misfits(
    known: Evidence, name: str, to: NodeWithEnd, sent: Sequence[NodeWithEnd]
) -> Iterator[GraphFinding]:
    node, end = to
    requested = end.end.policies
    if requested is None:
        return
    reasons: list[tuple[RosNode, NodeEnd, str]] = []
    for other, offering in sent:
        offered = offering.end.policies
        why = list(misfits(offered, requested)) if offered and offering.certain else []
        if why:
            reasons.append((other, offering, "; ".join(why)))
    for other, offering, text in reasons:
        alone = len(reasons) == len(sent)
        sure = alone and known.together(node, other)
        yield GraphFinding(
            "RS991",
            end.end.place,
            f"this subscription to {name} gets nothing of {other.name}: {text}"
            + ("" if sure or not alone else ", if both run in one system"),
            None,
            ((offering.end.place, "the publisher"),),
            Severity.WARNING if sure else Severity.NOTE,
        )
