"""Message sequence charts as SVG: one lifeline for each rebec, time from top to bottom."""

from __future__ import annotations

from textwrap import wrap

from rebsync.checker.show import words
from rebsync.checker.show.chart_layout import (
    BOX,
    GUTTER,
    HEAD,
    TEXT,
    Chart,
    Placed,
    Way,
    chart_of,
)
from rebsync.checker.show.chart_rows import CELL, LINE, width_of
from rebsync.checker.show.chart_style import STYLE
from rebsync.checker.show.markup import Markup, element, joined, number
from rebsync.checker.trace import Trace, TraceStep

LEGEND = (
    "line: a message under way; dots: it waits; arrow: it is taken; "
    "box: a body runs; pale box: busy with a delay"
)


def chart(trace: Trace, ending: str | None = None) -> str:
    """A run as an SVG file; `ending` is what is wrong after its last step."""
    layout = chart_of(trace)
    drawn = element("style", Markup(STYLE)), _background(), *parts(trace, layout, ending)
    return _svg(trace, layout, ending, "chart", *drawn) + "\n"


def chart_inside(trace: Trace, ending: str | None, name: str) -> Markup:
    """A run as part of a page that has the style; `name` is unique in the page.

    The names of the rebecs, and the numbers and times of the steps, stand in drawings of their own,
    to stay when the chart moves.
    """
    layout = chart_of(trace)
    heads = element(
        "svg",
        joined(_background(), *(_head(layout, column) for column in range(len(layout.names)))),
        class_="msc",
        width=layout.width,
        height=HEAD - 4,
        aria_hidden="true",
    )
    drawn = _svg(trace, layout, ending, name, *parts(trace, layout, ending))
    gutter = element("div", _gutter(layout), class_="gutter")
    return element(
        "div", joined(gutter, element("div", heads, class_="heads"), drawn), class_="drawn"
    )


def _gutter(layout: Chart) -> Markup:
    """The numbers and times at the left of a chart."""
    rows = [
        element(
            "g",
            element("rect", class_="beside", width="100%", y=p.top, height=p.row.height),
            element("text", str(p.row.step.number), class_="number", x=36, y=p.top + LINE + 1),
            data_step=str(p.row.step.number),
        )
        for p in layout.rows
    ]
    times = [
        joined(
            element("line", class_="time", x1=14, y1=y, x2=GUTTER, y2=y),
            element("text", f"{time:,}", class_="time", x=GUTTER - 14, y=y + 20),
        )
        for time, y in layout.bands
    ]
    return element(
        "svg",
        joined(_background(), *rows, *times),
        class_="msc",
        width=GUTTER - 8,
        height=layout.height - LINE,
        aria_hidden="true",
    )


def parts(trace: Trace, layout: Chart, ending: str | None) -> list[Markup]:
    """Everything in a chart, from back to front."""
    last = trace.steps[-1]
    wrong = last.number if ending is not None or last.failure is not None else -1
    return [
        *(_band(placed, layout, wrong) for placed in layout.rows),
        *(_time(time, y, layout) for time, y in layout.bands),
        element("text", "step", class_="number", x=36, y=22),
        element("text", "time", class_="number", x=GUTTER - 14, y=22),
        *(_lifeline(layout, column) for column in range(len(layout.names))),
        *(_head(layout, column) for column in range(len(layout.names))),
        *(_busy(layout, column, start, end) for column, start, end in layout.busy),
        *(_way(way, trace) for way in layout.ways),
        *(_step(placed, layout, wrong) for placed in layout.rows),
        *_loop(trace, layout),
        *_foot(layout, ending),
    ]


