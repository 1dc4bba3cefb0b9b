"""The picture as SVG: nodes are boxes, names are rounded, what is not known is red."""

from __future__ import annotations

import zlib
from collections.abc import Sequence

from rebsync.checker.show.markup import Markup, element, joined, number
from rebsync.rosgraph.layout import Layout, Spot, layout
from rebsync.rosgraph.picture import MORE, NODES, Box, Kind, Mark, Picture, Wire

STYLE = """
.graph { font: 13px system-ui, sans-serif; }
.graph .box rect { fill: var(--fill, #fff); stroke: var(--edge, #57606a); stroke-width: 1.2; }
.graph .box text { fill: #1f2328; } .graph .box .sub { fill: #57606a; font-size: 10.5px; }
.graph .topic rect { fill: #fff; } .graph .service rect { fill: #fff8e5; stroke: #9a6700; }
.graph .action rect { fill: #f3edff; stroke: #8250df; }
.graph .unknown rect { fill: #fff0ee; stroke: #cf222e; stroke-dasharray: 3 2; }
.graph .unread rect, .graph .code rect { stroke-dasharray: 5 3; }
.graph .wire { fill: none; stroke: #6e7781; stroke-width: 1.2; }
.graph .wire.perhaps { stroke-dasharray: 5 4; }
.graph .added rect, .graph .wire.added { stroke: #1a7f37; stroke-width: 3; }
.graph .removed rect, .graph .wire.removed { stroke: #cf222e; stroke-width: 3; opacity: .6; }
"""
_MARGIN = 40.0
_LETTER = 7.2  # the width of one, about
_LONGEST = 46  # letters that are shown of a name


def as_svg(picture: Picture) -> str:
    """A picture that stands by itself."""
    found = laid_out(picture)
    width, height = found.width + 2 * _MARGIN, found.height + 2 * _MARGIN
    drawn = element(
        "svg",
        element("style", Markup(STYLE)),
        element("title", picture.title),
        element("rect", width="100%", height="100%", fill="#fff"),
        drawing(picture, found),
        xmlns="http://www.w3.org/2000/svg",
        viewBox=f"0 0 {number(width)} {number(height)}",
        width=width,
        height=height,
        class_="graph",
    )
    return f"{drawn}\n"


def laid_out(picture: Picture) -> Layout:
    """Where the boxes of a picture are."""
    ids = {box.key: i for i, box in enumerate(picture.boxes)}
    edges = [(ids[w.source], ids[w.target]) for w in picture.wires]
    return layout([_size(box) for box in picture.boxes], edges)


def drawing(picture: Picture, found: Layout) -> Markup:
    """The wires, and the boxes over them."""
    ids = {box.key: i for i, box in enumerate(picture.boxes)}
    wires = [_wire(w, ids, picture.boxes, found) for w in picture.wires]
    boxes = [_box(box, i, found.spots[i]) for i, box in enumerate(picture.boxes)]
    arrow = element("path", d="M0 0 L8 4 L0 8 z", fill="#6e7781")
    marker = element(
        "marker",
        arrow,
        id="arrow",
        viewBox="0 0 8 8",
        refX="8",
        refY="4",
        markerWidth="7",
        markerHeight="7",
        orient="auto",
    )
    where = f"translate({number(_MARGIN)} {number(_MARGIN)})"
    return element(
        "g", element("defs", marker), joined(*wires), joined(*boxes), transform=where, id="drawing"
    )


def _size(box: Box) -> tuple[float, float]:
    letters = max(len(_shown(box.name)), len(_sub(box)) * 0.85)
    return max(60.0, letters * _LETTER + 24), 40.0 if _sub(box) else 26.0


def _shown(name: str) -> str:
    return name if len(name) <= _LONGEST else f"...{name[3 - _LONGEST :]}"


def _sub(box: Box) -> str:
    """The second line: the package of a node, the type of a topic."""
    if box.kind in NODES:
        more = " ..." if MORE in box.note else ""
        return _shown(f"{box.package}/{box.label}") + more
    return _shown(" or ".join(box.types))


def hue(package: str) -> int:
    """The colour of a package, the same in every picture."""
    return zlib.crc32(package.encode()) % 360


def _box(box: Box, i: int, spot: Spot) -> Markup:
    width, height = _size(box)
    colours = f"--fill: hsl({hue(box.package)} 70% 94%); --edge: hsl({hue(box.package)} 45% 40%)"
    own = colours if box.kind is Kind.NODE else None
    middle, sub = number(width / 2), _sub(box)
    place = f"{box.place.source.path}:{box.place.line}" if box.place is not None else ""
    about = "\n".join(t for t in (box.name, sub, box.note, place) if t)
    rounded = 4.0 if box.kind in NODES else height / 2
    return element(
        "g",
        element("title", about),
        element("rect", width=width, height=height, rx=rounded, style=own),
        element("text", _shown(box.name), x=middle, y="17", text_anchor="middle"),
        element("text", sub, x=middle, y="32", text_anchor="middle", class_="sub") if sub else None,
        class_=" ".join(filter(None, ("box", box.kind.value, box.mark.value))),
        transform=f"translate({number(spot.x)} {number(spot.y)})",
        data_box=str(i),
        tabindex="0",
    )


def _wire(wire: Wire, ids: dict[str, int], boxes: Sequence[Box], found: Layout) -> Markup:
    a, b = ids[wire.source], ids[wire.target]
    (aw, ah), (_, bh) = _size(boxes[a]), _size(boxes[b])
    start, end = found.spots[a], found.spots[b]
    x, y, to_x, to_y = start.x + aw, start.y + ah / 2, end.x, end.y + bh / 2
    bend, lift = max(30.0, abs(to_x - x) / 2), 0.0
    if to_x < x:  # back, below what is between
        bend, lift = 60.0, 40.0 + 0.05 * (x - to_x)
    line = (
        f"M{number(x)} {number(y)} C{number(x + bend)} {number(y + lift)} "
        f"{number(to_x - bend)} {number(to_y + lift)} {number(to_x)} {number(to_y)}"
    )
    doubt = "" if wire.certain else "perhaps"
    mark = wire.mark.value if wire.mark is not Mark.SAME else ""
    return element(
        "path",
        d=line,
        class_=" ".join(filter(None, ("wire", doubt, mark))),
        marker_end="url(#arrow)",
        data_from=str(a),
        data_to=str(b),
    )
