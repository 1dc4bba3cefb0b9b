"""One page that shows a result or a run: charts, states and the model side by side.

It needs nothing but itself; without scripts everything in it can still be read.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib.resources import files

from rebsync.checker.movement.ways import Movement, Moving, nowhere
from rebsync.checker.result import Coverage, Result, Violation
from rebsync.checker.show import words
from rebsync.checker.show.chart import chart_inside
from rebsync.checker.show.chart_style import STYLE
from rebsync.checker.show.markup import Markup, element, joined, metadata
from rebsync.checker.show.movement import movement_section
from rebsync.checker.show.movement_data import frames
from rebsync.checker.show.page_source import coverage_section, source_section, text_section
from rebsync.checker.show.page_states import states_table
from rebsync.checker.trace import Trace
from rebsync.records import dataclass
from rebsync.source import Source

HELP = "Select a step: click it, or j and k or the arrow keys"
PLAYS = "; p plays and pauses"
OTHER_RUNS = "; [ and ] select another run"


@dataclass(frozen=True, slots=True)
class Shown:
    """A run of the page: its heading, the place that the heading is about, what is wrong.

    `movement` is that of its robots, if the model moves any.
    """

    heading: str
    trace: Trace
    movement: Movement | None
    message: str = ""
    place: str | None = None  # the target of a link in the page
    ending: str | None = None


def result_page(
    result: Result,
    source: Source,
    property_source: Source | None = None,
    moving: Moving = nowhere,
) -> str:
    """The page of a verification of the model `source`; `moving` gives the movement of runs."""
    runs = [_shown(each, source, property_source, moving) for each in result.violations]
    for measure in result.measures:
        for name, extreme in (("least", measure.least), ("greatest", measure.greatest)):
            if extreme is not None:
                heading = f"{name} {measure.expression} = {words.measured(extreme)}"
                runs.append(Shown(heading, extreme.trace, moving(extreme.trace)))
        if measure.undefined is not None:
            heading = f"{measure.expression} has no value"
            runs.append(Shown(heading, measure.undefined, moving(measure.undefined)))
    return _page(source, _summary(result), runs, result.coverage, property_source)


def trace_page(trace: Trace, source: Source, moving: Moving = nowhere) -> str:
    """The page of one run of the model `source`."""
    run = Shown(f"Run of {words.counted(len(trace.steps), 'step')}", trace, moving(trace))
    return _page(source, element("p", words.view_of(trace.semantics)), [run], None, None)


def _shown(
    violation: Violation, source: Source, properties: Source | None, moving: Moving
) -> Shown:
    trace = violation.trace
    failed = any(step.failure is not None for step in trace.steps)
    ending = None if failed or trace.loop is not None else violation.message
    place = None
    if violation.line and violation.path == source.path:
        place = f"L{violation.line}"
    elif violation.line and properties is not None and violation.path == properties.path:
        place = f"P{violation.line}"
    message = violation.message + (f": {violation.formula}" if violation.formula else "")
    return Shown(words.title(violation), trace, moving(trace), message, place, ending)


def _page(
    source: Source,
    summary: Markup,
    runs: Sequence[Shown],
    coverage: Coverage | None,
    properties: Source | None,
) -> str:
    moves = any(run.movement is not None for run in runs)
    styles = [own_file("colours.css"), own_file("page.css"), STYLE]
    scripts = [own_file("page.js")]
    if moves:
        styles.append(own_file("movement.css"))
        scripts.insert(0, own_file("movement.js"))  # it listens to the page: it comes first
    style = element("style", Markup("".join(styles)))
    script = element("script", Markup("".join(scripts)))
    aside = [source_section(source, coverage)]
    if coverage is not None:
        aside.append(coverage_section(coverage))
    if properties is not None:
        aside.append(text_section(properties, "Properties", "P"))
    body = element(
        "body",
        joined(
            element("header", element("h1", source.path), summary, _tabs(runs)),
            element(
                "main",
                element("div", joined(*map(_run, runs, range(1, len(runs) + 1))), class_="runs"),
                element("aside", joined(*aside)),
                class_=None if runs else "alone",
            ),
            script,
        ),
    )
    head = element(
        "head", joined(*metadata("".join(scripts)), element("title", source.path), style)
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


def _tabs(runs: Sequence[Shown]) -> Markup:
    """Links to the runs, when there are several to choose from."""
    links = [
        element("a", run.heading, href=f"#v{number}", data_run=str(number))
        for number, run in enumerate(runs, 1)
    ]
    if not links:
        return Markup("")
    plays = PLAYS if any(run.movement is not None for run in runs) else ""
    if len(links) == 1:
        return element("p", f"{HELP}{plays}.", class_="help")
    tabs = element("nav", joined(*links), aria_label="Runs")
    return joined(tabs, element("p", f"{HELP}{OTHER_RUNS}{plays}.", class_="help"))


# --- runs --------------------------------------------------------------------------------------


def _run(run: Shown, number: int) -> Markup:
    name = f"v{number}"
    about = [": ", run.message] if run.message else []
    if run.place is not None:
        said = f"line {run.place[1:]} of the {'model' if run.place[0] == 'L' else 'properties'}"
        about += [" (", element("a", said, href=f"#{run.place}"), ")"]
    drawn = chart_inside(run.trace, run.ending, f"{name}-chart")
    chart = element(
        "div", drawn, class_="pane chart", tabindex="0", aria_label="Chart", role="group"
    )
    table = states_table(run.trace, name, run.ending)
    states = element("div", table, class_="pane", tabindex="0", aria_label="States", role="group")
    parts = [element("h2", run.heading, *about)]
    if run.movement is not None:
        parts.append(movement_section(run.movement, frames(run.trace), name))
    return element(
        "section",
        joined(*parts, element("div", chart, states, class_="panes")),
        class_="run",
        id=name,
        data_run=str(number),
    )
