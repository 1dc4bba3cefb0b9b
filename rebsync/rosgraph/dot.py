"""The picture as text for Graphviz and for Mermaid, with the nodes of a package together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rebsync.rosgraph.picture import NODES, Box, Kind, Mark, Picture, Wire

_SHAPES = {
    Kind.NODE: "box",
    Kind.CODE: "box",
    Kind.UNREAD: "box",
    Kind.TOPIC: "ellipse",
    Kind.SERVICE: "hexagon",
    Kind.ACTION: "octagon",
    Kind.UNKNOWN: "plaintext",
}
_DASHED = frozenset({Kind.CODE, Kind.UNREAD})
_COLOURS = {Mark.ADDED: "#1a7f37", Mark.REMOVED: "#cf222e"}
# What is before and behind the text of a box of Mermaid.
_AROUND = {
    Kind.NODE: ("[", "]"),
    Kind.CODE: ("[", "]"),
    Kind.UNREAD: ("[", "]"),
    Kind.TOPIC: ("([", "])"),
    Kind.SERVICE: ("{{", "}}"),
    Kind.ACTION: ("[[", "]]"),
    Kind.UNKNOWN: ("(", ")"),
}


def packages(boxes: Iterable[Box]) -> dict[str, list[Box]]:
    """The nodes by their packages."""
    found: dict[str, list[Box]] = {}
    for box in boxes:
        if box.kind in NODES:
            found.setdefault(box.package, []).append(box)
    return found


# --- Graphviz -----------------------------------------------------------------------------------


def as_dot(picture: Picture) -> str:
    """The picture in the language of `dot`."""
    lines = [f"digraph {_quoted(picture.title)} {{", "  rankdir=LR", '  node [fontname="sans"]']
    for number, (package, boxes) in enumerate(packages(picture.boxes).items()):
        lines += [f"  subgraph cluster_{number} {{", f"    label={_quoted(package)}"]
        lines += [f"    {_dot_box(box)}" for box in boxes]
        lines.append("  }")
    lines += [f"  {_dot_box(box)}" for box in picture.boxes if box.kind not in NODES]
    lines += [f"  {_dot_wire(wire)}" for wire in picture.wires]
    return "\n".join([*lines, "}"]) + "\n"


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ")
    return f'"{escaped}"'


def _dot_box(box: Box) -> str:
    told = {"label": box.name, "shape": _SHAPES[box.kind]}
    if box.kind in _DASHED:
        told["style"] = "dashed"
    about = [*box.types, box.note, str(_where(box))]
    told["tooltip"] = "; ".join(text for text in about if text)
    told |= _dot_mark(box.mark)
    listed = ", ".join(f"{name}={_quoted(value)}" for name, value in told.items())
    return f"{_quoted(box.key)} [{listed}]"


def _where(box: Box) -> str:
    return f"{box.place.source.path}:{box.place.line}" if box.place is not None else ""


def _dot_wire(wire: Wire) -> str:
    told = {"tooltip": f"{wire.role.value}; {wire.place.source.path}:{wire.place.line}"}
    if not wire.certain:
        told["style"] = "dashed"
    told |= _dot_mark(wire.mark)
    listed = ", ".join(f"{name}={_quoted(value)}" for name, value in told.items())
    return f"{_quoted(wire.source)} -> {_quoted(wire.target)} [{listed}]"


def _dot_mark(mark: Mark) -> dict[str, str]:
    return {"color": _COLOURS[mark], "penwidth": "2"} if mark in _COLOURS else {}


# --- Mermaid ------------------------------------------------------------------------------------


def as_mermaid(picture: Picture) -> str:
    """The picture as a flow chart of Mermaid."""
    ids = {box.key: f"b{number}" for number, box in enumerate(picture.boxes)}
    lines = ["flowchart LR"]
    for number, (package, boxes) in enumerate(packages(picture.boxes).items()):
        lines.append(f"  subgraph p{number}[{_mermaid_text(package)}]")
        lines += [f"    {_mermaid_box(box, ids)}" for box in boxes]
        lines.append("  end")
    lines += [f"  {_mermaid_box(box, ids)}" for box in picture.boxes if box.kind not in NODES]
    for wire in picture.wires:
        arrow = "-->" if wire.certain else "-.->"
        lines.append(f"  {ids[wire.source]} {arrow} {ids[wire.target]}")
    lines += _mermaid_styles(picture, ids)
    return "\n".join(lines) + "\n"


def _mermaid_text(text: str) -> str:
    """A text in quotes; what has a meaning there stands as its number."""
    return '"' + "".join(f"#{ord(c)};" if c in '"#&<>\n\r' else c for c in text) + '"'


def _mermaid_box(box: Box, ids: dict[str, str]) -> str:
    before, behind = _AROUND[box.kind]
    return f"{ids[box.key]}{before}{_mermaid_text(box.name)}{behind}"


def _mermaid_styles(picture: Picture, ids: dict[str, str]) -> Iterator[str]:
    for box in picture.boxes:
        if box.mark in _COLOURS:
            yield f"  style {ids[box.key]} stroke:{_COLOURS[box.mark]},stroke-width:3px"
        elif box.kind in _DASHED:
            yield f"  style {ids[box.key]} stroke-dasharray:4"
    for number, wire in enumerate(picture.wires):
        if wire.mark in _COLOURS:
            yield f"  linkStyle {number} stroke:{_COLOURS[wire.mark]},stroke-width:3px"
