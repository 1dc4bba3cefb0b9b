"""One page: the recorded run beside the model's, the deviation marked, and the error of time.

It needs nothing but itself; its only script plays how the robots moved.
"""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.checker.show.chart import chart_inside
from rebsync.checker.show.chart_style import STYLE
from rebsync.checker.show.markup import Markup, element, joined, metadata
from rebsync.checker.show.movement import movement_section
from rebsync.checker.show.page import own_file
from rebsync.checker.show.page_source import source_section
from rebsync.checker.steps import Action
from rebsync.checker.trace import Change, ShownMessage, ShownRebec, Trace, TraceStep
from rebsync.conform.conformance import Conformance, Deviation, Lateness
from rebsync.conform.matching import Subject
from rebsync.conform.movement import RecordedMovement
from rebsync.conform.recording import Served
from rebsync.conform.report.text import allowed_line, lines

SHOWN = 40  # steps of each chart
_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; margin: 1.5em; }
body { color: var(--ink); background: var(--back); }
h1 { font-size: 20px; overflow-wrap: anywhere; } h2 { font-size: 17px; } a { color: var(--way); }
.movement { font-size: 14px; }
#recorded-chart { max-height: 70vh; overflow: auto; }
.sides { display: flex; gap: 2em; align-items: flex-start; flex-wrap: wrap; }
.sides > section { overflow-x: auto; max-width: 100%; }
.said { white-space: pre-wrap; font-family: monospace; overflow-wrap: anywhere; }
.verdict { padding: .1em .5em; border-radius: 3px; background: var(--raised); }
.conforms { color: var(--good); }
.deviates, .violated { color: var(--wrong); background: var(--alarm); }
#lateness, .source { overflow-x: auto; }
.plot .axis { stroke: var(--quiet); } .plot .zero { stroke: var(--rule); }
.plot circle { fill: var(--way); }
.plot circle.greatest { fill: var(--wrong); } .plot text { font-size: 12px; fill: var(--quiet); }
.heads, .gutter { display: none; } table.lines code { white-space: pre; }
.times { overflow-x: auto; } .times table { border-collapse: collapse; font-size: 13px; }
.times td, .times th { padding: 2px 8px; text-align: left; border-bottom: 1px solid var(--rule); }
table.lines { border-collapse: collapse; font-size: 13px; }
table.lines th { color: var(--quiet); font-weight: normal; text-align: right; padding-right: 1em; }
tr:target { background: var(--chosen); }
"""


def conformance_page(
    found: Conformance,
    subject: Subject,
    paths: Sequence[str],
    more: Sequence[Markup] = (),
    moved: RecordedMovement | None = None,
) -> str:
    """The page of a comparison of a recorded run with a model.

    `more` are further sections; `moved` is how the robots moved.
    """
    title = f"{subject.source.path} and {', '.join(paths)}"
    verdict = element("strong", found.verdict, class_=f"verdict {found.verdict}")
    script = own_file("movement.js") + own_file("playback.js") if moved is not None else ""
    said = element("p", "\n".join(lines(found, subject, paths)), class_="said")
    body = element(
        "body",
        joined(
            element("header", element("h1", title), element("p", verdict), said),
            *_deviation(found.deviation),
            *_movement(moved),
            _charts(found, subject),
            _plot(found.lateness),
            *more,
            source_section(subject.source, None),
            element("script", Markup(script)) if script else Markup(""),
        ),
    )
    styles = ["colours.css", "source.css", *(("playback.css", "movement.css") if script else ())]
    style = element("style", Markup("".join(map(own_file, styles)) + _STYLE + STYLE))
    head = element("head", joined(*metadata(script), element("title", title), style))
    return f"<!DOCTYPE html>\n{element('html', head, body, lang='en')}\n"


def _deviation(deviation: Deviation | None) -> list[Markup]:
    if deviation is None:
        return []
    items = [element("li", allowed_line(allowed)) for allowed in deviation.allowed]
    place = element("a", f"line {deviation.line}", href=f"#L{deviation.line}")
    about = [" (", place, " of the model)"] if deviation.line else []
    if deviation.code is not None:
        about.append(f" {deviation.code.path}:{deviation.code.line}")
    return [
        element(
            "section",
            element("h2", f"The first step that the model does not allow: {deviation.kind}"),
            element("p", deviation.message, *about),
            *([element("p", "Allowed:"), element("ul", *items)] if items else []),
            id="deviation",
        )
    ]


def _movement(moved: RecordedMovement | None) -> list[Markup]:
    if moved is None:
        return []
    return [movement_section(moved.movement, moved.frames, "recorded-run", "recorded-chart")]


# --- the charts


def _charts(found: Conformance, subject: Subject) -> Markup:
    recorded = _recorded(found, subject)
    run = found.run[-SHOWN:]
    sides = []
    if recorded.steps:
        ending = found.deviation.message if found.deviation is not None else None
        drawn = chart_inside(recorded, ending, "recorded")
        sides.append(element("section", element("h2", "Recorded"), drawn, id="recorded-chart"))
    if run:
        drawn = chart_inside(Trace(subject.source.path, "tts", run), None, "model")
        sides.append(element("section", element("h2", "A run of the model that fits"), drawn))
    return element("div", *sides, class_="sides")


def numbered(found: Conformance) -> list[tuple[int, Served]]:
    """The last recorded steps with their numbers, as they came; the one that does not fit as well.

    The steps of different rebecs pass the comparison in another order.
    """
    served = sorted(found.last, key=lambda each: each.stamp)[-SHOWN:]
    first = max(found.compared - len(served), 0) + 1
    if found.deviation is not None and found.deviation.served is not None:
        served.append(found.deviation.served)
    return list(enumerate(served, first))


def _recorded(found: Conformance, subject: Subject) -> Trace:
    before: dict[int, Served] = {}
    steps = []
    for number, each in numbered(found):
        steps.append(_step(number, each, before.get(each.rebec), subject))
        before[each.rebec] = each
    return Trace(subject.source.path, "tts", tuple(steps))


def _step(number: int, served: Served, before: Served | None, subject: Subject) -> TraceStep:
    observable = subject.observable
    name = observable.program.rebecs[served.rebec].name
    old = observable.shown(served.rebec, (before or served).cells)
    new = observable.shown(served.rebec, served.cells)
    changes = tuple(Change(name, v, old[v], text) for v, text in new.items() if old[v] != text)
    message = ShownMessage(
        served.server, (("", served.arguments),) if served.arguments else (), "", served.arrival,
        None, name,
    )  # fmt: skip
    rebecs = tuple(ShownRebec(r.name, (), ()) for r in observable.program.rebecs)
    return TraceStep(
        number, "take", served.start, served.now, name, message, (), (), changes, 0, rebecs,
        Action(served.rebec),
    )  # fmt: skip


# --- the error of time


def _plot(lateness: Lateness, width: int = 900, height: int = 220) -> Markup:
    """The time error of each step (of many, of some) over the time of the model."""
    if not lateness.points or lateness.greatest is None:
        return Markup("")
    points = [*lateness.points, lateness.greatest]
    last = max(time for time, _, _ in points) or 1
    most = max(abs(error) for _, _, error in points) or 1e-3
    left, middle = 70, height / 2

    def x(time: int) -> float:
        return left + (width - left - 20) * time / last

    def y(error: float) -> float:
        return middle - (middle - 25) * error / most

    circles = [
        element(
            "circle",
            element("title", f"{rebec} at {time}: {error:+.3f} s"),
            cx=x(time),
            cy=y(error),
            r=4 if (time, rebec, error) == lateness.greatest else 2,
            class_="greatest" if (time, rebec, error) == lateness.greatest else None,
        )
        for time, rebec, error in points
    ]
    texts = [
        element("text", f"{most:+.3f} s", x=4, y=y(most) + 4),
        element("text", f"{-most:+.3f} s", x=4, y=y(-most) + 4),
        element("text", "0", x=4, y=middle + 4),
        element("text", f"time {last}", x=width - 90, y=height - 6),
    ]
    drawn = element(
        "svg",
        element("title", "Time error of each step"),
        element("line", class_="zero", x1=left, y1=middle, x2=width - 20, y2=middle),
        element("line", class_="axis", x1=left, y1=20, x2=left, y2=height - 20),
        *circles,
        *texts,
        class_="plot",
        viewBox=f"0 0 {width} {height}",
        width=width,
        height=height,
        role="img",
    )
    return element("section", element("h2", "Time error"), drawn, id="lateness")
