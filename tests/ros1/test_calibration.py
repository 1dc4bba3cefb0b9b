"""A robot that is slower than its model, on a real roscore: it is found before it crashes."""

from __future__ import annotations

import json
import math
import shutil
from pathlib import Path

import pytest

from rebsync.config import Config
from tests.cli.run import Outcome, rebsync
from tests.forward.compiling import generated, written
from tests.ros1.conftest import Build
from tests.ros1.paths import Way
from tests.ros1.recording import Recording
from tests.ros1.run import Clock, run

MODEL = Path(__file__).parent / "models" / "crossing.rebeca"
CONFIG = Config(package="crossing", target="ros1-py")
UNTIL = 12.0
WAITS = "        self._mailbox.delay(2)  # as the data sheet says\n"
SLOW = "        time.sleep(1.3)  # until it stands\n"
SETTINGS = 'package = "crossing"\ntarget = "ros1-py"\nallow = ["deadlock"]\n'


def recorded(
    build_workspace: Build, tmp_path_factory: pytest.TempPathFactory, name: str, slow: bool
) -> Recording:
    """A run of the package on the real clock; a slow robot's body takes longer than it says."""
    folder = tmp_path_factory.mktemp(name)
    package = written(generated(MODEL.read_text(), "crossing", CONFIG), folder, "crossing", CONFIG)
    body = package / "src" / "crossing" / "first.py"
    if slow:
        text = body.read_text().replace("import rospy", "import time\n\nimport rospy", 1)
        body.write_text(text.replace(WAITS, f"{WAITS}{SLOW}"))
    workspace = build_workspace(f"calibration_{name}", [package])
    launch = workspace.root / "src" / "crossing" / "launch" / "crossing.launch"
    directory = tmp_path_factory.mktemp(f"{name}_run")
    return run(workspace, launch, directory, Clock(until=UNTIL, quiet=UNTIL, rate=None))


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """The model, its property and its settings, to be changed."""
    for suffix in (".rebeca", ".property"):
        shutil.copy(MODEL.with_suffix(suffix), tmp_path)
    (tmp_path / "rebsync.toml").write_text(SETTINGS)
    return tmp_path / MODEL.name


@pytest.fixture(scope="module")
def slow(build_workspace: Build, tmp_path_factory: pytest.TempPathFactory) -> Recording:
    return recorded(build_workspace, tmp_path_factory, "slow", True)


@pytest.fixture(scope="module")
def sound(build_workspace: Build, tmp_path_factory: pytest.TempPathFactory) -> Recording:
    return recorded(build_workspace, tmp_path_factory, "sound", False)


def conform(model: Path, recording: Recording, *options: str) -> Outcome:
    """What the command says of a recording."""
    return rebsync("conform", model.name, str(recording.run_log), *options, cwd=model.parent)


def apart(recording: Recording) -> list[float]:
    """How far the robots are from each other, at many times."""
    ways = []
    for name, x, y in (("first", 0, 1), ("second", 1, 0)):
        path = recording.path(name)
        times = (0.0, *(stamp for stamp, _ in path))
        ways.append(Way(name, times, ((x, y), *((x + p.x, y + p.y) for _, p in path))))
    one, other = ways
    return [math.dist(one.at(t / 20), other.at(t / 20)) for t in range(int(UNTIL * 20))]


def test_a_robot_in_time_needs_no_other_model(sound: Recording, model: Path) -> None:
    before = model.read_bytes()
    answer = conform(model, sound, "--apply", "--format", "json")
    assert answer.status == 0, answer.out
    times = json.loads(answer.out)["times"]
    assert {p["state"] for p in times["proposals"]} == {"kept"}
    assert model.read_bytes() == before
    delay = next(p for p in times["places"] if p["line"] == 17)
    assert delay["measured"]["count"] + delay["shortened"] == 3
    assert (delay["measured"]["count"] >= 1, delay["model"]) == (True, [2])
    assert 1.9 < delay["measured"]["least"] <= delay["measured"]["greatest"] < 2.5


def test_a_slow_robot_is_found_before_it_crashes(slow: Recording, model: Path) -> None:
    """It did not crash, and by its own clock it does what the model says; but it would crash."""
    assert min(apart(slow)) > 0.5
    text = model.read_text()
    answer = conform(model, slow, "--calibrate")
    assert "conforms" in answer.out
    assert model.read_text() == text
    assert answer.status == 3, answer.out
    answer = conform(model, slow, "--apply", "--format", "json")
    assert answer.status == 3, answer.out
    delay = next(p for p in json.loads(answer.out)["times"]["places"] if p["line"] == 17)
    # Later ones begin late, and wait for what is left of their time only.
    assert 3.2 < delay["measured"]["greatest"] < 4
    assert delay["measured"]["count"] + delay["shortened"] == 3
    changed = text.replace("delay(2);  // as", "delay(?(2, 3, 4));  // as", 1)
    assert model.read_text() == changed
    assert rebsync("lint", model.name, cwd=model.parent).status == 0
    assert rebsync("verify", model.name, cwd=model.parent).status == 3
    again = conform(model, slow, "--apply")
    assert "conforms" in again.out
    assert model.read_text() == changed
