"""One page that shows a result or a run: charts, states and the model side by side.

It needs nothing but itself; without scripts its runs can still be read. A live page asks the
program that serves it for the runs that somebody follows.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib.resources import files

from rebsync.checker.result import Coverage, Result
from rebsync.checker.show import words
from rebsync.checker.show.branches import branches_section
from rebsync.checker.show.chart_style import STYLE
from rebsync.checker.show.markup import Markup, element, joined, metadata
from rebsync.checker.show.page_run import (
    RunDetails,
    Shown,
    run_section,
    shown_run,
    shown_violation,
)
from rebsync.checker.show.page_source import coverage_section, source_section, text_section
from rebsync.checker.trace import Trace
from rebsync.records import dataclass
from rebsync.source import Source

HELP = "Select a step: click it, or j and k or the arrow keys; p plays and pauses"
OTHER_RUNS = "; [ and ] select another run"
ALONE = RunDetails()
_MOVES = "movement.js"
_STYLES = ("colours.css", "page.css", "source.css", "playback.css", "movement.css")
# What listens to an event comes before what sends it.
_SCRIPTS = (_MOVES, "plots.js", "branches.js", "playback.js", "page.js")


def result_page(
    result: Result,
    source: Source,
    property_source: Source | None = None,
    details: RunDetails = ALONE,
) -> str:
    """The page of a verification of the model `source`."""
    runs = [shown_violation(v, source, property_source, details) for v in result.violations]
    for measure in result.measures:
        for name, extreme in (("least", measure.least), ("greatest", measure.greatest)):
            if extreme is not None:
                heading = f"{name} {measure.expression} = {words.measured(extreme)}"
                runs.append(shown_run(heading, extreme.trace, details))
        if measure.undefined is not None:
            heading = f"{measure.expression} has no value"
            runs.append(shown_run(heading, measure.undefined, details))
    if not runs and details.start is not None:
        runs.append(shown_run("The start", details.start, details))
    texts = _Texts(source, result.coverage, property_source)
    return _page(texts, _summary(result), runs, details.live)


def trace_page(trace: Trace, source: Source, details: RunDetails = ALONE) -> str:
    """The page of one run of the model `source`."""
    run = shown_run(f"Run of {words.counted(len(trace.steps), 'step')}", trace, details)
    summary = element("p", words.view_of(trace.semantics))
    return _page(_Texts(source), summary, [run], details.live)


@dataclass(frozen=True, slots=True)
class _Texts:
    """The texts beside the runs: the model with what of it never ran, and its properties."""

    source: Source
    coverage: Coverage | None = None
    properties: Source | None = None


def _page(texts: _Texts, summary: Markup, runs: Sequence[Shown], live: str | None) -> str:
    moves = any(run.movement is not None for run in runs)
    script = "".join(map(own_file, _SCRIPTS if moves else (s for s in _SCRIPTS if s != _MOVES)))
    styles = [*map(own_file, _STYLES), STYLE]
    title = texts.source.path
    aside = [source_section(texts.source, texts.coverage)]
    if texts.coverage is not None:
        aside.append(coverage_section(texts.coverage))
    if texts.properties is not None:
        aside.append(text_section(texts.properties, "Properties", "P"))
    beside = [element("div", joined(*aside), class_="texts view-model")]
    if any(run.branchings for run in runs):
        beside.insert(0, branches_section(live))
    sections = [run_section(run, number) for number, run in enumerate(runs, 1)]
    body = element(
        "body",
        joined(
            element("header", element("h1", title), summary, _tabs(runs, live), _views(runs)),
            element(
                "main",
                element("div", joined(*sections), class_="runs"),
                element("aside", joined(*beside)),
                class_=None if runs else "alone",
            ),
            element("script", Markup(script)),
        ),
        class_="hide-plots" if moves else None,
        data_only="states" if runs else "model",
    )
    head = element(
        "head",
        joined(*metadata(script, is_live=live is not None)),
        element("title", title),
        element("style", Markup("".join(styles))),
    )
    return f"<!DOCTYPE html>\n{element('html', head, body, lang='en')}\n"


@cache
def own_file(name: str) -> str:
    """A style or script of the pages."""
    return files("rebsync.checker.show").joinpath(name).read_text(encoding="utf-8")


# --- the head ----------------------------------------------------------------------------------


def _summary(result: Result) -> Markup:
    speed = words.rate(result.states, result.search_seconds)
    figures = [
        words.counted(result.states, "state"),
        words.counted(result.transitions, "transition"),
        f"depth {result.depth:,}",
        words.duration(result.search_seconds) + (f" ({speed:,.0f} states/s)" if speed else ""),
        words.memory(result.peak_memory_bytes),
        f"engine {result.engine}",
        words.view_of(result.semantics),
    ]
    said = [result.reason] if result.reason is not None else []
    verdict = element("strong", result.verdict, class_=f"verdict {result.verdict}")
    return joined(
        element("p", verdict, " ", ", ".join(figures)),
        *(element("p", text, class_="caveat") for text in (*said, *result.caveats)),
        _properties(result),
    )


def _properties(result: Result) -> Markup:
    rows = [
        element("li", name, " ", element("span", verdict, class_=f"verdict {verdict}"))
        for name, verdict in result.properties
    ]
    return element("ul", *rows, class_="properties") if rows else Markup("")


def _tabs(runs: Sequence[Shown], live: str | None) -> Markup:
    """Links to the runs, when there are several to choose from, or may be."""
    links = [
        element("a", run.heading, href=f"#v{number}", data_run=str(number))
        for number, run in enumerate(runs, 1)
    ]
    if len(links) + (live is not None) < 2:
        return Markup("")
    return element("nav", joined(*links), aria_label="Runs")


def _views(runs: Sequence[Shown]) -> Markup:
    """Buttons for the parts of the page, and how it is used by keys."""
    if not runs:
        return Markup("")
    names = ["Chart", "States", "Plots", "Model"]
    if any(run.movement is not None for run in runs):
        names.insert(2, "Movement")
    buttons = [
        element("button", name, type="button", data_view=name.lower(), aria_pressed="true")
        for name in names
    ]
    said = HELP + (OTHER_RUNS if len(runs) > 1 else "")
    group = element("div", *buttons, class_="views", role="group", aria_label="Shown parts")
    return element("div", group, element("p", f"{said}.", class_="help"), class_="bar")
