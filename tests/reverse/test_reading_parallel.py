"""Many packages in several processes: in their order, and none lost."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from rebsync.diagnostics import RebsyncError
from rebsync.reverse.files import parallel
from rebsync.reverse.files.parallel import each
from rebsync.reverse.files.reading import Chosen, all_listings

NODE = '#include <ros/ros.h>\nint main() { ros::init("x"); }\n'
COUNT = 24


@pytest.fixture(autouse=True)
def processes(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if there were two processors, and little were enough for two processes."""
    monkeypatch.setattr(parallel, "processors", lambda: 2)
    monkeypatch.setattr(parallel, "ENOUGH", 100)


@pytest.fixture
def packages(tmp_path: Path) -> Path:
    for number in range(COUNT):
        folder = tmp_path / f"p{number:02}"
        folder.mkdir()
        (folder / "package.xml").write_text("<package/>")
        (folder / "n.cpp").write_text(NODE)
    return tmp_path


def named(given: Chosen) -> tuple[str, int]:
    return Path(given.root).name, os.getpid()


def refusing(given: Chosen) -> str:
    if given.root.endswith("p07"):
        raise RebsyncError.of(given.root, "RS806", "no")
    return given.root


def dying(given: Chosen) -> str:
    if given.root.endswith("p05"):
        os.kill(os.getpid(), signal.SIGKILL)
    return given.root


def test_the_order_is_that_of_the_packages(packages: Path) -> None:
    found = list(each(all_listings([str(packages)]), named))
    assert [name for name, _ in found] == [f"p{n:02}" for n in range(COUNT)]
    assert os.getpid() not in {process for _, process in found}


def test_one_package_needs_no_process(packages: Path) -> None:
    assert list(each(all_listings([str(packages / "p03")]), named)) == [("p03", os.getpid())]


def test_little_needs_no_process(packages: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parallel, "ENOUGH", 1 << 20)
    found = list(each(all_listings([str(packages)]), named))
    assert ({process for _, process in found}, len(found)) == ({os.getpid()}, COUNT)


def test_errors_come_where_the_package_comes(packages: Path) -> None:
    found = []
    with pytest.raises(RebsyncError):
        for root in each(all_listings([str(packages)]), refusing):
            found.append(Path(root).name)
    assert found == [f"p{n:02}" for n in range(7)]


def test_a_process_that_dies_is_told_with_its_package(packages: Path) -> None:
    found = []
    with pytest.raises(RebsyncError) as error:
        for root in each(all_listings([str(packages)]), dying):
            found.append(Path(root).name)
    assert found == [f"p{n:02}" for n in range(5)]
    assert "ended the process" in error.value.findings[0].diagnostics[0].message
    assert error.value.findings[0].source.path.endswith("p05")


def test_what_is_not_asked_for_is_given_up(packages: Path) -> None:
    for name, _ in each(all_listings([str(packages)]), named):
        assert name == "p00"
        break
