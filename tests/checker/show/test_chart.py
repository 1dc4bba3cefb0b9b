"""Message sequence charts: valid, complete, the same each time, and nothing covers a text."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from itertools import combinations
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import pytest

from rebsync.checker.show.chart import chart
from rebsync.checker.show.chart_layout import chart_of
from rebsync.checker.show.flights import departures, flights, lanes
from rebsync.checker.show.pieces import columns
from rebsync.checker.trace import Trace
from tests.checker.show.runs import Recorder, crossing, lasso, long_run

SVG = "{http://www.w3.org/2000/svg}"
RUNS = {
    "crossing": crossing(),
    "lasso": lasso(),
    "two": long_run(2, 100, seed=3),
    "five": long_run(5, 30, seed=1),
    "twelve": long_run(12, 100, seed=2),
}
every_run = pytest.mark.parametrize("trace", RUNS.values(), ids=RUNS)


@dataclass(frozen=True)
class Box:
    """A rectangle."""

    left: float
    top: float
    right: float
    bottom: float
    text: str = ""

    def meets(self, other: Box) -> bool:
        """Whether the rectangles overlap."""
        across = self.left < other.right and other.left < self.right
        return across and self.top < other.bottom and other.top < self.bottom


def drawn(trace: Trace, ending: str | None = None) -> Element:
    """The parsed drawing of a run."""
    return ElementTree.fromstring(chart(trace, ending))


def text_boxes(svg: Element) -> list[Box]:
    """The rectangles of all texts that stand upright."""
    boxes = []
    for text in svg.iter(f"{SVG}text"):
        if text.get("transform"):
            continue
        words, kind = text.text or "", text.get("class")
        wide = columns(words) * 6.75
        x, y = float(text.get("x", "")), float(text.get("y", ""))
        left = {"head": x - wide / 2, "time": x - wide, "number": x - wide}.get(kind or "", x)
        boxes.append(Box(left, y - 9, left + wide, y + 2.5, words))
    return boxes


@every_run
def test_texts_do_not_cover_each_other(trace: Trace) -> None:
    for one, other in combinations(text_boxes(drawn(trace, "Safe is false")), 2):
        assert not one.meets(other), (one, other)


@every_run
def test_level_lines_do_not_strike_texts_out(trace: Trace) -> None:
    svg = drawn(trace)
    texts = text_boxes(svg)
    for path in svg.iter(f"{SVG}path"):
        if path.get("class") != "way":
            continue
        points = re.findall(r"([-\d.]+),([-\d.]+)", path.get("d", ""))
        (x1, y1), (x2, y2) = ((float(x), float(y)) for x, y in points[:2])
        if y1 == y2:
            line = Box(min(x1, x2), y1 - 0.5, max(x1, x2), y1 + 0.5)
            assert not any(line.meets(text) for text in texts)


@every_run
def test_texts_stay_inside(trace: Trace) -> None:
    svg = drawn(trace, "a long explanation " * 20)
    width, height = float(svg.get("width", "")), float(svg.get("height", ""))
    for box in text_boxes(svg):
        assert 0 <= box.left <= box.right <= width
        assert 0 <= box.top <= box.bottom <= height


@every_run
def test_every_step_and_message_is_there(trace: Trace) -> None:
    svg = drawn(trace)
    steps = [g for g in svg.iter(f"{SVG}g") if "step" in g.get("class", "").split()]
    assert [g.get("data-step") for g in steps] == [str(s.number) for s in trace.steps]
    ways = [g for g in svg.iter(f"{SVG}g") if g.get("class") == "flight"]
    assert len(ways) == sum(len(departures(step)) for step in trace.steps)
    taken = sorted(int(g.get("data-taken", "")) for g in ways if g.get("data-taken"))
    assert taken == [step.number for step in trace.steps if step.kind == "take"]


@every_run
def test_a_drawing_is_the_same_each_time(trace: Trace) -> None:
    assert chart(trace) == chart(trace)


@every_run
def test_messages_do_not_go_up(trace: Trace) -> None:
    for way in chart_of(trace).ways:
        heights = [y for _, y in way.path]
        assert heights == sorted(heights)
        if way.lane is not None:
            assert way.lane[2] >= way.lane[1] >= heights[0]


def test_a_message_falls_only_when_time_passes() -> None:
    chart = chart_of(crossing())
    for way in chart.ways:
        at_once = way.flight.message.arrival == chart.rows[way.flight.sent].row.step.time
        assert at_once == (way.path[0][1] == way.path[-1][1])


def test_a_rebec_is_busy_until_it_goes_on() -> None:
    chart = chart_of(crossing())
    assert chart.busy == ((1, chart.rows[6].bottom, chart.rows[9].top),)


def test_a_rebec_that_runs_whole_is_busy_until_its_time() -> None:
    run = Recorder({"a": {}, "b": {}}, semantics="ftts")
    run.start(run.message("a", "a", "m", {}, 0, None), run.message("b", "b", "m", {}, 2, None))
    run.take("a", run.message("a", "a", "m", {}, 9, None), delay=5)
    run.pass_time(2)
    run.take("b", run.message("b", "b", "m", {}, 3, None))
    run.pass_time(5)
    run.take("b")
    chart = chart_of(run.trace())
    ((column, start, end),) = chart.busy
    assert (column, start) == (0, chart.rows[1].bottom)
    assert chart.rows[4].bottom <= end <= chart.rows[5].top


def test_the_failing_step_is_red() -> None:
    svg = drawn(crossing())
    wrong = [g for g in svg.iter(f"{SVG}g") if g.get("class") == "step wrong"]
    assert [g.get("data-step") for g in wrong] == ["10"]
    assert "failure" in [t.get("class") for t in wrong[0].iter(f"{SVG}text")]
    assert not [g for g in drawn(lasso()).iter(f"{SVG}g") if g.get("class") == "step wrong"]


def test_a_violated_property_is_told_below() -> None:
    svg = drawn(crossing(failing=False), "Safe is false")
    assert "Safe is false" in [t.text for t in svg.iter(f"{SVG}text")]
    assert [g.get("data-step") for g in svg.iter(f"{SVG}g") if g.get("class") == "step wrong"] == [
        "9"
    ]


def test_a_loop_has_its_bracket() -> None:
    (bracket,) = [g for g in drawn(lasso()).iter(f"{SVG}g") if g.get("class") == "repeats"]
    assert bracket[0].text == "the run repeats for ever after step 2"
    chart = chart_of(lasso())
    heights = [float(y) for y in re.findall(r",([\d.]+)H", bracket[1].get("d", ""))]
    assert heights == [chart.rows[-1].bottom]
    assert f"V{chart.rows[2].bottom:g}" in bracket[1].get("d", "")


def test_a_loop_of_no_steps_has_a_bracket_too() -> None:
    run = Recorder({"a": {}})
    run.start()
    assert "repeats for ever after step 0" in chart(run.trace(loop=0))


def test_it_can_be_read_aloud() -> None:
    svg = drawn(crossing())
    assert svg.get("role") == "img"
    said = {e.get("id"): e.text for e in svg if e.get("id")}
    assert list(said) == svg.get("aria-labelledby", "").split()
    assert said["chart-desc"] == (
        "11 steps of controller, left, right. an assertion fails: one <at> a time."
    )


def test_hard_texts_are_escaped() -> None:
    trace = crossing()
    names = replace(trace, model='<a>&"\x00.rebeca')
    (title, *_) = drawn(names)
    assert title.text == r'Message sequence chart of <a>&"\x00.rebeca'


def test_it_stands_on_light_and_on_dark() -> None:
    svg = chart(crossing())
    light, dark = svg.split("@media screen and (prefers-color-scheme:dark)")
    assert ".msc .back{fill:#ffffff}" in light
    assert ".msc .back{fill:#15191e}" in dark
    assert not re.search(r"url\(|href|<script|https?://(?!www\.w3\.org/2000/svg)", svg)


# --- ways of messages --------------------------------------------------------------------------


def test_of_equal_messages_the_first_is_taken_first() -> None:
    run = Recorder({"a": {}, "b": {}})
    twice = run.message("a", "b", "m", {}, 0, None)
    run.start(run.message("a", "a", "go", {}, 0, None))
    run.take("a", twice, twice)
    run.take("b")
    run.take("b")
    assert [f.taken for f in flights(run.trace())] == [1, 2, 3]


def test_a_start_that_tells_no_messages_has_those_of_the_bags() -> None:
    trace = crossing()
    silent = replace(trace.steps[0], sent=())
    told = replace(trace, steps=(silent, *trace.steps[1:]))
    assert [(f.message.receiver, f.taken) for f in flights(told)][:2] == [("left", 1), ("right", 4)]


def test_lanes_are_shared_one_after_the_other() -> None:
    assert lanes([(0, 5), (1, 2), (3, 9), (6, 7), (6, 8)]) == [0, 1, 1, 0, 2]
