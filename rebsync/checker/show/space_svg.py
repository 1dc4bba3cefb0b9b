"""A small state space as SVG: states in levels, edges with what happens."""

from __future__ import annotations

from rebsync.checker.show import words
from rebsync.checker.show.chart_rows import width_of
from rebsync.checker.show.chart_style import STYLE
from rebsync.checker.show.markup import Markup, element, joined, number
from rebsync.checker.show.space import StateSpace, state_lines
from rebsync.checker.show.space_layout import drawing_of
from rebsync.checker.show.space_routes import MARGIN, ROW, Line, Node
from rebsync.diagnostics import RebsyncError

LARGEST = 500


def space_svg(space: StateSpace) -> str:
    """The state space as an SVG file; a RebsyncError (RS925) when it is too large to draw."""
    size = len(space.states)
    if size > LARGEST:
        message = f"{size:,} states are too many to draw: at most {LARGEST} are"
        hint = "write them to a .json or .dot file, or bound the model"
        raise RebsyncError.of(space.model, "RS925", message, hint)
    drawing = drawing_of(space)
    left = min((0.0, *(line.at[0] - MARGIN for line in drawing.lines)))
    width = drawing.width - left
    wrong = dict(space.marks)
    edges = sum(1 for _ in space.edges)
    said = f"{words.counted(size, 'state')}, {words.counted(edges, 'transition')}."
    return (
        element(
            "svg",
            joined(
                element("title", f"State space of {space.model}", id="space-title"),
                element("desc", said, id="space-desc"),
                element("style", Markup(STYLE)),
                element("rect", class_="back", x=left, width="100%", height="100%"),
                *(_line(line) for line in drawing.lines),
                *(_node(node, space, wrong) for node in drawing.nodes),
                *(_label(line) for line in drawing.lines),
            ),
            xmlns="http://www.w3.org/2000/svg",
            class_="msc space",
            viewBox=f"{number(left)} 0 {number(width)} {number(drawing.height)}",
            width=width,
            height=drawing.height,
            role="img",
            aria_labelledby="space-title space-desc",
        )
        + "\n"
    )


def _line(line: Line) -> Markup:
    points = "L".join(f"{number(x)},{number(y)}" for x, y in line.points)
    kind = "way" if line.edge.rebec else "way passing"
    if line.target.number is None:
        kind = "way failing"
    end = line.edge.target if line.edge.target is not None else "a failure"
    title = element("title", f"{line.edge.source} to {end}: {line.edge.label}")
    return element("g", title, element("path", class_=kind, d=f"M{points}"), _tip(line))


def _tip(line: Line) -> Markup:
    """An arrow's head at the end of a line, in the direction of its last part."""
    (x0, y0), (x, y) = line.points[-2:]
    long = ((x - x0) ** 2 + (y - y0) ** 2) ** 0.5 or 1.0
    dx, dy = (x - x0) / long, (y - y0) / long
    corners = [
        (x, y),
        (x - 8 * dx - 4 * dy, y - 8 * dy + 4 * dx),
        (x - 8 * dx + 4 * dy, y - 8 * dy - 4 * dx),
    ]
    drawn = "L".join(f"{number(a)},{number(b)}" for a, b in corners)
    return element("path", class_="tip", d=f"M{drawn}z")


def _label(line: Line) -> Markup:
    x, y = line.at
    wide = width_of(line.label)
    paper = element("rect", class_="back", x=x - 2, y=y - 10, width=wide + 4, height=12)
    return joined(paper, element("text", line.label, class_="send", x=x, y=y))


def _node(node: Node, space: StateSpace, wrong: dict[int, str]) -> Markup:
    left = node.x - node.width / 2
    box = element(
        "rect", class_="head", x=left, y=node.top, width=node.width, height=node.height, rx=4
    )
    texts = [
        element(
            "text",
            text,
            class_="label" if not line else "note",
            x=left + 7,
            y=node.top + ROW * (line + 1) - 1,
        )
        for line, text in enumerate(node.lines)
    ]
    if node.number is None:
        return element("g", box, *texts, class_="state wrong")
    told = [f"state {node.number}", *state_lines(space.states[node.number])]
    if node.number in wrong:
        told.append(wrong[node.number])
    arrow = []
    if node.number in space.initial:
        x, y = number(node.x), number(node.top)
        arrow = [
            element("path", class_="way", d=f"M{x},{number(node.top - 16)}L{x},{y}"),
            element("path", class_="tip", d=f"M{x},{y}l-4,-8h8z"),
        ]
    kind = "state wrong" if node.number in wrong else "state"
    return element("g", element("title", "\n".join(told)), *arrow, box, *texts, class_=kind)
