"""Whatever goes wrong around a sync, it says so, and nothing that a user has written is lost."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.run import environment
from tests.roundtrip.faults.faults import ALIKE, Fault, faults, of_code, outcome
from tests.roundtrip.faults.interruptions import ACTIONS, KILLED, Action, Stop, tried, whole
from tests.roundtrip.faults.package import PATROLS, Snapshot, copied, prepare, run, snapshot

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system cannot fork")


_OTHERS = [dialect for dialect in PATROLS if dialect != "ros1-cpp"]


def _prepared(factory: pytest.TempPathFactory, dialect: str) -> Path:
    folder = factory.mktemp("faults") / "made"
    folder.mkdir()
    prepare(folder, PATROLS[dialect])
    return folder


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A package that model and code have both moved away from."""
    return _prepared(tmp_path_factory, "ros1-cpp")


@pytest.fixture(scope="module")
def wanted(made: Path) -> Snapshot:
    """The same in step."""
    folder = copied(made, made.parent / "wanted")
    assert run(folder, "sync").status == 0
    return snapshot(folder)


@pytest.mark.parametrize("fault", faults(PATROLS["ros1-cpp"]), ids=lambda f: f.name)
def test_faults(fault: Fault, made: Path, tmp_path: Path) -> None:
    _, wrong = outcome(fault, made, tmp_path / "tried")
    assert wrong == []


# `python -m tests.roundtrip.faults` stops at every operation, and makes every fault, in a dialect.
@pytest.mark.parametrize("number", [*range(1, 82, 12), 70, 76, 81])
@pytest.mark.parametrize("is_killed", [True, False], ids=["killed", "failed"])
def test_a_sync_that_stops_anywhere(
    number: int, is_killed: bool, made: Path, wanted: Snapshot, tmp_path: Path
) -> None:
    done = tried(made, wanted, tmp_path / "tried", Stop(number, is_killed))
    assert done.wrong == ()
    assert done.ended.status == KILLED if is_killed else done.ended.status in (0, 2)


@pytest.mark.parametrize("action", ACTIONS[1:], ids=lambda a: a.name)
def test_another_command_that_stops_anywhere(action: Action, made: Path, tmp_path: Path) -> None:
    wanted, _ = whole(action, made, tmp_path / "tried")
    for number in (3, 14, 23):
        for is_killed in (True, False):
            done = tried(made, wanted, tmp_path / "tried", Stop(number, is_killed, action))
            assert done.wrong == ()


@pytest.mark.parametrize("dialect", _OTHERS)
def test_the_other_dialects(dialect: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    patrol, package = PATROLS[dialect], _prepared(tmp_path_factory, dialect)
    folder = package.parent / "tried"
    is_whole = dialect == "mixed"  # what happens to files is the same whatever is in them
    own = [f for f in faults(patrol) if f not in ALIKE] if is_whole else of_code(patrol)
    told = {f.name: outcome(f, package, folder, patrol)[1] for f in own}
    assert {name: wrong for name, wrong in told.items() if wrong} == {}
    for action in ACTIONS[:2] if is_whole else ():
        wanted, _ = whole(action, package, folder)
        for stop in (Stop(7, True, action), Stop(24, True, action), Stop(24, False, action)):
            assert tried(package, wanted, folder, stop).wrong == ()


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
