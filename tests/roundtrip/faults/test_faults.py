"""Whatever goes wrong around a sync, it says so, and nothing that a user has written is lost."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.run import environment
from tests.roundtrip.faults.faults import FAULTS, Fault, outcome
from tests.roundtrip.faults.interruptions import KILLED, Stop, tried
from tests.roundtrip.faults.package import Snapshot, copied, prepare, run, snapshot

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system cannot fork")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A package that model and code have both moved away from."""
    folder = tmp_path_factory.mktemp("faults") / "made"
    folder.mkdir()
    prepare(folder)
    return folder


@pytest.fixture(scope="module")
def wanted(made: Path) -> Snapshot:
    """The same in step."""
    folder = copied(made, made.parent / "wanted")
    assert run(folder, "sync").status == 0
    return snapshot(folder)


@pytest.mark.parametrize("fault", FAULTS, ids=lambda f: f.name)
def test_faults(fault: Fault, made: Path, tmp_path: Path) -> None:
    _, wrong = outcome(fault, made, tmp_path / "tried")
    assert wrong == []


# `python -m tests.roundtrip.faults` stops at every operation.
@pytest.mark.parametrize("number", [*range(1, 86, 12), 74, 80])
@pytest.mark.parametrize("is_killed", [True, False], ids=["killed", "failed"])
def test_a_sync_that_stops_anywhere(
    number: int, is_killed: bool, made: Path, wanted: Snapshot, tmp_path: Path
) -> None:
    done = tried(made, wanted, tmp_path / "tried", Stop(number, is_killed))
    assert done.wrong == ()
    assert done.ended.status == KILLED if is_killed else done.ended.status in (0, 2)


def test_several_at_once(made: Path, wanted: Snapshot, tmp_path: Path) -> None:
    folder = copied(made, tmp_path / "tried")
    many = [
        subprocess.Popen(
            [sys.executable, "-m", "rebsync", "sync"],
            cwd=folder,
            env=environment() | {"REBSYNC_CACHE": str(folder / ".cache")},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        for _ in range(3)
    ]
    told = [each.communicate()[0].decode() for each in many]
    assert [each.returncode for each in many] == [0] * 3, told
    assert snapshot(folder) == wanted
