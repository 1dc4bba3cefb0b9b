"""The monitor on a real roscore: it accepts what was generated, and finds each edit at its step."""

from __future__ import annotations

import json
import os
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.forward.monitor_cases import CASES, ERROR, MODEL, OK, Case
from tests.ros1.conftest import DIALECTS, Build
from tests.ros1.run import launched, ros_environment
from tests.ros1.workspace import SYSTEM_PYTHON, Workspace

_EXAMPLE = Path(__file__).parents[2] / "examples" / "warehouse" / "warehouse.rebeca"
_LISTENER = Path(__file__).parent / "nodes" / "diagnostics.py"
_CONFIG = Config(monitor=True, time_unit=0.25)
_LONG = 60.0  # s, within which a monitor has to have said what it has to say
_IN_CPP = ("as generated", "lost send")  # of which packages are built, which takes minutes
_TRIED = [
    pytest.param(dialect, case, id=f"{dialect}-{case.name}")
    for dialect in DIALECTS
    for case in CASES
    if dialect != "ros1-cpp" or case.name in _IN_CPP
]
_NUMBERS = {case.name: f"patrol{i}" for i, case in enumerate(CASES)}


@pytest.fixture(scope="module")
def workspace(
    dialect: str, build_workspace: Build, tmp_path_factory: pytest.TempPathFactory
) -> Workspace:
    """A package for each case, as generated, and edited; and one of an example."""
    folder = tmp_path_factory.mktemp("packages")
    config = replace(_CONFIG, target=dialect)
    packages = []
    for case in CASES:
        if dialect == "ros1-cpp" and case.name not in _IN_CPP:
            continue
        name = _NUMBERS[case.name]
        package = written(generated(MODEL, name, config), folder, name, config)
        if dialect == "ros1-py":
            case.edit_python(package / "src" / name)
        else:
            case.edit_cpp(package / "src")
        packages.append(package)
    if dialect == "ros1-py":
        files = generated(_EXAMPLE.read_text(encoding="utf-8"), _EXAMPLE.stem, config)
        packages.append(written(files, folder, _EXAMPLE.stem, config))
    return build_workspace(f"monitors_{dialect}", packages)


@pytest.mark.parametrize(("dialect", "case"), _TRIED, scope="session")
def test_the_monitor_says_what_is_wrong(
    case: Case, dialect: str, workspace: Workspace, build_workspace: Build, tmp_path: Path
) -> None:
    del build_workspace  # its tests are those of ROS 1
    package = _NUMBERS[case.name]
    port, environment = ros_environment(workspace, tmp_path)
    with _roscore(port, tmp_path, environment), _listening(tmp_path, environment) as heard:
        monitor = ["roslaunch", "--skip-log-check", package, "monitor.launch"]
        system = ["roslaunch", "--skip-log-check", package, f"{package}.launch"]
        with launched(monitor, _made(tmp_path / "monitor"), environment):
            _until(heard, lambda last: True)
            with launched(system, _made(tmp_path / "system"), environment):
                level = ERROR if case.rebec else OK
                statuses = _until(
                    heard, lambda s: s["level"] == level and int(s["facts"]["compared"]) > 12
                )
    case.check(statuses)


@pytest.mark.parametrize("dialect", ["ros1-py"], scope="session")
def test_an_example_is_monitored(
    dialect: str, workspace: Workspace, build_workspace: Build, tmp_path: Path
) -> None:
    """One with priorities, senders and deadlines. What it costs is printed (-s)."""
    del dialect, build_workspace
    port, environment = ros_environment(workspace, tmp_path)
    with _roscore(port, tmp_path, environment), _listening(tmp_path, environment) as heard:
        launch = ["roslaunch", "--skip-log-check", _EXAMPLE.stem]
        with launched([*launch, "monitor.launch"], _made(tmp_path / "monitor"), environment):
            _until(heard, lambda last: True)
            system = [*launch, f"{_EXAMPLE.stem}.launch"]
            with launched(system, _made(tmp_path / "system"), environment):
                process = _monitor_of(port)
                begun = time.monotonic(), _processor_time(process)
                statuses = _until(heard, lambda s: int(s["facts"]["compared"]) > 60)
                took = time.monotonic() - begun[0], _processor_time(process) - begun[1]
    last = statuses[-1]
    steps = int(last["facts"]["compared"])
    print(f"\n{steps} steps in {took[0]:.1f} s, {took[1]:.2f} s of processor time")
    assert (last["level"], steps > 60) == (OK, True), last
    assert ERROR not in [s["level"] for s in statuses]


def _monitor_of(port: int) -> int:
    """The process of the monitor that belongs to a roscore."""
    master = f"ROS_MASTER_URI=http://127.0.0.1:{port}\0"
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            words = (folder / "cmdline").read_bytes().split(b"\0")
            is_node = any(Path(w.decode(errors="replace")).name == "monitor_node" for w in words)
            if is_node and master.encode() in (folder / "environ").read_bytes():
                return int(folder.name)
    raise AssertionError("there is no monitor")


def _processor_time(process: int) -> float:
    """Seconds that a process has used."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _made(folder: Path) -> Path:
    folder.mkdir()
    return folder


@contextmanager
def _roscore(port: int, folder: Path, environment: Mapping[str, str]) -> Iterator[None]:
    with launched(["roscore", "-p", str(port)], _made(folder / "core"), environment):
        yield


@contextmanager
def _listening(folder: Path, environment: Mapping[str, str]) -> Iterator[Path]:
    out = folder / "diagnostics.jsonl"
    with subprocess.Popen(
        [SYSTEM_PYTHON, str(_LISTENER), str(out)],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        assert process.stdout is not None
        assert "ready\n" in process.stdout  # before that it waits for the master
        try:
            yield out
        finally:
            process.kill()


def _statuses(heard: Path) -> list[Mapping[str, Any]]:
    text = heard.read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines(keepends=True) if line.endswith("\n")]


def _until(heard: Path, holds: Callable[[Mapping[str, Any]], bool]) -> list[Mapping[str, Any]]:
    """The statuses up to the first that is awaited, or an error, or until it was long enough."""
    end = time.monotonic() + _LONG
    while time.monotonic() < end:
        found = _statuses(heard)
        if found and (holds(found[-1]) or found[-1]["level"] == ERROR):
            return found
        time.sleep(0.2)
    return _statuses(heard)
