"""The movement of robots in a real browser: playing, stepping, the slider, keys, light and dark."""

from __future__ import annotations

import json
import re
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from rebsync.checker.movement.ways import Movement
from rebsync.checker.show.data import trace_json
from rebsync.checker.show.movement import movement_section
from rebsync.checker.show.movement_board import Board, drawing
from rebsync.checker.show.movement_data import frames, scene
from rebsync.checker.show.page import trace_page
from rebsync.checker.show.page_run import RunDetails
from rebsync.checker.trace import Trace
from rebsync.files import read_source
from tests.checker.movement.moving import EXAMPLES, analysed, example_run, moved, run_of
from tests.checker.show.browser import Browser
from tests.checker.show.test_data import SCHEMA
from tests.checker.show.test_page import LEAST_CONTRAST

UNSAFE = EXAMPLES / "experiment2_unsafe" / "experiment2_unsafe.rebeca"
TAB, SPACE, RIGHT = "\ue004", " ", "\ue014"
STATE = """
    const run = document.querySelector('.run.on');
    const root = run.querySelector('.movement');
    const board = root.querySelector('.board').getBoundingClientRect();
    const cell = Number(root.querySelector('.board').dataset.cell);
    const scale = board.width / root.querySelector('.board').viewBox.baseVal.width;
    const middle = (part) => {
        const box = part.getBoundingClientRect();
        return [box.left + box.width / 2 - board.left, box.top + box.height / 2 - board.top];
    };
    const zero = ['x', 'y'].map((name) => Number(root.querySelector('.board').dataset[name]));
    return {
        time: Number(root.dataset.time),
        step: Number(root.dataset.step),
        slider: Number(run.querySelector('.time').value),
        clock: run.querySelector('.clock').textContent,
        button: run.querySelector('[data-act=play]').textContent,
        row: document.querySelector('.states tr.on').dataset.step,
        chart: document.querySelector('.msc .row.on').dataset.step,
        drawn: [...root.querySelectorAll('.disc')].map(middle).map(([x, y]) => (
            [(x / scale - zero[0]) / cell, (zero[1] - y / scale) / cell])),
        clash: !root.querySelector('.clash').hasAttribute('hidden'),
        meets: root.querySelectorAll('.robot.meets').length,
        values: [...root.querySelectorAll('.robots tr')].map((row) => (
            Object.fromEntries([...row.querySelectorAll('.value')].map((value) => (
                [value.firstChild.textContent.trim(), value.querySelector('b').textContent]))))),
        places: [...root.querySelectorAll('.robots .place')].map((place) => place.textContent),
    };
"""


@pytest.fixture(scope="module")
def unsafe() -> tuple[Trace, Movement]:
    """A run of the robots that collide at 5."""
    _, trace, movement = example_run("experiment2_unsafe", 0, 60)
    return trace, movement


@pytest.fixture
def page(unsafe: tuple[Trace, Movement], tmp_path: Path) -> Path:
    """The page of that run."""
    path = tmp_path / "page.html"
    trace, movement = unsafe
    text = trace_page(trace, read_source(str(UNSAFE)), RunDetails(lambda _: movement))
    path.write_text(text, encoding="utf-8")
    return path


def state(chromium: Browser) -> dict[str, Any]:
    """What the drawing shows."""
    found: dict[str, Any] = chromium.run(STATE)
    return found


def agrees(shown: dict[str, Any], unsafe: tuple[Trace, Movement]) -> None:
    """The drawing shows the robots where they are at its time, and the values of its step."""
    trace, movement = unsafe
    for place, way in enumerate(movement.ways):
        pose = way.at(shown["time"])
        assert shown["drawn"][place] == pytest.approx((pose.x, pose.y), abs=0.02)
        rebec = next(r for r in trace.steps[shown["step"]].rebecs if r.name == way.robot)
        assert shown["values"][place] == dict(rebec.variables)
    assert shown["row"] == shown["chart"] == str(shown["step"])
    assert f"step {shown['step']}" in shown["clock"]


def test_it_opens_where_the_page_does(
    chromium: Browser, page: Path, unsafe: tuple[Trace, Movement]
) -> None:
    chromium.open(page)
    shown = state(chromium)
    last = unsafe[0].steps[-1]
    assert (shown["step"], shown["time"]) == (last.number, last.time)
    agrees(shown, unsafe)


