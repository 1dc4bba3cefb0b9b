"""`rebsync conform --times`, `--calibrate`, `--apply`, and the movement in its page."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from random import Random

import jsonschema  # type: ignore[import-untyped]
import pytest

from rebsync.conform.recording import Announced, Served
from tests.calibration.jittered import Measurable, Run, measurable
from tests.cli.run import Outcome, rebsync
from tests.consoles import ROOT

CROSSING = ROOT / "tests" / "ros1" / "models" / "crossing.rebeca"


def write_log(path: Path, given: Measurable, extra: float, drives: bool = False) -> None:
    """A log of a run in which the first robot's moves take `extra` units longer."""
    recorded = Run(
        given, lambda body, random: extra if body == "First.go" else 0.0, Random(0)
    ).make(100)
    lines = []
    nodes, observable = given.subject.observable.nodes, given.subject.observable
    for event in recorded.events():
        if isinstance(event, Announced):
            data: dict[str, object] = {"rebec": "first", "zero": int(event.zero * 1e9), "stamp": 0}
            lines.append({"topic": "/startup", "stamp": event.stamp, "data": data})
        elif isinstance(event, Served):
            state = {f"{n}": event.cells[c] for n, _, c in observable.variables(event.rebec)}
            body = {name: getattr(event, name) for name in ("server", "arguments", "arrival")}
            data = {**body, "start": event.start, "now": event.now, **state}
            topic = f"/{nodes[event.rebec]}/state"
            lines.append({"topic": topic, "stamp": event.stamp, "data": data})
    if drives:  # the second robot stays where it is for its first move, then slides
        zero = 1000.0
        for time, y in ((5.0, 0.0), (7.0, 1.0), (9.0, 0.0)):
            twist = {"linear": {"x": 0, "y": y}, "angular": {"z": 0}}
            lines.append({"topic": "/second/cmd_vel", "stamp": zero + time, "data": twist})
        lines.sort(key=lambda line: float(str(line["stamp"])))
    path.write_text("".join(f"{json.dumps(line)}\n" for line in lines), encoding="utf-8")


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """The model with its property and its settings, and a log of a sound and of a slow run."""
    for suffix in (".rebeca", ".property"):
        shutil.copy(CROSSING.with_suffix(suffix), tmp_path)
    (tmp_path / "rebsync.toml").write_text('allow = ["deadlock"]\n', encoding="utf-8")
    given = measurable(CROSSING.read_text(encoding="utf-8"))
    write_log(tmp_path / "sound.jsonl", given, 0.0)
    write_log(tmp_path / "slow.jsonl", given, 1.4)
    write_log(tmp_path / "driven.jsonl", given, 0.0, drives=True)
    return tmp_path / CROSSING.name


def conform(model: Path, log: str, *options: str) -> Outcome:
    """What the command says."""
    return rebsync("conform", model.name, log, *options, cwd=model.parent)


def test_times_are_a_table(model: Path) -> None:
    answer = conform(model, "sound.jsonl", "--times")
    assert answer.status == 0, answer.err
    assert "times in units of 1 s: 7 bodies" in answer.out
    row = next(line for line in answer.out.splitlines() if "First.go" in line)
    assert re.match(r" +17 +delay +2 +2 +3 +2\.0\d +2\.0\d +2\.0\d +2\.0\d +First\.go$", row), row
    assert "calibration" not in answer.out
    assert "times in" not in conform(model, "sound.jsonl").out


def test_times_in_json_keep_to_the_schema(model: Path) -> None:
    answer = conform(model, "slow.jsonl", "--times", "--format", "json")
    data = json.loads(answer.out)
    schema = json.loads((ROOT / "docs" / "conform.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(data)
    assert data["times"]["verified"] is None
    place = next(p for p in data["times"]["places"] if p["line"] == 17)
    assert place["measured"]["count"] == 3
    assert 3.3 < place["measured"]["least"] <= place["measured"]["greatest"] < 3.5
    data = json.loads(conform(model, "slow.jsonl", "--calibrate", "--format", "json").out)
    jsonschema.Draft202012Validator(schema).validate(data)
    assert data["times"]["verified"] == "violated"
    assert json.loads(conform(model, "slow.jsonl", "--format", "json").out)["times"] is None


def test_what_is_in_time_needs_no_change(model: Path) -> None:
    before = model.read_bytes()
    answer = conform(model, "sound.jsonl", "--apply")
    assert answer.status == 0, answer.out
    assert "no change of the model is needed" in answer.out
    assert model.read_bytes() == before


def test_a_calibration_is_shown_and_verified_but_not_written(model: Path) -> None:
    before = model.read_bytes()
    answer = conform(model, "slow.jsonl", "--calibrate")
    assert answer.status == 3, answer.out
    assert "line 17: 2 -> ?(2, 3, 4)" in answer.out
    assert "+    delay(?(2, 3, 4));  // as the data sheet says" in answer.out
    assert "with what was measured: violated (Apart violated)" in answer.out
    assert model.read_bytes() == before


def test_a_calibration_that_holds_is_a_finding_until_it_is_written(model: Path) -> None:
    model.with_suffix(".property").unlink()
    assert conform(model, "slow.jsonl", "--calibrate").status == 1
    answer = conform(model, "slow.jsonl", "--apply")
    assert answer.status == 0, answer.out
    assert "wrote crossing.rebeca" in answer.out
    assert "with what was measured: satisfied" in answer.out


def test_applying_twice_changes_nothing_more(model: Path) -> None:
    text = model.read_text(encoding="utf-8")
    assert conform(model, "slow.jsonl", "--apply").status == 3
    changed = model.read_text(encoding="utf-8")
    assert changed == text.replace("delay(2);  // as", "delay(?(2, 3, 4));  // as")
    again = conform(model, "slow.jsonl", "--apply")
    assert again.status == 0 and "conforms" in again.out
    assert model.read_text(encoding="utf-8") == changed
    assert rebsync("lint", model.name, cwd=model.parent).status == 0


def test_the_page_has_times_and_the_movement(model: Path) -> None:
    conform(model, "slow.jsonl", "--page", "page.html")
    page = (model.parent / "page.html").read_text(encoding="utf-8")
    assert 'id="times"' in page and 'class="movement ' in page
    scene = json.loads(re.findall(r'class="scene-data">(.*?)</script>', page)[0])
    first = next(robot for robot in scene["robots"] if robot["name"] == "first")
    # By its states: it stands in (1, 1) when its first body has ended, after 3.4 units.
    arrived = next(pose for pose in first["path"] if pose[1] == 1)
    assert arrived[0] == pytest.approx(3.4, abs=0.02) and arrived[2] == 1


def test_velocities_say_where_a_robot_is(model: Path) -> None:
    conform(model, "driven.jsonl", "--page", "page.html")
    page = (model.parent / "page.html").read_text(encoding="utf-8")
    scene = json.loads(re.findall(r'class="scene-data">(.*?)</script>', page)[0])
    second = next(robot for robot in scene["robots"] if robot["name"] == "second")
    places = {round(pose[0], 3): pose[2] for pose in second["path"]}
    assert places[7] == 0 and places[9] == pytest.approx(2)


def test_a_run_that_is_none_of_the_model_is_not_written(model: Path) -> None:
    text = model.read_text(encoding="utf-8").replace("x = x + 1;", "x = x + 2;")
    model.write_text(text, encoding="utf-8")
    answer = conform(model, "slow.jsonl", "--apply")
    assert answer.status in (1, 3), answer.out
    assert "nothing was written" in answer.out
    assert model.read_text(encoding="utf-8") == text
