"""What a change did to the graph, against a revision of git."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.rosgraph.commands import graph

HERE = Path(__file__).parent
Capture = pytest.CaptureFixture[str]


def _git(folder: Path, *arguments: str) -> None:
    settings = ("-c", "user.name=a", "-c", "user.email=a@example.org")
    subprocess.run(["git", *settings, *arguments], cwd=folder, check=True, capture_output=True)


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with the workspace, one commit, and nothing changed."""
    shutil.copytree(HERE / "robot", tmp_path / "robot")
    _git(tmp_path, "init", "-q")
    _git(tmp_path, "add", ".")
    _git(tmp_path, "commit", "-q", "-m", "Begin")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_nothing_has_changed(repository: Path, capfd: Capture) -> None:
    source = repository / "robot/robot/src/driver.cpp"
    source.write_text("// moved a line down\n" + source.read_text(encoding="utf-8"), "utf-8")
    done = graph(capfd, "robot", "--diff", "HEAD")
    assert (done.out, done.status) == ("", 0)


def test_an_end_that_is_renamed_and_a_node_that_is_gone(repository: Path, capfd: Capture) -> None:
    source = repository / "robot/robot/src/planner.cpp"
    text = source.read_text(encoding="utf-8").replace('"cmd_vel", 1', '"cmd_vell", 1')
    source.write_text(text, "utf-8")
    shutil.rmtree(repository / "robot/tools")
    done = graph(capfd, "robot", "--diff", "HEAD")
    assert done.status == 1
    assert done.out.splitlines() == [
        "removed: node /console (tools/Console)",
        "added: /planner publishes /cmd_vell [geometry_msgs/Twist]  robot/robot/src/planner.cpp:10",
        "removed: /planner publishes /cmd_vel [geometry_msgs/Twist]  "
        "HEAD:robot/robot/src/planner.cpp:10",
        "removed: /console calls /driver/stop [std_srvs/Empty]  "
        "HEAD:robot/tools/tools/console.py:11",
        "removed: /console calls the action /go [robot_msgs/Go]  "
        "HEAD:robot/tools/tools/console.py:10",
    ]
    found = [line.partition(": ")[2] for line in done.err.splitlines() if ": RS99" in line]
    assert found == [  # what is found now, and was not before
        "RS998 nothing of what was read calls the service /driver/stop",
        "RS993 nothing of what was read subscribes to the topic /cmd_vell",
        "RS998 nothing of what was read calls the action /go",
    ]
    given = json.loads(graph(capfd, "robot", "--diff", "HEAD", "--format", "json").out)
    marked = {b["name"]: b["change"] for b in given["boxes"] if "change" in b}
    assert marked == {"/cmd_vell": "added", "/console": "removed"}


def test_a_change_of_a_launch_file(repository: Path, capfd: Capture) -> None:
    launch = repository / "robot/robot/launch/robot.launch.py"
    text = launch.read_text(encoding="utf-8").replace('("scan", "/laser")', '("scan", "/front")')
    launch.write_text(text, "utf-8")
    done = graph(capfd, "robot", "--launch", str(launch), "--diff", "HEAD")
    changed = [line.partition("  ")[0] for line in done.out.splitlines()]
    assert changed == [
        "added: /planner subscribes to /front [sensor_msgs/LaserScan]",
        "removed: /planner subscribes to /laser [sensor_msgs/LaserScan]",
    ]


def test_a_revision_that_there_is_not(repository: Path, capfd: Capture) -> None:
    done = graph(capfd, "robot", "--diff", "nowhere")
    assert done.status == 2 and "RS801" in done.err