@pytest.mark.parametrize("width", [1600, 800])
def test_steps_go_forward_and_back(
    chromium: Browser, page: Path, unsafe: tuple[Trace, Movement], width: int
) -> None:
    chromium.resize(width, 1000)
    chromium.open(page, "#v1-s0")
    if width == 800:  # there is room for one part of the page
        chromium.click("[data-view=movement]")
    for step in range(1, 20):
        chromium.click(".run.on [data-act=forward]")
        shown = state(chromium)
        assert (shown["step"], shown["time"]) == (step, unsafe[0].steps[step].time)
        agrees(shown, unsafe)
    chromium.click(".run.on [data-act=back]")
    shown = state(chromium)
    assert shown["step"] == 18
    agrees(shown, unsafe)
    chromium.resize(1700, 1000)


def test_a_step_of_the_page_is_one_of_the_drawing(
    chromium: Browser, page: Path, unsafe: tuple[Trace, Movement]
) -> None:
    chromium.open(page, "#v1-s0")
    chromium.press(*"jjjjjjjj")
    assert state(chromium)["step"] == 8
    chromium.click(".msc .row[data-step='20']")
    shown = state(chromium)
    assert shown["step"] == 20
    agrees(shown, unsafe)


def test_it_plays_to_the_end_and_again_from_the_start(
    chromium: Browser, page: Path, unsafe: tuple[Trace, Movement]
) -> None:
    chromium.open(page, "#v1-s0")
    chromium.run("document.querySelector('.speed').value = '10'")
    chromium.click("[data-act=play]")
    assert state(chromium)["button"] == "Pause"
    shown = chromium.until(state, lambda s: s["button"] == "Play")
    assert shown["time"] == unsafe[1].end
    assert shown["step"] == unsafe[0].steps[-1].number
    chromium.click("[data-act=play]")
    assert chromium.until(state, lambda s: 0 < s["time"] < 3)["button"] == "Pause"
    chromium.press("p")
    shown = state(chromium)
    assert shown["button"] == "Play"
    agrees(shown, unsafe)


def test_robots_are_between_cells_while_time_passes(
    chromium: Browser, page: Path, unsafe: tuple[Trace, Movement]
) -> None:
    chromium.open(page, "#v1-s0")
    chromium.press("p")
    between = chromium.until(state, lambda s: 1.1 < s["time"] < 1.9)
    chromium.press("p")
    paused = state(chromium)
    assert 0.05 < between["drawn"][0][0] < 0.95
    agrees(paused, unsafe)
    time.sleep(0.3)
    assert state(chromium) == paused


def test_the_slider_goes_to_any_time(
    chromium: Browser, page: Path, unsafe: tuple[Trace, Movement]
) -> None:
    chromium.open(page, "#v1-s0")
    slide = """
        const slider = document.querySelector('.time');
        slider.value = arguments[0];
        slider.dispatchEvent(new Event('input', {bubbles: true}));
    """
    for at in (0.5, 1.25, 4.75, 5, 5.75, 2):
        chromium.run(slide, at)
        shown = state(chromium)
        assert shown["time"] == at
        steps = [s.number for s in unsafe[0].steps if s.time <= at]
        assert shown["step"] == steps[-1]
        agrees(shown, unsafe)
        assert shown["clash"] == (4.5 <= at <= 5.5)
        assert shown["meets"] == (2 if 4.5 <= at <= 5.5 else 0)


def test_a_collision_can_be_gone_to(chromium: Browser, page: Path) -> None:
    chromium.open(page, "#v1-s0")
    assert not state(chromium)["clash"]
    chromium.click(".encounters button")
    shown = state(chromium)
    assert (shown["time"], shown["clash"]) == (5, True)
    assert shown["places"] == ["(2, 2)", "(2, 2)"]


def test_it_works_by_keyboard(chromium: Browser, page: Path) -> None:
    chromium.open(page, "#v1-s0")
    order = []
    chromium.run("document.querySelector('.views button:last-child').focus()")
    for _ in range(8):
        chromium.press(TAB)
        order.append(chromium.run("return document.activeElement.dataset.act || "
                                  "document.activeElement.className"))  # fmt: skip
        if order[-1] == "forward":
            chromium.press(SPACE)
            assert state(chromium)["step"] == 1
        if order[-1] == "time":
            before = state(chromium)["time"]
            chromium.press(RIGHT)
            assert state(chromium)["time"] > before
    assert order[:7] == ["first", "back", "play", "forward", "last", "time", "speed"]


