"""Robots whose node is told to end, or is killed, in the middle of a move, on a real ROS 2."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.run import Clock, launched
from tests.ros1.test_examples import EXAMPLES, example_package
from tests.ros1.workspace import SYSTEM_PYTHON
from tests.ros2real.conftest import DIALECTS, Builder, Play
from tests.ros2real.workspace import Workspace

_LISTENER = Path(__file__).parent / "nodes" / "velocities.py"
_PATIENCE = 40.0  # s, on a busy machine
_SETTLE = 1.0  # s, in which what was sent is heard
# It stands still at first, and then drives for long.
_MODEL = """
@Robot reactiveclass Robot(5) {
  Robot() { self.go() after(4); }
  msgsrv go() { @Move(X+9, Y); delay(90); self.go(); }
}
main { Robot robot():(); }
"""
_INT, _TERM = signal.SIGINT, signal.SIGTERM


@dataclass(frozen=True)
class Driver:
    """A robot that drives, as installed."""

    workspace: Workspace

    @property
    def program(self) -> str:
        return str(self.workspace.root / "install/lib/driver/robot_node")

    @property
    def launch(self) -> Sequence[str]:
        """The command that starts it with its launch file, and again when it dies."""
        file = self.workspace.root / "install/share/driver/launch/driver.launch.py"
        return ["ros2", "launch", str(file), "respawn:=true"]


@dataclass(frozen=True)
class Velocities:
    """What is told to the robot, as far as it was heard."""

    file: Path

    def all(self) -> Sequence[float]:
        if not self.file.exists():
            return ()
        lines = [line.split() for line in self.file.read_text().splitlines()]
        return [float(words[1]) for words in lines if len(words) == 3]

    def until(self, holds: Callable[[Sequence[float]], bool]) -> Sequence[float]:
        """Those that were heard when this came true of them."""
        limit = time.monotonic() + _PATIENCE
        while not holds(self.all()):
            assert time.monotonic() < limit, self.all()[-20:]
            time.sleep(0.05)
        return self.all()

    def driving(self) -> Sequence[float]:
        """Those that were heard when the robot drives."""
        return self.until(lambda heard: len(heard) > 4 and 0 not in heard[-4:])


@pytest.fixture(scope="module", params=DIALECTS)
def driver(
    request: pytest.FixtureRequest, build_real: Builder, tmp_path_factory: pytest.TempPathFactory
) -> Driver:
    dialect = str(request.param)
    config, folder = Config(target=dialect), tmp_path_factory.mktemp("driver")
    package = written(generated(_MODEL, "driver", config), folder, "driver", config)
    return Driver(build_real(package, f"driver_{dialect}"))


@contextmanager
def _heard(environment: Mapping[str, str], directory: Path) -> Iterator[Velocities]:
    file = directory / "velocities"
    command = [SYSTEM_PYTHON, str(_LISTENER), "/robot/cmd_vel", str(file)]
    with subprocess.Popen(command, env=environment, stderr=subprocess.DEVNULL) as listener:
        try:
            yield Velocities(file)
        finally:
            listener.terminate()


def _node(driver: Driver, directory: Path) -> int:
    """The process of the node of this run, which no other logs to this directory."""
    mark = f"ROS_LOG_DIR={directory}/log".encode()
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            marked = mark in (folder / "environ").read_bytes().split(b"\0")
        except OSError:
            continue
        if marked and driver.program.encode() in words[:2]:
            return int(folder.name)
    raise LookupError(driver.program)


@pytest.mark.parametrize(
    "signals",
    [(_INT,), (_TERM,), (_INT, _INT), (_INT, _TERM, _INT)],
    ids=lambda signals: "-".join(s.name for s in signals),
)
def test_a_node_that_is_told_to_end_stops_its_robot(
    driver: Driver, signals: Sequence[signal.Signals], tmp_path: Path
) -> None:
    environment = driver.workspace.environment(tmp_path)
    command = [driver.program, "--ros-args", "-r", "__node:=robot"]
    with _heard(environment, tmp_path) as velocities:
        node = subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True)
        velocities.driving()
        for number in signals:
            node.send_signal(number)
            time.sleep(0.03)
        _, errors = node.communicate(timeout=_PATIENCE)
        time.sleep(_SETTLE)
        assert velocities.all()[-1] == 0
    assert node.returncode == 0, errors
    for word in ("Traceback", "terminate", "Error"):
        assert word not in errors, errors


@pytest.mark.parametrize("times", [1, 2], ids=["once", "twice"])
def test_ctrl_c_stops_the_robot_of_a_system(driver: Driver, times: int, tmp_path: Path) -> None:
    """The terminal tells all processes of the launch."""
    environment = driver.workspace.environment(tmp_path)
    with (
        _heard(environment, tmp_path) as velocities,
        launched(driver.launch, tmp_path, environment) as stop,
    ):
        velocities.driving()
        group = os.getpgid(_node(driver, tmp_path))
        for _ in range(times):
            os.killpg(group, signal.SIGINT)
            time.sleep(0.03)
        stop()
        time.sleep(_SETTLE)
        assert velocities.all()[-1] == 0
    output = (tmp_path / "output").read_text()
    assert "process has finished cleanly" in output
    for word in ("Traceback", "terminate", "escalating", "exit code"):
        assert word not in output, output


def test_a_robot_whose_node_was_killed_stops_when_that_comes_back(
    driver: Driver, tmp_path: Path
) -> None:
    environment = driver.workspace.environment(tmp_path)
    with (
        _heard(environment, tmp_path) as velocities,
        launched(driver.launch, tmp_path, environment),
    ):
        velocities.driving()
        os.kill(_node(driver, tmp_path), signal.SIGKILL)
        # Nobody is left who could stop it, until the launcher has started another.
        before = velocities.all()
        assert before[-1] > 0
        velocities.until(lambda heard: 0 in heard[len(before) :])
        assert velocities.driving()[-1] > 0


@pytest.mark.parametrize("dialect", DIALECTS)
def test_a_robot_whose_ticks_come_too_late_stops(
    dialect: str, play_real: Play, tmp_path: Path
) -> None:
    """Held on to for so long, velocities take it farther and farther from where it should be."""
    package = example_package(EXAMPLES / "hello", dialect, tmp_path)
    recording = play_real(package, dialect, Clock(until=40, quiet=30, rate=2.0, step=4.0))
    assert [line for line in recording.log if "overrun" in line.text]
    *others, last = recording.velocities("walker")
    assert any(v.x != 0 for v in others)
    assert (last.x, last.y, last.turn) == (0, 0, 0)
