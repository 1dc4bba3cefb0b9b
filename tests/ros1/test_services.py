"""Servers that are offered as services and actions, asked by a client that is no rebec."""

from __future__ import annotations

import json
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.conftest import Build
from tests.ros1.run import launched, ros_environment
from tests.ros1.workspace import SYSTEM_PYTHON, Workspace

_HERE = Path(__file__).parent
_ASKER = _HERE / "nodes" / "asker.py"
_ACTOR = _HERE / "nodes" / "actor.py"
# States of goals, as actionlib_msgs/GoalStatus numbers them.
SUCCEEDED, ABORTED, REJECTED = 3, 4, 5
_MODEL = _HERE / "models" / "services.rebeca"


@pytest.fixture(scope="module")
def offering(
    dialect: str, build_workspace: Build, tmp_path_factory: pytest.TempPathFactory
) -> Workspace:
    config = Config(target=dialect)
    files = generated(_MODEL.read_text(encoding="utf-8"), "services", config)
    package = written(files, tmp_path_factory.mktemp("services"), "services", config)
    return build_workspace(f"services_{dialect}", [package])


def test_replies_are_responses(offering: Workspace, tmp_path: Path) -> None:
    go, later = ("/robot/port/go", "RobotGoCall"), ("/robot/later", "RobotLaterCall")
    never, ask = (
        ("/robot/never", "RobotNeverCall"),
        ("/control_bridge/control/ask", "ControlAskCall"),
    )
    answers, output = asked(
        *(offering, tmp_path),
        [
            [(*later, [3]), (*later, [4])],
            [(*go, [5, True])],
            [(*never, [9]), (*never, [-9]), (*go, [6, False])],
            [(*ask, [])],
        ],
    )
    # One variable keeps one client: the first of two that ask at once gets no answer.
    assert sorted(a["said"]["answered"] for a in answers[:2]) == [False, True]
    assert [a["said"] for a in answers[2:]] == [
        {"answered": True, "place": 5, "fast": True},
        {"answered": False, "place": 0, "fast": False},
        {"answered": True, "place": -9, "fast": True},
        {"answered": True, "place": 6, "fast": False},
        {"answered": True, "seen": 0},
    ]
    assert all(2.5 < a["after"] < 6 for a in answers if not a["said"]["answered"])
    assert "service: " in output and "(no arrived within 3 s)" in output
    assert "null: " not in output and "deadline: " not in output


def test_goals_are_messages(offering: Workspace, tmp_path: Path) -> None:
    goals = [[5], [106], list(range(10, 20)), [-1]]
    lines = []
    with _running(offering, tmp_path) as (stop, environment):
        command = [SYSTEM_PYTHON, str(_ACTOR), json.dumps(goals)]
        with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as actor:
            assert actor.stdout is not None
            for line in actor.stdout:
                if not line.startswith(("[{", '"sent"')):
                    continue  # rospy says that it waits for the roscore
                lines.append(json.loads(line))
                if len(lines) == 7:  # the last goal, which the model never answers, is sent
                    time.sleep(2)
                    stop()
    one, cancelled, many, left = (found for found in lines if found != "sent")
    (first,) = one
    assert (first["state"], first["place"]) == (SUCCEEDED, 5)
    assert len(first["passed"]) == 1
    assert cancelled == [{"state": SUCCEEDED, "place": 6, "passed": [5]}]
    # One is served, five wait: there is no room for more.
    states = [goal["state"] for goal in many]
    assert sorted(states) == [SUCCEEDED] * 6 + [REJECTED] * 4
    taken = [goal["place"] for goal in many if goal["state"] == SUCCEEDED]
    assert all(place in range(10, 20) for place in taken)
    assert [goal["state"] for goal in left] == [ABORTED]


@contextmanager
def _running(
    workspace: Workspace, directory: Path
) -> Iterator[tuple[Callable[[], None], dict[str, str]]]:
    """The launch file; gives what stops it, and the variables of who is beside it."""
    port, environment = ros_environment(workspace, directory)
    launch = workspace.root / "src" / "services" / "launch" / "services.launch"
    wrapper = directory / "wrapper.launch"
    wrapper.write_text(
        f'<launch>\n  <include file="{launch}"/>\n'
        '  <param name="mailbox/time_unit" value="0.5"/>\n'
        '  <param name="mailbox/service_timeout" value="3.0"/>\n</launch>\n'
    )
    command = ["roslaunch", "--skip-log-check", "-p", str(port), str(wrapper)]
    with launched(command, directory, environment) as stop:
        yield stop, environment


def asked(
    workspace: Workspace, directory: Path, calls: list[list[tuple[str, str, list[Any]]]]
) -> tuple[list[dict[str, Any]], str]:
    """What services respond to groups of calls, and what the nodes wrote."""
    with _running(workspace, directory) as (_, environment):
        asker = [SYSTEM_PYTHON, str(_ASKER), json.dumps(calls)]
        done = subprocess.run(
            asker, env=environment, stdout=subprocess.PIPE, text=True, timeout=120, check=True
        )
    return json.loads(done.stdout.splitlines()[-1]), (directory / "output").read_text()
