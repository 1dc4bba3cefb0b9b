"""The files around the code, with the real tools of ROS 2 that Debian has."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.ros2.building import HERE, STUB, missing_rosidl
from tests.ros2.launching import launched
from tests.ros2.test_examples import package_of

_PREFIX = HERE / "prefix"
_SCHEMA = "/usr/share/ament_xmllint/xml-catalog/download.ros.org/schema/package_format3.xsd"
_STUBS = ("rclcpp", "rclcpp_components", "diagnostic_msgs", "geometry_msgs", "rcl_interfaces")
_NAME = "experiment2"


def _run(*command: str | Path) -> None:
    done = subprocess.run(
        [str(word) for word in command],
        env={"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8", "HOME": os.environ.get("HOME", "/")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert done.returncode == 0, done.stdout


_USER = """
cmake_minimum_required(VERSION 3.16)
project(user)
find_package(experiment2 REQUIRED)
add_executable(user main.cpp)
target_link_libraries(user experiment2::experiment2_nodes)
"""
_MAIN = """
#include <memory>
#include <experiment2/r1.hpp>
int main() { return std::make_shared<experiment2::R1>(rclcpp::NodeOptions()) == nullptr; }
"""


def test_ament_builds_and_installs_the_package(headers: Path, tmp_path: Path) -> None:
    package, build, prefix = package_of(_NAME, tmp_path), tmp_path / "build", tmp_path / "install"
    stubs = [*_STUBS, "rosidl_default_generators", "rosidl_default_runtime"]
    options = (
        *(f"-D{name}_DIR={_PREFIX}" for name in stubs),
        *(f"-DREBSYNC_STUB={STUB / 'include'}", f"-DREBSYNC_HEADERS={headers}"),
        *("-DPython3_EXECUTABLE=/usr/bin/python3", "-DPYTHON_EXECUTABLE=/usr/bin/python3"),
        "-DBUILD_TESTING=OFF",  # Debian has no ament_lint_auto
    )
    _run("cmake", "-S", package, "-B", build, f"-DCMAKE_INSTALL_PREFIX={prefix}", *options)
    _run("cmake", "--build", build, "--parallel", "2")
    _run("cmake", "--install", build)
    nodes = launched(package)
    user = tmp_path / "user"
    user.mkdir()
    (user / "CMakeLists.txt").write_text(_USER)
    (user / "main.cpp").write_text(_MAIN)
    shutil.rmtree(package)  # what is exported is what is installed
    _run("cmake", "-S", user, "-B", user / "build", f"-DCMAKE_PREFIX_PATH={prefix}", *options)
    _run("cmake", "--build", user / "build")
    for node in nodes:
        assert os.access(prefix / "lib" / _NAME / node.executable, os.X_OK)
    share = prefix / "share" / _NAME
    for installed in (f"launch/{_NAME}.launch.py", "config/params.yaml", "package.xml"):
        assert (share / installed).exists()
    assert (prefix / "lib" / f"lib{_NAME}_nodes.so").exists()


# --- linters ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return package_of("warehouse", tmp_path_factory.mktemp("linted"))


def _linted(tool: str, *arguments: str | Path) -> None:
    if shutil.which(tool, path="/usr/bin:/bin") is None:
        reason = f"no {tool}"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)
    _run(tool, *arguments)


def test_the_manifest_is_of_format_3(package: Path) -> None:
    if not Path(_SCHEMA).exists() and missing_rosidl() is not None:
        pytest.skip("no schema of package.xml")
    _linted("xmllint", "--noout", "--nonet", "--schema", _SCHEMA, package / "package.xml")


def test_lint_cmake_is_content(package: Path) -> None:
    _linted("ament_lint_cmake", package / "CMakeLists.txt")


def test_cpplint_is_content(package: Path) -> None:
    # The licence above each file is the user's to add.
    filters = "-legal/copyright"
    _linted("ament_cpplint", f"--filters={filters}", package / "src", package / "include")
