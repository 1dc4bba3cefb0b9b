"""The run-time part as a package of ROS 2 that another one builds on, with what Debian has."""

from __future__ import annotations

import os
from pathlib import Path

from rebsync.config import Config
from rebsync.forward.runtime_package import NAME, runtime_packages
from tests.forward.compiling import generated, written
from tests.ros2.building import STUB
from tests.ros2.test_build import _PREFIX, _SCHEMA, _STUBS, _linted, _run

_ROOT = Path(__file__).parents[2]
_NAME, _TARGET = "hello", "ros2-cpp"


def _workspace(folder: Path) -> tuple[Path, Path]:
    """A package that depends on the run-time part, and that."""
    config = Config(target=_TARGET, shared_runtime=True)
    text = (_ROOT / "examples" / _NAME / f"{_NAME}.rebeca").read_text(encoding="utf-8")
    package = written(generated(text, _NAME, config), folder, _NAME, config)
    for path, content in runtime_packages(_TARGET).items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(content)
    return folder / NAME, package


def test_ament_builds_it_and_what_depends_on_it(headers: Path, tmp_path: Path) -> None:
    prefix = tmp_path / "install"
    stubs = [*_STUBS, "rosidl_default_generators", "rosidl_default_runtime"]
    options = (
        *(f"-D{name}_DIR={_PREFIX}" for name in stubs),
        *(f"-DREBSYNC_STUB={STUB / 'include'}", f"-DREBSYNC_HEADERS={headers}"),
        *("-DPython3_EXECUTABLE=/usr/bin/python3", "-DPYTHON_EXECUTABLE=/usr/bin/python3"),
        *(f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_INSTALL_PREFIX={prefix}"),
        *("-DBUILD_TESTING=OFF", "-DCMAKE_CXX_FLAGS=-Werror"),
    )
    for package in _workspace(tmp_path / "src"):
        build = tmp_path / "build" / package.name
        _run("cmake", "-S", package, "-B", build, *options)
        _run("cmake", "--build", build, "--parallel", "2")
        _run("cmake", "--install", build)
    assert (prefix / "include" / NAME / NAME / "mailbox.hpp").exists()
    assert os.access(prefix / "lib" / _NAME / "walker_node", os.X_OK)


def test_linters_are_content(tmp_path: Path) -> None:
    shared, package = _workspace(tmp_path)
    for each in (shared, package):
        _linted("xmllint", "--noout", "--nonet", "--schema", _SCHEMA, each / "package.xml")
        _linted("ament_lint_cmake", each / "CMakeLists.txt")
        _linted("ament_cpplint", "--filters=-legal/copyright", each / "include")
