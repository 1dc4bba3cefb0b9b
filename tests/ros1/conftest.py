"""The workspace that the ROS 1 tests share."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path

import jinja2
import pytest

from tests.retrying import pytest_runtest_setup
from tests.ros1.workspace import SYSTEM_PATH, Workspace, build, missing_ros

__all__ = ["pytest_runtest_setup"]

_HERE = Path(__file__).parent
_TEMPLATES = _HERE.parents[1] / "forward" / "templates"
HEADERS = ("drive.h", "mailbox.h", "sensor.h", "startup.h", "values.h", "watchdog.h")
MODULES = {
    **{
        name: f"ros1_py/{name}.py" for name in ("drive", "mailbox", "sensor", "startup", "watchdog")
    },
    "values": "py/values.py",
}
DIALECTS = ("ros1-cpp", "ros1-py")

Build = Callable[[str, Sequence[Path]], Workspace]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what is here; skip it, loudly, where there is no ROS 1, except in CI.

    What a module does not try of all combinations of parameters (`is_tried`) is no test.
    """
    items[:] = [item for item in items if _HERE not in item.path.parents or _is_tried(item)]
    reason = missing_ros()
    for item in items:
        if _HERE not in item.path.parents or not {"probe", "build_workspace"} & set(
            getattr(item, "fixturenames", ())
        ):
            continue
        item.add_marker(pytest.mark.ros1)
        # The first test of a module builds its packages and plays them, on a clock that waits.
        item.add_marker(pytest.mark.timeout(900))
        # On a busy machine real nodes may be too late for the clock of a test: it is tried again,
        # and pytest says so.
        item.add_marker(pytest.mark.flaky(reruns=1))
        if reason is not None and os.environ.get("CI") != "true":
            item.add_marker(pytest.mark.skip(reason=reason))


def _is_tried(item: pytest.Item) -> bool:
    is_tried = getattr(getattr(item, "module", None), "is_tried", None)
    callspec = getattr(item, "callspec", None)
    return is_tried is None or callspec is None or bool(is_tried(callspec.params))


@pytest.fixture(scope="session")
def build_workspace(tmp_path_factory: pytest.TempPathFactory) -> Build:
    """Builds packages in a named workspace that all workers of a test run share.

    REBSYNC_ROS_WORKSPACE names a directory that keeps workspaces from run to run.
    """
    reason = missing_ros()
    if reason is not None:
        pytest.fail(reason)
    kept = os.environ.get("REBSYNC_ROS_WORKSPACE")
    root = Path(kept) if kept else shared(tmp_path_factory) / "ros1"
    return lambda name, packages: build(packages, root / name)


@pytest.fixture(scope="session", params=DIALECTS)
def dialect(request: pytest.FixtureRequest) -> str:
    """The dialect of the packages of a test."""
    return str(request.param)


@pytest.fixture(scope="session")
def probe(
    dialect: str, build_workspace: Build, tmp_path_factory: pytest.TempPathFactory
) -> Workspace:
    """The package whose rebecs run scripts, with the run-time part as it is now."""
    package = tmp_path_factory.mktemp("packages") / "probe"
    if dialect == "ros1-py":
        shutil.copytree(_HERE / "packages" / "probe_py", package)
        for name, path in MODULES.items():
            (package / "src" / "probe" / f"{name}.py").write_text(rendered(path, "probe"))
        (package / "scripts" / "script_node").chmod(0o644)  # as some file systems have it
        return build_workspace("probe_py", [package])
    shutil.copytree(_HERE / "packages" / "probe", package)
    for name in HEADERS:
        (package / "include" / "probe" / name).write_text(render(name, "probe"))
    return build_workspace("probe", [package])


def render(name: str, package: str) -> str:
    """A file of the run-time part of a package in C++."""
    return rendered(f"ros1_cpp/{name}", package)


def rendered(name: str, package: str) -> str:
    """A file of the run-time part of a package."""
    loader = jinja2.FileSystemLoader(_TEMPLATES)
    environment = jinja2.Environment(
        loader=loader,
        undefined=jinja2.StrictUndefined,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(f"{name}.j2").render(
        package=package,
        services=(),
        actions=(),
        timed=True,
        odometry="",
        lifecycle=False,
        node="rclcpp::Node",
    )


def shared(factory: pytest.TempPathFactory) -> Path:
    """A directory that is the same for every worker of pytest-xdist."""
    base = factory.getbasetemp()
    return base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base


def tool(name: str) -> str:
    """The path of a program; without it the test is skipped, and fails in CI."""
    path = shutil.which(name, path=SYSTEM_PATH)
    if path is None:
        message = f"{name} is not installed"
        if os.environ.get("CI") == "true":
            pytest.fail(message)
        pytest.skip(message)
    return path
