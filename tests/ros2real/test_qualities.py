"""Qualities of service that parameters override, on a real ROS 2."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from rebsync.config import Config, SensorBinding
from tests.forward.compiling import generated, written
from tests.ros1.workspace import SYSTEM_PYTHON
from tests.ros2real.conftest import DIALECTS, Builder
from tests.ros2real.workspace import Workspace

_BUMPER = Path(__file__).parent / "nodes" / "bumper.py"
_MODEL = """
@Robot reactiveclass Eye(9) {
  statevars { boolean pressed; }
  Eye() { self.bumper() after(1); }
  @Sensor msgsrv bumper() { pressed = ?(false, true); self.bumper() after(1); }
}
main { Eye e():(); }
"""
_SENSOR = "qos_overrides./bump.subscription"
_SERVER = "qos_overrides./e/bumper.subscription"


@dataclass(frozen=True)
class Eye:
    """The node of a rebec with a sensor, as installed."""

    workspace: Workspace

    def command(self, *parameters: str) -> list[str]:
        """Runs it with parameters."""
        program = self.workspace.root / "install/lib/eyes/eye_node"
        names = ["-r", "__node:=e", "-r", "~/sensor/bumper:=/bump"]
        given = [word for parameter in parameters for word in ("-p", parameter)]
        return [str(program), "--ros-args", *names, *given]

    def heard(self, directory: Path, *parameters: str) -> str:
        """What a bumper tells that it runs beside."""
        environment = self.workspace.environment(directory)
        with subprocess.Popen(self.command(*parameters), env=environment) as node:
            try:
                told = subprocess.run(
                    [SYSTEM_PYTHON, str(_BUMPER)],
                    env=environment,
                    stdout=subprocess.PIPE,
                    text=True,
                    timeout=120,
                )
            finally:
                node.terminate()
        return told.stdout.strip()


@pytest.fixture(scope="module", params=DIALECTS)
def eye(
    request: pytest.FixtureRequest, build_real: Builder, tmp_path_factory: pytest.TempPathFactory
) -> Eye:
    dialect = str(request.param)
    bump = SensorBinding("Eye.bumper", "/bump", "std_msgs/Bool", "msg.data")
    config = replace(Config(target=dialect), sensors=(bump,))
    folder = tmp_path_factory.mktemp("eyes")
    package = written(generated(_MODEL, "eyes", config), folder, "eyes", config)
    return Eye(build_real(package, f"qualities_{dialect}"))


def test_a_sensor_hears_what_may_be_lost_unless_told_otherwise(eye: Eye, tmp_path: Path) -> None:
    assert eye.heard(tmp_path) == "BEST_EFFORT 1"
    assert eye.heard(tmp_path, f"{_SENSOR}.reliability:=best_effort") == "BEST_EFFORT 1"
    assert eye.heard(tmp_path, f"{_SENSOR}.reliability:=reliable") == "RELIABLE 0"


@pytest.mark.parametrize("value", ["reliability:=best_effort", "depth:=10"])
def test_no_message_of_the_model_may_be_lost(eye: Eye, tmp_path: Path, value: str) -> None:
    done = subprocess.run(
        eye.command(f"{_SERVER}.{value}"),
        env=eye.workspace.environment(tmp_path),
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode != 0
    assert "carries messages of the model" in done.stderr
    assert "/e/bumper" in done.stderr