def _svg(trace: Trace, layout: Chart, ending: str | None, name: str, *drawn: Markup) -> Markup:
    foot = len(_foot_lines(layout, ending)) * LINE
    width, height = layout.width, layout.height + foot
    return element(
        "svg",
        joined(
            element("title", f"Message sequence chart of {trace.model}", id=f"{name}-title"),
            element("desc", _description(trace, ending), id=f"{name}-desc"),
            *drawn,
        ),
        xmlns="http://www.w3.org/2000/svg",
        class_="msc",
        viewBox=f"0 0 {number(width)} {number(height)}",
        width=width,
        height=height,
        role="img",
        aria_labelledby=f"{name}-title {name}-desc",
    )


def _description(trace: Trace, ending: str | None) -> str:
    names = ", ".join(rebec.name for rebec in trace.steps[0].rebecs)
    said = f"{words.counted(len(trace.steps), 'step')} of {names}."
    if trace.loop is not None:
        said += f" The run repeats after step {trace.loop}."
    wrong = ending or trace.steps[-1].failure
    return f"{said} {wrong}." if wrong else said


def _background() -> Markup:
    return element("rect", class_="back", width="100%", height="100%")


# --- behind the steps --------------------------------------------------------------------------


def _band(placed: Placed, layout: Chart, wrong: int) -> Markup:
    """The row of a step, to be pointed at."""
    step = placed.row.step
    return element(
        "rect",
        class_="row wrong" if step.number == wrong else "row",
        data_step=str(step.number),
        x=0,
        y=placed.top,
        width=layout.width,
        height=placed.row.height,
    )


def _time(time: int, y: float, layout: Chart) -> Markup:
    line = element("line", class_="time", x1=14, y1=y, x2=layout.width - 20, y2=y)
    label = element("text", f"{time:,}", class_="time", x=GUTTER - 14, y=y + 20)
    return element("g", element("title", f"time {time}"), line, label)


def _lifeline(layout: Chart, column: int) -> Markup:
    x = layout.lifelines[column]
    return element("line", class_="life", x1=x, y1=HEAD - 8, x2=x, y2=layout.height - 8)


def _head(layout: Chart, column: int) -> Markup:
    x, name = layout.lifelines[column], layout.names[column]
    half = width_of(name) / 2 + 9
    return element(
        "g",
        element("rect", class_="head", x=x - half, y=6, width=2 * half, height=24, rx=3),
        element("text", name, class_="head", x=x, y=22),
    )


def _busy(layout: Chart, column: int, start: float, end: float) -> Markup:
    x = layout.lifelines[column] - BOX
    title = element("title", f"{layout.names[column]} is busy")
    drawn = element("rect", class_="busy", x=x, y=start, width=2 * BOX, height=end - start)
    return element("g", title, drawn)


def _way(way: Way, trace: Trace) -> Markup:
    """The line of a message: under way, then waiting, then taken or not."""
    flight = way.flight
    sent = trace.steps[flight.sent]
    taken = trace.steps[flight.taken] if flight.taken is not None else None
    lines = [element("path", class_="way", d=_path(way.path))]
    if way.lane is not None:
        x, start, end = way.lane
        if end > start:
            lines.append(element("path", class_="waits", d=_path(((x, start), (x, end)))))
    if way.head is not None and way.lane is not None:
        (x, y), lane = way.head, way.lane[0]
        lines.append(element("path", class_="way", d=_path(((lane, y), (x - 6, y)))))
        lines.append(element("path", class_="tip", d=f"{_path(((x, y), (x - 8, y - 4)))}v8z"))
    else:
        x, y = way.path[-1] if way.lane is None else (way.lane[0], way.lane[2])
        lines.append(element("circle", class_="open", cx=x, cy=y, r=3))
    return element(
        "g",
        element("title", _told(sent, taken, way)),
        *lines,
        class_="flight",
        data_sent=str(sent.number),
        data_taken=str(taken.number) if taken is not None else None,
    )


def _told(sent: TraceStep, taken: TraceStep | None, way: Way) -> str:
    message = way.flight.message
    end = f"taken in step {taken.number}" if taken is not None else "not taken"
    return (
        f"{message.receiver}.{words.named_call(message)} from {message.sender}"
        f"{words.times(message, sent.time)}: sent in step {sent.number}, {end}"
    )