def test_texts_can_be_told_from_their_background(chromium: Browser, page: Path) -> None:
    for scheme in ("light", "dark"):
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        emulated = {"cmd": "Emulation.setEmulatedMedia", "params": {"features": features}}
        chromium.command("POST", "goog/cdp/execute", emulated)
        chromium.open(page)
        chromium.click(".encounters button")
        assert chromium.run(LEAST_CONTRAST) >= 4.5, scheme


def test_nothing_sticks_out(chromium: Browser, page: Path) -> None:
    for width in (1600, 800, 500):
        chromium.resize(width, 1000)
        chromium.open(page)
        wide = chromium.run("return document.documentElement.scrollWidth - innerWidth")
        assert wide <= 0, width
    chromium.resize(1700, 1000)


def test_without_scripts_the_ways_are_seen(chromium: Browser, page: Path) -> None:
    text = re.sub(r"<script>.*?</script>", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    page.write_text(text, encoding="utf-8")
    chromium.open(page)
    assert chromium.run("return document.querySelectorAll('.board .path').length") == 2
    assert chromium.run("return document.querySelector('.board').checkVisibility()")
    assert not chromium.run("return document.querySelector('.controls').checkVisibility()")


def test_it_loads_nothing(chromium: Browser, page: Path) -> None:
    chromium.open(page)
    assert chromium.run("return performance.getEntriesByType('resource').length") == 0


# --- data --------------------------------------------------------------------------------------


def test_json_has_the_movement_and_keeps_to_the_schema(unsafe: tuple[Trace, Movement]) -> None:
    import jsonschema  # type: ignore[import-untyped]

    trace, movement = unsafe
    data = json.loads(trace_json(trace, lambda _: movement))
    run = {**SCHEMA, "$ref": "#/$defs/run"}
    for key in ("required", "properties", "additionalProperties"):
        del run[key]
    jsonschema.Draft202012Validator(run).validate(data)
    robots = data["movement"]["robots"]
    assert [robot["name"] for robot in robots] == ["robot1", "robot2"]
    assert robots[0]["start"] == {"x": 0, "y": 2, "from": ["pos[0]", "pos[1]"]}
    assert robots[0]["path"][:3] == [
        {"time": 0, "x": 0, "y": 2, "heading": 0},
        {"time": 1, "x": 0, "y": 2, "heading": 0},
        {"time": 2, "x": 1, "y": 2, "heading": 0},
    ]
    assert data["movement"]["encounters"][0]["robots"] == ["robot1", "robot2"]


def test_a_scene_says_every_value_of_every_step(unsafe: tuple[Trace, Movement]) -> None:
    trace, movement = unsafe
    data = scene(movement, frames(trace))
    values: dict[tuple[int, int], str] = {}
    changes = data["changes"]
    for position, step in enumerate(trace.steps):
        values.update({(r, v): value for at, r, v, value in changes if at == position})
        for robot, way in enumerate(movement.ways):
            rebec = next(r for r in step.rebecs if r.name == way.robot)
            assert [values[robot, n] for n in range(len(rebec.variables))] == [
                value for _, value in rebec.variables
            ]


def test_names_and_values_stay_texts() -> None:
    text = "@Robot reactiveclass R(2) { R() { self.go(); } msgsrv go() { @Move(X+1, Y); } } "
    problem = analysed(text + "main { R r():(); }")
    trace = run_of(problem)
    section = movement_section(moved(problem, trace), frames(trace), "v</script>")
    assert section.count("</script>") == 1


@pytest.mark.parametrize("far", [1, 30, 2000])
def test_large_grounds_have_few_lines(far: int) -> None:
    text = f"""
    @Robot reactiveclass R(2) {{ R() {{ self.go(); }} msgsrv go() {{ @Move(X+{far}, Y-{far}); }} }}
    main {{ R r():(); }}
    """
    problem = analysed(text)
    movement = moved(problem, run_of(problem))
    board = Board.of(movement)
    assert (board.left, board.right, board.bottom, board.top) == (0, far, -far, 0)
    svg = drawing(movement, "b")
    assert svg.count("edge") < 60
    # Texts do not run into each other.
    marks = [float(x) for x in re.findall(r'class="axis" x="([\d.]+)" y="[\d.]+"', svg)]
    across = sorted(set(marks))
    assert all(b - a > 20 for a, b in pairwise(across[1:]))
