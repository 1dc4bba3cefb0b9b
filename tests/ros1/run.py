"""Runs a launch file on a roscore of its own, with a simulated clock, and records what happens."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import uuid
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from tests.ros1.recording import Recording, read_recording
from tests.ros1.workspace import SYSTEM_PYTHON, Workspace

_RECORDER = Path(__file__).parent / "nodes" / "recorder.py"
_STOP = 25.0


@dataclass(frozen=True, slots=True)
class Clock:
    """How the clock runs, until a time of the model or until nothing was served for a while.

    `rate` is model seconds in a second at the most, or None for the real clock; times are in
    seconds. Its nodes are never behind it, however busy the machine is.
    """

    until: float = 60.0
    quiet: float = 10.0
    rate: float | None = 100.0
    step: float = 0.02
    settle: float = 0.3
    startup: float = 15.0
    timeout: float = 180.0


USUAL = Clock()


class RunError(Exception):
    """The run did not come to its end; the text is what the launcher and the recorder said."""


def run(
    workspace: Workspace,
    launch: Path,
    directory: Path,
    clock: Clock = USUAL,
    parameters: Mapping[str, Any] | None = None,
) -> Recording:
    """Run a launch file to the end of `clock`; `parameters` overrule those of the file."""
    clock = _followed(clock, workspace)
    port, environment = ros_environment(workspace, directory)
    wrapper = directory / "wrapper.launch"
    wrapper.write_text(_wrapper(launch, clock, parameters or {}))
    nodes = subprocess.run(
        ["roslaunch", "--nodes", str(wrapper)],
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    ).stdout.split()
    command = ["roslaunch", "--skip-log-check", "-p", str(port), str(wrapper)]
    with launched(command, directory, environment) as stop:
        return record(_RECORDER, {"nodes": nodes}, clock, directory, environment, stop)


def ros_environment(workspace: Workspace, directory: Path) -> tuple[int, dict[str, str]]:
    """The port of a roscore of its own, and the variables of what belongs to it."""
    port = _free_port()
    return port, workspace.environment(
        ROS_MASTER_URI=f"http://127.0.0.1:{port}",
        ROS_IP="127.0.0.1",
        ROS_HOME=str(directory / "home"),
        ROSCONSOLE_STDOUT_LINE_BUFFERED="1",
    )


def _followed(clock: Clock, workspace: Workspace) -> Clock:
    """The clock, no faster than the nodes can follow."""
    if clock.rate is None:
        return clock
    step, rate = max(clock.step, workspace.step), min(clock.rate, workspace.rate)
    return replace(clock, rate=rate, step=step)


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _wrapper(launch: Path, clock: Clock, parameters: Mapping[str, Any]) -> str:
    simulated = str(clock.rate is not None).lower()
    overruling = [
        f'  <rosparam param="{name}">{json.dumps(value)}</rosparam>\n'
        for name, value in parameters.items()
    ]
    return (
        f'<launch>\n  <param name="/use_sim_time" value="{simulated}"/>\n'
        f'  <include file="{launch}"/>\n{"".join(overruling)}</launch>\n'
    )


@contextmanager
def launched(
    command: Sequence[str], directory: Path, environment: Mapping[str, str]
) -> Iterator[Callable[[], None]]:
    """A launcher while the block runs; gives the function that stops it, as Ctrl-C does."""
    output = directory / "output"
    mark = f"REBSYNC_TEST_RUN={uuid.uuid4()}"
    with output.open("w") as file:
        process = subprocess.Popen(
            command,
            env={**environment, **dict([mark.split("=")])},
            stdout=file,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )

    def stop() -> None:
        if process.poll() is None:
            _interrupt(process)
        left = _marked(mark)
        for number in left:
            with suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)
        if left:
            raise RunError(f"processes {left} outlived {command[0]}:\n{output.read_text()}")

    try:
        yield stop
    finally:
        stop()


def _interrupt(process: subprocess.Popen[bytes]) -> None:
    process.send_signal(signal.SIGINT)
    try:
        process.wait(_STOP)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _marked(mark: str) -> list[int]:
    """The processes that this run started: their environment has its mark."""
    return [int(e.parent.name) for e in Path("/proc").glob("[0-9]*/environ") if mark in _read(e)]


def _read(environment: Path) -> list[str]:
    try:
        return environment.read_text(errors="replace").split("\0")
    except OSError:
        return []


def record(
    recorder: Path,
    facts: Mapping[str, Any],
    clock: Clock,
    directory: Path,
    environment: Mapping[str, str],
    stop: Callable[[], None],
) -> Recording:
    """What a recorder, told these facts, hears until the end of `clock` and while nodes stop."""
    out, config = directory / "recording.jsonl", directory / "recorder.json"
    config.write_text(json.dumps({**asdict(clock), **facts, "out": str(out)}))
    process = subprocess.Popen(
        [SYSTEM_PYTHON, str(recorder), str(config)],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert process.stdout is not None
    try:
        done = process.stdout.readline()
        stop()
        _, errors = process.communicate(timeout=_STOP)
    finally:
        process.kill()
        process.wait()
    output = (directory / "output").read_text()
    if done != "done\n":
        raise RunError(f"{errors}\n{output}")
    return read_recording(out, output)
