"""One page with both texts side by side and the differences between them.

It needs nothing but itself; without scripts everything in it can still be read.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from importlib.resources import files

from rebsync import model as m
from rebsync.checker.show.markup import Markup, element, joined, metadata
from rebsync.records import dataclass
from rebsync.roundtrip.diff.behaviour import Behaviour
from rebsync.roundtrip.diff.behaviour import lines as behaviour_lines
from rebsync.roundtrip.diff.difference import (
    Added,
    Comparison,
    Difference,
    Place,
    Removed,
    StatementInserted,
    StatementRemoved,
    Undetermined,
    explain,
)
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.diff.report import counted, verdict_of
from rebsync.source import NOWHERE, Source, SourceSpan

_HELP = "Select a difference: click it, or j and k or the arrow keys."


@dataclass(frozen=True, slots=True, eq=False)
class _Pane:
    """The texts of one side, and what is marked in them: class by source and line."""

    prefix: str
    sources: tuple[Source, ...]
    marks: dict[tuple[str, int], str]

    def line(self, place: Place | None) -> str | None:
        """The name of the line that a place is in."""
        if place is None or place.line is None:
            return None
        paths = [source.path for source in self.sources]
        if place.source.path not in paths:
            return None
        return f"{self.prefix}{paths.index(place.source.path)}-{place.line}"


def sides_page(
    comparison: Comparison,
    left: SourcedModel,
    right: SourcedModel,
    behaviour: Behaviour | None = None,
) -> str:
    """The page of a comparison."""
    panes = _pane("L", left, comparison), _pane("R", right, comparison)
    title = f"{left.source.path} and {right.source.path}"
    style, script = element("style", Markup(_file("page.css"))), Markup(_file("page.js"))
    body = element(
        "body",
        joined(
            element("header", element("h1", title), *_said(comparison, behaviour, panes)),
            element("main", *map(_texts, panes)),
            element("script", script),
        ),
    )
    head = element("head", joined(*metadata(_file("page.js")), element("title", title), style))
    return f"<!DOCTYPE html>\n{element('html', head, body, lang='en')}\n"


@cache
def _file(name: str) -> str:
    return files("rebsync.roundtrip.diff").joinpath(name).read_text(encoding="utf-8")


# --- the list -----------------------------------------------------------------------------------


def _verdict(comparison: Comparison) -> Markup:
    verdict = verdict_of(comparison)
    return element(
        "p", element("strong", verdict, class_=f"verdict {verdict}"), f": {counted(comparison)}"
    )


def _said(
    comparison: Comparison, behaviour: Behaviour | None, panes: tuple[_Pane, _Pane]
) -> Iterator[Markup]:
    yield _verdict(comparison)
    yield from _list(comparison, panes)
    if behaviour is not None:
        yield element("pre", "\n".join(behaviour_lines(behaviour)))


def _list(comparison: Comparison, panes: tuple[_Pane, _Pane]) -> Iterator[Markup]:
    if comparison.differences:
        yield element("p", _HELP, class_="help")
    groups: dict[str, list[Markup]] = {}
    for number, difference in enumerate(comparison.differences, start=1):
        group = difference.element.group or "system"
        groups.setdefault(group, []).append(_item(number, difference, panes))
    for group, items in groups.items():
        yield element("h2", group)
        yield element("ul", joined(*items), class_="differences")


def _item(number: int, difference: Difference, panes: tuple[_Pane, _Pane]) -> Markup:
    places = (difference.left, difference.right)
    names = [pane.line(place) for pane, place in zip(panes, places, strict=True)]
    links = [
        element("a", str(place), href=f"#{name}")
        for place, name in zip(places, names, strict=True)
        if name is not None
    ]
    return element(
        "li",
        element("strong", str(difference.element)),
        f": {explain(difference)} ",
        element("small", joined(*links, between=" ")),
        id=f"d{number}",
        class_=_kind(difference),
        data_left=names[0],
        data_right=names[1],
    )


def _kind(difference: Difference) -> str:
    match difference:
        case Added() | StatementInserted():
            return "added"
        case Removed() | StatementRemoved():
            return "removed"
        case Undetermined():
            return "undetermined"
        case _:
            return "changed"


# --- the texts ----------------------------------------------------------------------------------


def _pane(prefix: str, given: SourcedModel, comparison: Comparison) -> _Pane:
    is_left = prefix == "L"
    marks: dict[tuple[str, int], str] = {}
    sources = {source.path: source for source in _sources(given)}
    for difference in comparison.differences:
        place = difference.left if is_left else difference.right
        if place is None or place.line is None:
            continue
        sources.setdefault(place.source.path, place.source)
        kind = _kind(difference)
        if kind != ("added" if is_left else "removed"):  # it is not in this text
            marks.setdefault((place.source.path, place.line), kind)
    return _Pane(prefix, tuple(sources.values()), marks)


def _sources(given: SourcedModel) -> Iterator[Source]:
    """The texts that a model was read from."""
    if given.source.text:
        yield given.source
    for node in m.walk(given.model):
        span = getattr(node, "span", NOWHERE)
        if isinstance(span, SourceSpan):
            yield span.source


def _texts(pane: _Pane) -> Markup:
    marked = {path for path, _ in pane.marks}
    parts = [
        element(
            "details",
            element("summary", source.path),
            _lines(pane, number, source),
            open=source.path in marked or len(pane.sources) == 1,
        )
        for number, source in enumerate(pane.sources)
    ]
    label = "First side" if pane.prefix == "L" else "Second side"
    return element("section", joined(*parts), tabindex="0", aria_label=label)


def _lines(pane: _Pane, number: int, source: Source) -> Markup:
    rows = [
        element(
            "tr",
            element("th", str(line), scope="row"),
            element("td", element("code", text or " ")),
            id=f"{pane.prefix}{number}-{line}",
            class_=pane.marks.get((source.path, line)),
        )
        for line, text in enumerate(source.text.split("\n"), start=1)
    ]
    return element("table", element("tbody", joined(*rows)))
