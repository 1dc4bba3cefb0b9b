"""Mailbox, drive and start-up of rclpy packages on a real ROS 2, by rebecs that run scripts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.ros1.probes import Player, Rebec
from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros1.test_startup import (
    test_a_missing_node_is_named,
    test_a_node_that_is_only_waited_for_is_named,
    test_a_rebec_that_starts_again_is_named,
)
from tests.ros2py.conftest import probe_nodes, probe_packages
from tests.ros2py.test_drive import *  # noqa: F403 - the same tests, on the probe below
from tests.ros2py.test_mailbox import *  # noqa: F403
from tests.ros2py.test_startup import *  # noqa: F403
from tests.ros2py.world import Launched
from tests.ros2real.conftest import Builder, followed
from tests.ros2real.running import run
from tests.ros2real.workspace import Workspace

__all__ = [
    "test_a_missing_node_is_named",
    "test_a_node_that_is_only_waited_for_is_named",
    "test_a_rebec_that_starts_again_is_named",
]

_DIALECT = "ros2-py"
_NODES = Path(__file__).parent / "nodes"
_BESIDE = "        ExecuteProcess(cmd=['/usr/bin/python3', *{words!r}], output='screen'),\n"
_HEAD = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

CLOCK = {"use_sim_time": LaunchConfiguration("use_sim_time")}


def generate_launch_description():
    return LaunchDescription([
"""


@dataclass(frozen=True)
class _Real:
    """Plays with an installed package, each time in a folder of its own.

    To topics that are `foreign` a node subscribes that is no rebec. The `deaf` hear what others
    announce some seconds late.
    """

    workspace: Workspace
    factory: pytest.TempPathFactory
    foreign: tuple[str, ...] = ()
    deaf: tuple[tuple[str, float], ...] = ()

    def play(
        self,
        rebecs: Mapping[str, Rebec],
        clock: Clock,
        parameters: Mapping[str, Any],
        names: Sequence[str],
    ) -> Recording:
        """Run rebecs of which each knows all the names, until the clock's end."""
        folder = self.factory.mktemp("play")
        nodes = probe_nodes(rebecs, parameters, names)
        launch = folder / "probe.launch.py"
        nodes = [_apart(node) if node.name in dict(self.deaf) else node for node in nodes]
        texts = [_BESIDE.format(words=words) for words in self._beside()]
        texts += [_node(node, rebecs[node.name], folder) for node in nodes]
        launch.write_text(f"{_HEAD}{''.join(texts)}    ])\n")
        told = nodes[0].parameters["mailbox.rebecs"]
        assert isinstance(told, list)
        expected = [rebec for rebec in told if rebec]
        present = [f"/{node.name}" for node in nodes]
        followed_clock = followed(clock, _DIALECT)
        return run(self.workspace, launch, present, expected, folder, followed_clock)

    def _beside(self) -> Iterator[list[str]]:
        """The nodes that run beside the rebecs, as words of commands."""
        if self.foreign:
            yield [str(_NODES / "listener.py"), *self.foreign]
        for rebec, seconds in self.deaf:
            yield [str(_NODES / "deaf.py"), rebec, str(seconds)]


def _apart(node: Launched) -> Launched:
    """The node with a topic of its own for what is announced."""
    return replace(node, remaps={**node.remaps, "startup": f"{node.name}/startup"})


def _node(node: Launched, rebec: Rebec, folder: Path) -> str:
    """A node in the launch file; its parameters are in a file, where no text is read as YAML."""
    file = folder / f"{node.name}.yaml"
    file.write_text(yaml.safe_dump({"/**": {"ros__parameters": dict(node.parameters)}}))
    prefix = f'sh -c \'sleep {rebec.wait}; exec "$0" "$@"\''
    return (
        f"        Node(package='probe', executable='script_node', name={node.name!r},\n"
        f"             parameters=[{str(file)!r}, CLOCK],\n"
        f"             remappings={list(node.remaps.items())!r},\n"
        f"             prefix={prefix!r}, respawn={rebec.respawn}, output='screen'),\n"
    )


@pytest.fixture(scope="module")
def probe(build_real: Builder, tmp_path_factory: pytest.TempPathFactory) -> Player:
    """The package whose rebecs run scripts, with the run-time part as it is now."""
    folder = probe_packages(tmp_path_factory.mktemp("probe"))
    return _Real(build_real(folder, "probe"), tmp_path_factory)
