"""Runs launch files with a real `ros2 launch`, and records what happens."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from tests.ros1.recording import Recording
from tests.ros1.run import Clock, launched, record
from tests.ros1.workspace import SYSTEM_PYTHON
from tests.ros2real.workspace import Workspace

_RECORDER = Path(__file__).parent / "nodes" / "recorder.py"
_WRAPPER = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource


def generate_launch_description():
    system = IncludeLaunchDescription(
        PythonLaunchDescriptionSource({launch!r}),
        launch_arguments={{"use_sim_time": "{simulated}"}}.items(),
    )
    beside = [ExecuteProcess(cmd=c, output="screen") for c in {beside!r}]
    return LaunchDescription([*beside, system])
"""


def run(
    workspace: Workspace,
    launch: Path,
    nodes: Sequence[str],
    rebecs: Sequence[str],
    directory: Path,
    clock: Clock,
    beside: Sequence[Path] = (),
) -> Recording:
    """Run a launch file to the end of `clock`; `nodes` are its nodes by their full names.

    The scripts `beside` it are no part of the system: what publishes to its sensors.
    """
    wrapper = directory / "wrapper.launch.py"
    simulated = clock.rate is not None
    commands = [[SYSTEM_PYTHON, str(script)] for script in beside]
    text = _WRAPPER.format(launch=str(launch), simulated=simulated, beside=commands)
    wrapper.write_text(text)
    return run_command(workspace, ["ros2", "launch", str(wrapper)], nodes, rebecs, directory, clock)


def run_command(
    workspace: Workspace,
    command: Sequence[str],
    nodes: Sequence[str],
    rebecs: Sequence[str],
    directory: Path,
    clock: Clock,
) -> Recording:
    """Run what starts nodes to the end of `clock`, then interrupt it, as Ctrl-C does."""
    environment = workspace.environment(directory)
    facts = {"nodes": list(nodes), "rebecs": list(rebecs)}
    with launched(command, directory, environment) as stop:
        return record(_RECORDER, facts, clock, directory, environment, stop)
