"""One page with the graph, its findings and the lines of code; it needs nothing but itself."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from importlib.resources import files

from rebsync.checker.show.markup import Markup, element, joined, metadata
from rebsync.diagnostics import Severity
from rebsync.rosgraph.data import graph_data
from rebsync.rosgraph.findings import GraphFinding
from rebsync.rosgraph.picture import NODES, Box, Kind, Picture
from rebsync.rosgraph.svg import STYLE, drawing, laid_out
from rebsync.rosgraph.text import counted

_HELP = (
    "Drag to move, turn the wheel to zoom, click a box or wire for its lines of code, "
    "/ to search, 0 to see all."
)


def graph_page(picture: Picture, findings: Sequence[GraphFinding]) -> str:
    """The page of a graph."""
    script = _file("page.js")
    head = element(
        "head",
        joined(
            *metadata(script),
            element("title", picture.title),
            element("style", Markup(STYLE + _file("page.css"))),
        ),
    )
    body = element(
        "body",
        joined(
            _header(picture),
            element("main", joined(_aside(picture, findings), _canvas(picture))),
            _data(picture, findings),
            element("script", Markup(script)),
        ),
    )
    return f"<!DOCTYPE html>\n{element('html', head, body, lang='en')}\n"


@cache
def _file(name: str) -> str:
    return files("rebsync.rosgraph").joinpath(name).read_text(encoding="utf-8")


def _header(picture: Picture) -> Markup:
    search = element(
        "input", type="search", id="search", placeholder="Search", aria_label="Search names"
    )
    groups = [element("option", text, value=text) for text in ("package", "namespace", "kind")]
    select = element("select", *groups, id="grouping", aria_label="Groups of the list")
    return element(
        "header",
        element("h1", picture.title),
        element("p", counted(picture), class_="counts"),
        element("p", search, " list by ", select, " ", element("span", "", id="hits")),
        element("p", _HELP, class_="help"),
    )


def _aside(picture: Picture, findings: Sequence[GraphFinding]) -> Markup:
    listed = [_finding(number, f) for number, f in enumerate(findings)]
    found = [element("h2", f"Findings ({len(listed)})"), element("ol", *listed, id="findings")]
    return element(
        "aside",
        element("section", id="selected", aria_live="polite"),
        *(found if listed else []),
        element("h2", "Nodes and names"),
        element("div", *_items(picture.boxes), id="list"),
    )


def _finding(number: int, finding: GraphFinding) -> Markup:
    place = f"{finding.place.source.path}:{finding.place.line}"
    return element(
        "li",
        element("button", element("b", finding.code), f" {finding.message} ", type="button"),
        element("small", place),
        class_="note" if finding.severity is Severity.NOTE else "warning",
        data_finding=str(number),
    )


def _items(boxes: Sequence[Box]) -> list[Markup]:
    """Every box; the script puts them into groups."""
    return [
        element(
            "button",
            " ".join((box.name, *box.types)) if box.kind is Kind.UNKNOWN else box.name,
            type="button",
            data_item=str(i),
            data_package=box.package or "names",
            data_namespace=box.namespace or "unknown",
            data_kind="node" if box.kind in NODES else box.kind.value,
        )
        for i, box in enumerate(boxes)
    ]


def _canvas(picture: Picture) -> Markup:
    found = laid_out(picture)
    return element(
        "svg",
        drawing(picture, found),
        id="canvas",
        class_="graph",
        viewBox=f"0 0 {found.width + 80:.0f} {found.height + 80:.0f}",
        role="group",
        aria_label="Computation graph",
    )


def _data(picture: Picture, findings: Sequence[GraphFinding]) -> Markup:
    text = json.dumps(graph_data(picture, findings)).replace("<", "\\u003c")
    return element("script", Markup(text), type="application/json", id="data")
