"""The text of the model in a page, and what of it never ran."""

from __future__ import annotations

from collections import defaultdict

from rebsync.checker.result import Coverage
from rebsync.checker.show.highlight import highlighted
from rebsync.checker.show.markup import Markup, element, joined
from rebsync.source import Source

_NOTHING = Coverage((), (), ())


def source_section(source: Source, coverage: Coverage | None) -> Markup:
    """The model with its lines; a box shows or hides what never ran."""
    covered = coverage or _NOTHING
    remarks: dict[int, list[str]] = defaultdict(list)
    for line, what in covered.branches:
        remarks[line].append(what)
    switch = Markup("")
    if covered.lines or covered.branches:
        box = element("input", type="checkbox", id="coverage-shown", checked=True)
        label = element("label", " mark what never ran", for_="coverage-shown")
        switch = element("p", box, label)
    title = element("h2", "Model")
    table = _lines(source, "L", frozenset(covered.lines), remarks)
    return element("section", joined(title, switch, table), class_="source", id="source")


def text_section(source: Source, title: str, prefix: str) -> Markup:
    """Another text with its lines."""
    table = _lines(source, prefix, frozenset(), {})
    return element("section", element("h2", title), table, class_="source")


def coverage_section(coverage: Coverage) -> Markup:
    """What never ran, and how full bags became, as lists."""
    servers = [element("li", f"{server} never runs") for server in coverage.servers]
    branches = [
        element("li", element("a", f"line {line}", href=f"#L{line}"), f": {what}")
        for line, what in coverage.branches
    ]
    bags = [
        element("li", f"{rebec}: at most {most} of {capacity} places taken")
        for rebec, most, capacity in coverage.largest_bags
    ]
    never = [*servers, *branches] or [element("li", "everything ran")]
    parts = [
        element("h2", "Coverage"),
        element("ul", *never),
        element("h3", "Bags"),
        element("ul", *bags),
    ]
    return element("section", joined(*parts), id="coverage")


def _lines(
    source: Source, prefix: str, never: frozenset[int], remarks: dict[int, list[str]]
) -> Markup:
    texts = highlighted(source.text)
    rows = [
        element(
            "tr",
            element("th", str(number), scope="row"),
            element(
                "td",
                element("code", text or " "),
                *(element("small", f" {remark}") for remark in remarks.get(number, ())),
            ),
            id=f"{prefix}{number}",
            data_line=str(number) if prefix == "L" else None,
            class_="never" if number in never else None,
            title="never runs" if number in never else None,
        )
        for number, text in enumerate(texts, 1)
    ]
    return element("table", element("tbody", joined(*rows)), class_="lines")
