"""`rebsync check` is quick where nothing has changed; runs at once do not disturb each other.

Times are those of modules that are compiled, as wherever `rebsync` is installed: a machine that
keeps no bytecode would compile ours for each run, and never those of click.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

from tests.cli.run import ROOT, environment

EXAMPLE = ROOT / "examples" / "experiment2"
CHECK = ("-m", "rebsync", "check")


needs_times = pytest.mark.skipif(
    not hasattr(os, "wait4"), reason="the system does not tell the time of other processes"
)


def processor_seconds(*arguments: str, cwd: Path, compiled: Path) -> float:
    """The time that a run of Python takes of a processor; its status must be 0."""
    env = environment() | {"PYTHONPYCACHEPREFIX": str(compiled), "PYTHONDONTWRITEBYTECODE": ""}
    process = subprocess.Popen(
        [sys.executable, *arguments], cwd=cwd, env=env, stdout=subprocess.DEVNULL
    )
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    return used.ru_utime + used.ru_stime


def ratio(folder: Path, tries: int, wanted: float) -> float:
    """How much longer a check takes than importing click: least times, until that is `wanted`.

    What else a machine does makes both longer, now this one, now the other.
    """
    start, taken = float("inf"), float("inf")
    seconds = partial(processor_seconds, cwd=folder, compiled=folder.parent / "compiled")
    for _ in range(tries):
        start = min(start, seconds("-c", "import click"))
        taken = min(taken, seconds(*CHECK))
        if taken < wanted * start:
            break
    return taken / start


@needs_times
def test_a_package_takes_little_more_than_the_start(tmp_path: Path) -> None:
    shutil.copytree(EXAMPLE, tmp_path / "all/one")
    assert ratio(tmp_path / "all", 20, 2.5) < 2.5


@needs_times
def test_many_packages_take_a_second(tmp_path: Path) -> None:
    """Where importing click takes 70 ms or more, as on the machines of CI; else less."""
    for number in range(200):
        shutil.copytree(EXAMPLE, tmp_path / f"all/robots{number}")
    assert ratio(tmp_path / "all", 6, 14) < 14


def test_runs_at_once_share_a_cache(tmp_path: Path) -> None:
    shutil.copytree(EXAMPLE, tmp_path / "one")
    source = tmp_path / "one/experiment2/src/r2.cpp"
    source.write_text(source.read_text().replace("stopped_ = true", "stopped_ = false"))
    env = environment() | {"REBSYNC_CACHE": str(tmp_path / "cache")}
    runs = [
        subprocess.Popen(
            [sys.executable, *CHECK, "one"],
            cwd=tmp_path,
            env=env,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        for _ in range(6)
    ]
    shown = {run.communicate()[0] for run in runs}
    assert {run.returncode for run in runs} == {1}
    assert len(shown) == 1, shown
    assert not list((tmp_path / "cache/values").glob(".*"))
