"""Variables over time: a line for each variable that a run changes, one below the other."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from rebsync.checker.show.data import value_of
from rebsync.checker.show.markup import Markup, element, joined, number
from rebsync.checker.trace import Trace
from rebsync.terminal import json_text

WIDTH, HEIGHT = 1000, 32
_ROOM = 4  # above and below a line
_MOST = 60  # variables that are drawn


class _Course(NamedTuple):
    """The values of a variable, each with the position of the step that gives it."""

    name: str
    values: tuple[tuple[int, str], ...]


def plots_section(trace: Trace) -> Markup:
    """The section of a run. Time goes from left to right; without time, steps do.

    A value holds from the time of the step that gives it. Values that are no numbers are drawn in
    the order in which they first come.
    """
    courses = list(_courses(trace))
    changing = [each for each in courses if len(each.values) > 1]
    constant = [f"{each.name} = {each.values[0][1]}" for each in courses if len(each.values) == 1]
    times = _places(trace)
    rows = [_row(each, times) for each in changing[:_MOST]]
    said = [] if rows else [element("p", "No variable changes in this run.", class_="quiet")]
    if len(changing) > _MOST:
        said.append(element("p", f"and {len(changing) - _MOST} more variables", class_="quiet"))
    if constant:
        said.append(element("p", f"Never changed: {', '.join(constant)}.", class_="quiet"))
    return element(
        "div",
        element("table", element("caption", "Variables over time"), *_axis(times, bool(rows)),
                element("tbody", joined(*rows)), class_="plotted") if rows else None,
        *said,
        class_="pane plots view-plots",
        tabindex="0",
        role="group",
        aria_label="Plots",
        data_begin=repr(times[0]),
        data_end=repr(times[-1]),
        data_by=("time" if _is_timed(trace) else "step"),
    )  # fmt: skip


def _is_timed(trace: Trace) -> bool:
    return trace.steps[-1].time > trace.steps[0].time


def _places(trace: Trace) -> list[int]:
    """Where each step is from left to right: at its time, or its position where no time passes."""
    if _is_timed(trace):
        return [step.time for step in trace.steps]
    return list(range(len(trace.steps)))


def _courses(trace: Trace) -> Iterator[_Course]:
    values: dict[tuple[int, int], list[tuple[int, str]]] = {}
    names: dict[tuple[int, int], str] = {}
    for position, step in enumerate(trace.steps):
        for rebec_number, rebec in enumerate(step.rebecs):
            for variable_number, (name, value) in enumerate(rebec.variables):
                key = rebec_number, variable_number
                names.setdefault(key, f"{rebec.name}.{name}")
                known = values.setdefault(key, [])
                if not known or known[-1][1] != value:
                    known.append((position, value))
    for key in sorted(values):
        yield _Course(names[key], tuple(values[key]))


def _row(course: _Course, times: Sequence[int]) -> Markup:
    heights, labels = _heights([value for _, value in course.values])
    least, most = labels
    drawn = element(
        "svg",
        element("path", d=_line(course, heights, times)),
        element("line", class_="cursor", x1=WIDTH, x2=WIDTH, y1=0, y2=HEIGHT),
        viewBox=f"0 0 {WIDTH} {HEIGHT}",
        preserveAspectRatio="none",
        role="img",
        aria_label=f"{course.name}: from {least} to {most}",
    )
    changes = json_text([list(each) for each in course.values])
    return element(
        "tr",
        element("th", course.name, scope="row"),
        element("td", element("span", most), element("span", least), class_="range"),
        element("td", drawn, class_="line"),
        element("td", course.values[-1][1], class_="value"),
        data_changes=changes,
    )


def _axis(times: Sequence[int], wanted: bool) -> list[Markup]:
    if not wanted:
        return []
    ends = [element("span", f"{times[0]:,}"), element("span", f"{times[-1]:,}")]
    cells = [
        element("td", element("span", class_="unit")),
        element("td"),
        element("td", *ends, class_="ends"),
        element("td"),
    ]
    return [element("thead", element("tr", *cells))]


def _heights(values: Sequence[str]) -> tuple[dict[str, float], tuple[str, str]]:
    """How high each value is drawn, from 0 to 1; and the lowest and the highest one."""
    distinct = list(dict.fromkeys(values))
    known = {text: value_of(text) for text in distinct}
    numbers = {
        text: float(value)
        for text, value in known.items()
        if isinstance(value, int | float) and math.isfinite(float(value))
    }
    ranks = (
        numbers
        if len(numbers) == len(distinct)
        else dict(zip(distinct, map(float, range(len(distinct))), strict=True))
    )
    least, most = min(ranks, key=ranks.__getitem__), max(ranks, key=ranks.__getitem__)
    low, span = ranks[least], ranks[most] - ranks[least] or 1.0
    return {text: (rank - low) / span for text, rank in ranks.items()}, (least, most)


def _line(course: _Course, heights: dict[str, float], times: Sequence[int]) -> str:
    begin, span = times[0], times[-1] - times[0] or 1
    parts: list[str] = []
    for position, value in course.values:
        x = number((times[position] - begin) / span * WIDTH)
        y = number(HEIGHT - _ROOM - heights[value] * (HEIGHT - 2 * _ROOM))
        parts.append(f"H{x}V{y}" if parts else f"M{x},{y}")
    return "".join(parts) + f"H{WIDTH}"
