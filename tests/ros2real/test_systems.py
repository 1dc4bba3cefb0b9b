"""What users of ROS 2 do with a package: namespaces, components, parameters, Ctrl-C, runs again."""

from __future__ import annotations

import signal
import subprocess
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest
import yaml

from tests.ros1.recording import Recording
from tests.ros1.run import Clock, launched
from tests.ros2.launching import launched as described
from tests.ros2real.conftest import DIALECTS, Builder, followed
from tests.ros2real.conftest import office as office_package
from tests.ros2real.running import run, run_command
from tests.ros2real.workspace import Workspace

_CLOCK = Clock(until=70, quiet=30)
_HEAD = """
from launch import LaunchDescription
from launch.actions import GroupAction, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.actions import ComposableNodeContainer, Node, PushRosNamespace
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    return LaunchDescription([
"""
_NAMESPACE = "        GroupAction([PushRosNamespace({space!r}), system({launch!r})]),\n"
_SYSTEM = """

def system(launch):
    return IncludeLaunchDescription(PythonLaunchDescriptionSource(launch))
"""
_PLUGINS = {
    "server_node": "office::Server_v",
    "client_node": "office::Client",
    "robot_node": "office::Robot",
}
_ARGUMENTS = ("-p", "first:=4", "-p", "flag:=true")


@dataclass(frozen=True)
class Office:
    """The package of the mailbox tests in a dialect, as installed."""

    workspace: Workspace
    dialect: str
    package: Path

    @property
    def launch(self) -> Path:
        """The installed launch file."""
        return self.workspace.root / "install/share/office/launch/office.launch.py"

    @property
    def clock(self) -> Clock:
        """The clock of all runs."""
        return followed(_CLOCK, self.dialect)

    def server(self, *arguments: str) -> list[str]:
        """The command that runs the server alone."""
        program = self.workspace.root / "install/lib/office/server_node"
        return [str(program), "--ros-args", "-r", "__node:=s", *arguments]


@pytest.fixture(scope="module", params=DIALECTS)
def office(
    request: pytest.FixtureRequest, build_real: Builder, tmp_path_factory: pytest.TempPathFactory
) -> Office:
    dialect = str(request.param)
    package = office_package(tmp_path_factory.mktemp("systems"), dialect)
    workspace = build_real(package, f"office_{dialect}")
    return Office(workspace, dialect, package / "office" if dialect == "ros2-py" else package)


def _bodies(recording: Recording, space: str = "") -> Mapping[str, Sequence[str]]:
    return {name: recording.order(f"{space}{name}") for name in "sc"}


@pytest.fixture(scope="module")
def usual(office: Office, tmp_path_factory: pytest.TempPathFactory) -> Recording:
    directory = tmp_path_factory.mktemp("usual")
    return run(office.workspace, office.launch, ["/s", "/c"], "sc", directory, office.clock)


# --- systems ------------------------------------------------------------------------------------


def test_a_second_launch_does_what_the_first_did(
    office: Office, usual: Recording, tmp_path: Path
) -> None:
    again = run(office.workspace, office.launch, ["/s", "/c"], "sc", tmp_path, office.clock)
    assert len(usual.bodies("s")) > 8
    assert _bodies(again) == _bodies(usual)


def test_a_namespace_keeps_the_system_together(
    office: Office, usual: Recording, tmp_path: Path
) -> None:
    wrapper = tmp_path / "field.launch.py"
    group = _NAMESPACE.format(space="field", launch=str(office.launch))
    wrapper.write_text(f"{_HEAD}{group}    ])\n{_SYSTEM}")
    nodes = ["/field/s", "/field/c"]
    recording = run(office.workspace, wrapper, nodes, "sc", tmp_path, office.clock)
    assert _bodies(recording, "field/") == _bodies(usual)
    topics = {m.topic for m in recording.messages}
    # Where all of ROS looks for diagnostics.
    assert {topic for topic in topics if not topic.startswith("/field/")} == {"/diagnostics"}


def test_two_systems_in_namespaces_do_not_disturb_each_other(
    office: Office, usual: Recording, tmp_path: Path
) -> None:
    wrapper = tmp_path / "fields.launch.py"
    groups = [_NAMESPACE.format(space=name, launch=str(office.launch)) for name in ("a", "b")]
    wrapper.write_text(f"{_HEAD}{''.join(groups)}    ])\n{_SYSTEM}")
    nodes = [f"/{space}/{name}" for space in "ab" for name in "sc"]
    recording = run(office.workspace, wrapper, nodes, "sc", tmp_path, office.clock)
    assert _bodies(recording, "a/") == _bodies(recording, "b/") == _bodies(usual)


