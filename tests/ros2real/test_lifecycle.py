"""Nodes with a life cycle on a real ROS 2: others stop them, and let them go on."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.run import launched
from tests.ros1.workspace import SYSTEM_PYTHON
from tests.ros2real.conftest import DIALECTS, Builder
from tests.ros2real.workspace import Workspace

_MANAGER = Path(__file__).parent / "nodes" / "manager.py"
_PATIENCE = 120.0  # s, on a busy machine
# It stands still at first, and then drives for long.
_MODEL = """
@Robot reactiveclass Robot(5) {
  Robot() { self.go() after(2); }
  msgsrv go() { @Move(X+9, Y); delay(90); self.go(); }
}
main { Robot robot():(); }
"""


@dataclass(frozen=True)
class Managed:
    """A robot whose node has a life cycle, as installed."""

    workspace: Workspace

    def launch(self, *arguments: str) -> Sequence[str]:
        """The command that starts it."""
        file = self.workspace.root / "install/share/managed/launch/managed.launch.py"
        return ["ros2", "launch", str(file), *arguments]

    def told(self, environment: Mapping[str, str], *words: str) -> list[str]:
        """What the manager has seen, a word for each that it was told to do."""
        command = [SYSTEM_PYTHON, str(_MANAGER), "/robot", *words]
        done = subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=_PATIENCE
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout.split()


@pytest.fixture(scope="module", params=DIALECTS)
def managed(
    request: pytest.FixtureRequest, build_real: Builder, tmp_path_factory: pytest.TempPathFactory
) -> Managed:
    dialect = str(request.param)
    config, folder = Config(target=dialect, lifecycle=True), tmp_path_factory.mktemp("managed")
    package = written(generated(_MODEL, "managed", config), folder, "managed", config)
    return Managed(build_real(package, f"managed_{dialect}"))


def _ended_cleanly(directory: Path) -> None:
    output = (directory / "output").read_text()
    assert "process has finished cleanly" in output
    for word in ("Traceback", "terminate", "escalating", "exit code"):
        assert word not in output, output


def test_a_robot_stands_while_its_node_is_inactive(managed: Managed, tmp_path: Path) -> None:
    environment = managed.workspace.environment(tmp_path)
    with launched(managed.launch(), tmp_path, environment) as stop:
        words = ("drives", "deactivate", "stands", "activate", "drives", "shutdown", "stands")
        said = ["drives", "inactive", "stands", "active", "drives", "finalized", "stands"]
        assert managed.told(environment, *words) == said
        stop()
    assert "inactive: robot.lifecycle (from " in (tmp_path / "output").read_text()
    _ended_cleanly(tmp_path)


def test_a_node_that_nobody_starts_waits_and_is_made_again(
    managed: Managed, tmp_path: Path
) -> None:
    environment = managed.workspace.environment(tmp_path)
    with launched(managed.launch("autostart:=false"), tmp_path, environment) as stop:
        words = ("configure", "stands", "activate", "drives", "deactivate", "cleanup", "stands")
        said = ["inactive", "stands", "active", "drives", "inactive", "unconfigured", "stands"]
        assert managed.told(environment, *words) == said
        again = ("configure", "activate", "drives")
        assert managed.told(environment, *again) == ["inactive", "active", "drives"]
        stop()
    _ended_cleanly(tmp_path)
