"""The annotations of classes and servers of generated code: from markers, and from the set-up.

What a set-up does counts, whatever a marker says: the priority of a server, and as what it
is offered.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rebsync import model as m
from rebsync.reserved import OFFERS
from rebsync.static.constants import constant

PRIORITIES = frozenset({"priority", "globalPriority"})
_SHOWN = PRIORITIES | OFFERS


def priority(kind: str, number: int) -> m.Annotation:
    """`@priority(n)` or `@globalPriority(n)`."""
    value = m.IntLiteral(abs(number))
    return m.Annotation(kind, (value if number >= 0 else m.Unary("-", value),))


def best_priority(servers: Iterable[Sequence[m.Annotation]]) -> int | None:
    """The priority of the most urgent of some servers; None if none has any."""
    given = (a.arguments or () for shown in servers for a in shown if a.name in PRIORITIES)
    found = (constant(argument) for arguments in given for argument in arguments)
    return min((int(number) for number in found if number is not None), default=None)


def of_class(
    marked: Sequence[m.Annotation] | None, *, has_drive: bool, on_bridge: bool
) -> Iterator[m.Annotation]:
    """Those of a class: of its markers, if it has any, or else what the set-up shows."""
    if marked is not None:
        yield from marked
        return
    if has_drive:
        yield m.Annotation("Robot")
    if on_bridge:
        yield m.Annotation("Controller")


def of_server(
    marked: Sequence[m.Annotation] | None,
    shown: Sequence[m.Annotation] | None,
    *,
    is_sensor: bool,
) -> Iterator[m.Annotation]:
    """Those of a server: of its markers, and what the set-up shows, if it shows anything of it."""
    if marked is None:
        if is_sensor:
            yield m.Annotation("Sensor")
        yield from shown or ()
        return
    said = {a.name: a for a in shown or () if a.name in _SHOWN}
    for each in marked:
        if each.name not in _SHOWN or shown is None:
            yield each
        elif (own := said.pop(each.name, None)) is not None:
            yield each if each.arguments == own.arguments else own
    yield from said.values()
