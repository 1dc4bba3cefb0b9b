"""The graph and its changes as lines for people."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.rosgraph.ends import SENDING, Role
from rebsync.rosgraph.picture import NODES, Box, Kind, Picture, Wire, changes

_KINDS = {Kind.CODE: "code that no program here runs", Kind.UNREAD: "not read"}
_VERBS = {
    Role.PUBLISHER: "publishes",
    Role.SUBSCRIPTION: "subscribes to",
    Role.SERVER: "offers",
    Role.CLIENT: "calls",
    Role.ACTION_SERVER: "offers the action",
    Role.ACTION_CLIENT: "calls the action",
}


def lines(picture: Picture) -> Iterator[str]:
    """Each node with what it is an end of, by packages."""
    boxes = {box.key: box for box in picture.boxes}
    for box in sorted((b for b in picture.boxes if b.kind in NODES), key=_order):
        yield _title(box)
        for wire in picture.wires:
            if box.key in (wire.source, wire.target):
                yield f"    {_said(wire, boxes)}"
    yield counted(picture)


def _order(box: Box) -> tuple[str, str, str]:
    return box.package, box.name, box.label


def _title(box: Box) -> str:
    about = [f"{box.package}/{box.label}"]
    about += [_KINDS[box.kind]] if box.kind in _KINDS else []
    about += [box.note] if box.note else []
    return f"{box.name} ({', '.join(about)})"


def _said(wire: Wire, boxes: dict[str, Box]) -> str:
    name = boxes[_name_of(wire)]
    types = f" [{' or '.join(wire.types)}]" if wire.types else ""
    doubt = "" if wire.certain or name.kind is Kind.UNKNOWN else " (perhaps)"
    why = f" ({name.note})" if name.kind is Kind.UNKNOWN and name.note else ""
    place = f"{wire.place.source.path}:{wire.place.line}"
    return f"{_VERBS[wire.role]} {name.name}{types}{doubt}{why}  {place}"


def _name_of(wire: Wire) -> str:
    return wire.target if wire.role in SENDING else wire.source


def _node_of(wire: Wire) -> str:
    return wire.source if wire.role in SENDING else wire.target


def counted(picture: Picture) -> str:
    """How many there are of each kind."""
    found = [b.kind for b in picture.boxes]
    nodes = sum(kind in NODES for kind in found)
    told = [_number(nodes, "node"), *(_number(found.count(k), k.value) for k in _NAMES)]
    unknown = found.count(Kind.UNKNOWN)
    return ", ".join(told) + (f", {unknown} of unknown name" if unknown else "")


_NAMES = (Kind.TOPIC, Kind.SERVICE, Kind.ACTION)


def _number(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"


def change_lines(picture: Picture) -> Iterator[str]:
    """What is in one of two graphs only."""
    boxes = {box.key: box for box in picture.boxes}
    some, wires = changes(picture)
    for box in some:
        if box.kind in NODES:
            yield f"{box.mark.value}: node {_title(box)}"
    for wire in wires:
        yield f"{wire.mark.value}: {boxes[_node_of(wire)].name} {_said(wire, boxes)}"
