"""Servers that are offered as services and actions, on a real ROS 2."""

from __future__ import annotations

import json
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.run import launched
from tests.ros1.workspace import SYSTEM_PYTHON
from tests.ros2real.conftest import DIALECTS, Builder
from tests.ros2real.workspace import Workspace

_HERE = Path(__file__).parent
_ASKER, _ACTOR = _HERE / "nodes" / "asker.py", _HERE / "nodes" / "actor.py"
# States of goals, as action_msgs/GoalStatus numbers them; a refused one has none.
_SUCCEEDED, _ABORTED, _REFUSED = 4, 6, 0
_MODEL = _HERE.parent / "ros1" / "models" / "services.rebeca"
_SETTINGS = """/**:
  ros__parameters:
    mailbox.time_unit: 0.5
    mailbox.service_timeout: 3.0
"""
_GO, _LATER = ("/robot/port/go", "RobotGoCall"), ("/robot/later", "RobotLaterCall")
_NEVER = ("/robot/never", "RobotNeverCall")
_ASK = ("/control_bridge/control/ask", "ControlAskCall")


@dataclass(frozen=True)
class Offering:
    """The package, as installed, and where its types are."""

    workspace: Workspace
    interfaces: str

    @contextmanager
    def running(self, directory: Path, environment: dict[str, str]) -> Iterator[Callable[[], None]]:
        """The launch file, until the block ends."""
        (directory / "params.yaml").write_text(_SETTINGS)
        launch = self.workspace.root / "install/share/services/launch/services.launch.py"
        command = ["ros2", "launch", str(launch), f"params_file:={directory / 'params.yaml'}"]
        with launched(command, directory, environment) as stop:
            yield stop

    def client(
        self, script: Path, asked: Sequence[object], environment: dict[str, str]
    ) -> subprocess.Popen[str]:
        """A client that calls services, or sends goals, group by group."""
        command = [SYSTEM_PYTHON, str(script), self.interfaces, json.dumps(asked)]
        return subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)


@pytest.fixture(scope="module", params=DIALECTS)
def offering(
    request: pytest.FixtureRequest, build_real: Builder, tmp_path_factory: pytest.TempPathFactory
) -> Offering:
    dialect = str(request.param)
    config = Config(target=dialect)
    files = generated(_MODEL.read_text(encoding="utf-8"), "services", config)
    folder = written(files, tmp_path_factory.mktemp("services"), "services", config)
    interfaces = "services_interfaces" if dialect == "ros2-py" else "services"
    return Offering(build_real(folder, f"services_{dialect}"), interfaces)


def _answers(asker: subprocess.Popen[str]) -> list[dict[str, Any]]:
    printed, _ = asker.communicate(timeout=120)
    return [answer for line in printed.splitlines() for answer in json.loads(line)]


def test_replies_are_responses(offering: Offering, tmp_path: Path) -> None:
    environment = offering.workspace.environment(tmp_path)
    calls = [
        [(*_ASK, [])],
        [(*_LATER, [3]), (*_LATER, [4])],
        [(*_GO, [5, True])],
        [(*_NEVER, [9]), (*_NEVER, [-9]), (*_GO, [6, False])],
    ]
    # The first is called as soon as the service is there, which is before time 0.
    asker = offering.client(_ASKER, calls, environment)
    with offering.running(tmp_path, environment):
        answers = _answers(asker)
        said = _service_call(offering, environment)
    assert answers[0]["said"]["answered"] is True
    # One variable keeps one client: the first of two that ask at once gets no answer.
    assert sorted(a["said"]["answered"] for a in answers[1:3]) == [False, True]
    assert [a["said"] for a in answers[3:]] == [
        {"answered": True, "place": 5, "fast": True},
        {"answered": False, "place": 0, "fast": False},
        {"answered": True, "place": -9, "fast": True},
        {"answered": True, "place": 6, "fast": False},
    ]
    assert all(2.5 < a["after"] < 6 for a in answers if not a["said"]["answered"])
    assert "answered=True, place=8, fast=True" in said
    output = (tmp_path / "output").read_text()
    assert "service: " in output and "(no arrived within 3 s)" in output
    assert "null: " not in output and "deadline: " not in output and "Traceback" not in output


def _service_call(offering: Offering, environment: dict[str, str]) -> str:
    """What the command line tool prints."""
    type_ = f"{offering.interfaces}/srv/RobotGoCall"
    command = ["ros2", "service", "call", "/robot/port/go", type_, "{to: 8, fast: true}"]
    done = subprocess.run(
        command, env=environment, stdout=subprocess.PIPE, text=True, timeout=60, check=True
    )
    return done.stdout


def test_who_waits_when_the_node_ends_gets_a_response(offering: Offering, tmp_path: Path) -> None:
    environment = offering.workspace.environment(tmp_path)
    asker = offering.client(_ASKER, [[(*_GO, [1, True])], [(*_NEVER, [9])]], environment)
    with offering.running(tmp_path, environment) as stop:
        assert asker.stdout is not None
        assert json.loads(asker.stdout.readline())[0]["said"]["place"] == 1
        time.sleep(0.5)  # the second call is under way
        stop()
        (answer,) = _answers(asker)  # which reads to the end
    assert answer["said"] == {"answered": False, "place": 0, "fast": False}
    assert answer["after"] < 2.5


def test_goals_are_messages(offering: Offering, tmp_path: Path) -> None:
    environment = offering.workspace.environment(tmp_path)
    goals = [[5], [106], list(range(10, 20)), [-1]]
    lines: list[Any] = []
    with offering.running(tmp_path, environment) as stop:
        said = _send_goal(offering, environment)
        with offering.client(_ACTOR, goals, environment) as actor:
            assert actor.stdout is not None
            for line in actor.stdout:
                lines.append(json.loads(line))
                if len(lines) == 7:  # the last goal, which the model never answers, is sent
                    time.sleep(2)
                    stop()
    one, cancelled, many, left = (found for found in lines if found != "sent")
    (first,) = one
    assert (first["state"], first["place"]) == (_SUCCEEDED, 5)
    assert len(first["passed"]) == 1
    assert cancelled == [{"state": _SUCCEEDED, "place": 6, "passed": [5]}, {"refused": True}]
    # One is served, five wait: there is no room for more.
    states = [goal["state"] for goal in many]
    assert sorted(states) == [_REFUSED] * 4 + [_SUCCEEDED] * 6
    assert [goal["state"] for goal in left] == [_ABORTED]
    assert "place: 8" in said and "SUCCEEDED" in said
    output = (tmp_path / "output").read_text()
    assert "null: " not in output and "deadline: " not in output and "Traceback" not in output


def _send_goal(offering: Offering, environment: dict[str, str]) -> str:
    """What the command line tool prints."""
    type_ = f"{offering.interfaces}/action/RobotTravelTask"
    command = ["ros2", "action", "send_goal", "/robot/travel", type_, "{to: 8}"]
    done = subprocess.run(
        command, env=environment, stdout=subprocess.PIPE, text=True, timeout=60, check=True
    )
    return done.stdout