@pytest.mark.parametrize("container", ["component_container", "component_container_mt"])
def test_components_in_one_container_do_what_nodes_do(
    office: Office, usual: Recording, container: str, tmp_path: Path
) -> None:
    if office.dialect == "ros2-py":
        pytest.skip("rclpy has no components")
    parts = [
        f"            ComposableNode(package='office', plugin={_PLUGINS[node.executable]!r},\n"
        f"                name={node.name!r}, remappings={list(node.remappings)!r},\n"
        f"                parameters=[{ {**node.parameters, 'use_sim_time': True}!r}]),\n"
        for node in described(office.package)
    ]
    wrapper = tmp_path / "container.launch.py"
    wrapper.write_text(
        f"{_HEAD}        ComposableNodeContainer(package='rclcpp_components', namespace='',\n"
        f"            executable={container!r}, name='all', output='screen',\n"
        f"            composable_node_descriptions=[\n{''.join(parts)}        ]),\n    ])\n"
    )
    recording = run(office.workspace, wrapper, ["/s", "/c"], "sc", tmp_path, office.clock)
    assert _bodies(recording) == _bodies(usual)
    assert "process has finished cleanly" in recording.output


# --- parameters ---------------------------------------------------------------------------------


def _constructed(office: Office, directory: Path, *arguments: str) -> Mapping[str, object]:
    command, clock = office.server(*_ARGUMENTS, *arguments), Clock(until=2, quiet=2, rate=None)
    recording = run_command(office.workspace, command, ["/s"], "s", directory, clock)
    return recording.served[0].state


def test_parameters_are_overruled_on_the_command_line(office: Office, tmp_path: Path) -> None:
    state = _constructed(office, tmp_path, "-p", "env.small:=9", "-p", "env.grid:=[1, 2, 30, 4]")
    assert (state["b"], state["last"], state["ready"]) == (9, 34, True)


def test_parameters_are_overruled_by_a_file(office: Office, tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    own = {"env": {"grid": [5, 6, 7, 8], "small": 1}, "mailbox": {"seed": 3}}
    file.write_text(yaml.safe_dump({"/s": {"ros__parameters": own}}))
    state = _constructed(office, tmp_path, "--params-file", str(file))
    assert (state["b"], state["last"]) == (1, 11)


@pytest.mark.parametrize("name", ["first", "mailbox.seed", "env.grid", "mailbox.rebecs"])
def test_a_parameter_of_a_wrong_type_is_named(office: Office, name: str, tmp_path: Path) -> None:
    command = office.server("-p", f"{name}:=many")
    done = subprocess.run(
        command,
        env=office.workspace.environment(tmp_path),
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode != 0
    last = done.stderr.strip().splitlines()[-1]
    assert name in last
    assert "type" in last


# --- Ctrl-C -------------------------------------------------------------------------------------


def _interrupted(office: Office, command: Sequence[str], directory: Path, wait: float) -> str:
    """The output of a launch that is interrupted after some seconds; it has to end well."""
    with launched(command, directory, office.workspace.environment(directory)) as stop:
        time.sleep(wait)
        stop()
    return (directory / "output").read_text()


@pytest.mark.parametrize("wait", [4.0, 5.5, 7.0])
def test_a_system_ends_cleanly(office: Office, wait: float, tmp_path: Path) -> None:
    command = ["ros2", "launch", str(office.launch)]
    output = _interrupted(office, command, tmp_path, wait)
    assert output.count("process has finished cleanly") == len(described(office.package)), output
    for word in ("Traceback", "escalating", "terminate", "Error"):
        assert word not in output, output


def test_a_node_that_waits_for_others_ends_cleanly(office: Office, tmp_path: Path) -> None:
    command = office.server("-p", "mailbox.rebecs:=[s, ghost]", "-p", "use_sim_time:=true")
    environment = office.workspace.environment(tmp_path)
    process = subprocess.Popen(
        command,
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    time.sleep(4)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert "Traceback" not in errors
    assert process.returncode == 0