def _path(points: tuple[tuple[float, float], ...]) -> str:
    return "M" + "L".join(f"{number(x)},{number(y)}" for x, y in points)


# --- steps -------------------------------------------------------------------------------------


def _step(placed: Placed, layout: Chart, wrong: int) -> Markup:
    row, top = placed.row, placed.top
    step = row.step
    drawn = [
        element("title", _tooltip(step)),
        element("text", str(step.number), class_="number", x=36, y=top + LINE + 1),
        *_boxes(placed, layout),
    ]
    if row.notes is not None:
        drawn.append(_note(placed, layout))
    for text in row.texts:
        x = GUTTER if text.column < 0 else layout.lifelines[text.column] + TEXT
        drawn.append(element("text", text.text, class_=text.kind, x=x, y=top + text.y))
    kind = "step wrong" if step.number == wrong else "step"
    return element("g", *drawn, class_=kind, data_step=str(step.number))


def _boxes(placed: Placed, layout: Chart) -> list[Markup]:
    """The box of the body that runs; at the start, of every constructor."""
    row = placed.row
    if row.step.kind == "time":
        return []
    columns = [row.column] if row.column >= 0 else range(len(layout.names))
    top = placed.top + (4 if row.column >= 0 else LINE + 5)
    return [
        element(
            "rect",
            class_="body",
            x=layout.lifelines[column] - BOX,
            y=top,
            width=2 * BOX,
            height=max(placed.bottom - top, 3),
        )
        for column in columns
    ]


def _note(placed: Placed, layout: Chart) -> Markup:
    """The paper behind what changed."""
    assert placed.row.notes is not None
    start, end = placed.row.notes
    wide = max(width_of(t.text) for t in placed.row.texts if t.kind == "note")
    x = layout.lifelines[placed.row.column] + TEXT - 4
    return element(
        "rect", class_="paper", x=x, y=placed.top + start, width=wide + 8, height=end - start, rx=2
    )


def _tooltip(step: TraceStep) -> str:
    head = f"step {step.number}, time {step.time}: {words.heading(step)}"
    changed = [f"{c.rebec}.{words.difference(c)}" for c in step.changes]
    place = [f"line {step.line}"] if step.line else []
    return "\n".join([head, *place, *changed, *([step.failure] if step.failure else [])])


# --- below and beside --------------------------------------------------------------------------


def _loop(trace: Trace, layout: Chart) -> list[Markup]:
    """A bracket around the steps that repeat for ever."""
    if trace.loop is None:
        return []
    before = [p for p in layout.rows if p.row.step.number <= trace.loop]
    start, end = before[-1].bottom, layout.rows[-1].bottom
    if end <= start:
        start = before[-1].top
    x = layout.width - 14
    bracket = f"M{number(x - 10)},{number(end)}H{number(x)}V{number(start)}H{number(x - 10)}"
    tip = f"M{number(x - 12)},{number(start)}l8,-4v8z"
    middle = (start + end) / 2
    words_at = f"rotate(90 {number(x + 4)} {number(middle)})"
    label = element("text", "repeats", class_="loop", x=x + 4, y=middle, transform=words_at)
    title = element("title", f"the run repeats for ever after step {trace.loop}")
    drawn = (element("path", class_="loop", d=d) for d in (bracket, tip))
    return [element("g", title, *drawn, label, class_="repeats")]


def _foot_lines(layout: Chart, ending: str | None) -> list[tuple[str, str]]:
    wide = int((layout.width - 40) / CELL)
    wrong = [("failure", text) for text in wrap(ending, wide)] if ending else []
    return [*wrong, *(("legend", text) for text in wrap(LEGEND, wide))]


def _foot(layout: Chart, ending: str | None) -> list[Markup]:
    return [
        element("text", text, class_=kind, x=20, y=layout.height + LINE * line + 6)
        for line, (kind, text) in enumerate(_foot_lines(layout, ending))
    ]
