"""What the tests on a real ROS 2 share: packages that colcon has built."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.retrying import pytest_runtest_setup
from tests.ros1.conftest import shared
from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros2.launching import launched
from tests.ros2.test_mailbox import MODEL
from tests.ros2real.running import run
from tests.ros2real.workspace import Workspace, build, missing_ros2

__all__ = ["pytest_runtest_setup"]

_HERE = Path(__file__).parent
_TIMEOUT = 1800  # s: the first test of a package builds it
_BUSIEST = 16.0  # processes for a processor, above which the clock is not slowed down further
DIALECTS = ("ros2-cpp", "ros2-py")


class Builder(Protocol):
    """Builds the packages in a folder in a workspace of the given name, upon another one."""

    def __call__(self, folder: Path, name: str, below: Workspace | None = None) -> Workspace: ...


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark what is here; skip it, loudly, where no ROS 2 is sourced: Debian has none."""
    reason = missing_ros2()
    asked: int | None = config.getoption("reruns", None)
    reruns = 2 if asked is None else asked
    for item in items:
        if _HERE not in item.path.parents:
            continue
        item.add_marker(pytest.mark.ros2)
        # On a busy machine real nodes may be too late for the clock of a test: it is tried again.
        item.add_marker(pytest.mark.flaky(reruns=reruns))
        item.add_marker(pytest.mark.timeout(_TIMEOUT))
        if reason is not None:
            item.add_marker(pytest.mark.skip(reason=reason))


@pytest.fixture(scope="session")
def build_real(tmp_path_factory: pytest.TempPathFactory) -> Builder:
    """Builds packages.

    REBSYNC_ROS_WORKSPACE names a directory that keeps workspaces from run to run.
    """
    kept = os.environ.get("REBSYNC_ROS_WORKSPACE")
    root = Path(kept) if kept else shared(tmp_path_factory)
    return lambda folder, name, below=None: build(folder, root / "ros2" / name, below)


@dataclass(frozen=True)
class Play:
    """Builds the package in a folder, of a dialect, and runs its launch file."""

    build: Builder
    factory: pytest.TempPathFactory

    def __call__(
        self, folder: Path, dialect: str, clock: Clock, beside: Sequence[Path] = ()
    ) -> Recording:
        name = folder.name
        workspace = self.build(folder, f"{name}_{dialect}")
        package = folder / name if dialect == "ros2-py" else folder
        return self.launched(workspace, package, dialect, clock, beside)

    def launched(
        self,
        workspace: Workspace,
        package: Path,
        dialect: str,
        clock: Clock,
        beside: Sequence[Path] = (),
    ) -> Recording:
        """Run the launch file of a package that has been built."""
        name, nodes = package.name, launched(package)
        rebecs = [n.name for n in nodes if "mailbox.rebecs" in n.parameters]
        launch = workspace.root / "install/share" / name / "launch" / f"{name}.launch.py"
        names = [f"/{n.name}" for n in nodes]
        directory = self.factory.mktemp(name)
        clock = followed(clock, dialect)
        return run(workspace, launch, names, rebecs, directory, clock, beside)


@pytest.fixture(scope="session")
def play_real(build_real: Builder, tmp_path_factory: pytest.TempPathFactory) -> Play:
    """Builds packages and runs them."""
    return Play(build_real, tmp_path_factory)


def office(folder: Path, dialect: str) -> Path:
    """The package of the mailbox tests in a dialect, made in a folder."""
    config = Config(target=dialect)
    return written(generated(MODEL, "office", config), folder, "office", config)


def followed(clock: Clock, dialect: str) -> Clock:
    """The clock, no faster than the nodes of a dialect can follow on a machine this busy.

    What bears no stamp is stamped when the recorder hears it: late by the time that the two take to
    get a turn, and as many times later on the model's clock as that is faster.
    """
    if clock.rate is None:
        return clock
    busy = min(max(os.getloadavg()[0] / (os.cpu_count() or 1), 1.0), _BUSIEST)
    slow = replace(clock, startup=clock.startup * busy, timeout=clock.timeout * busy)
    if dialect != "ros2-py":
        return replace(slow, rate=clock.rate / busy)
    rate = min(clock.rate, 2.0)
    return replace(slow, rate=rate / busy, step=max(clock.step, rate / 100))
