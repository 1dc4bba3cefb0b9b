"""Builds ROS 1 packages with the system's catkin, all in one workspace, once per content."""

from __future__ import annotations

import fcntl
import hashlib
import os
import shutil
import subprocess
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

SYSTEM_PATH = "/usr/bin:/bin"
SYSTEM_PYTHON = "/usr/bin/python3"
# What every source of a package begins with takes half the time of compiling it: it is compiled
# once. g++ takes it where all else is the same, and reads the headers again where it is not.
_COMMON = """\
#include <condition_variable>
#include <random>
#include <thread>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
"""
_AS_CATKIN = (
    *("-std=gnu++14", "-Wpedantic", "-fPIC", "-fwrapv", "-I/usr/include/xmlrpcpp"),
    *("-DROSCONSOLE_BACKEND_LOG4CXX", "-DROS_BUILD_SHARED_LIBS=1"),
)


class BuildError(Exception):
    """catkin could not build the packages; the text is its output."""


@dataclass(frozen=True, slots=True)
class Workspace:
    """A built catkin workspace.

    `rate` is the greatest speed of the clock that its nodes can follow, `step` how far it goes at
    once then, in seconds.
    """

    root: Path
    rate: float = 1000.0
    step: float = 0.0

    @property
    def devel(self) -> Path:
        """What a user of the workspace sources."""
        return self.root / "devel"

    def executable(self, package: str, name: str) -> Path:
        """A node of a package."""
        return self.devel / "lib" / package / name

    def environment(self, **more: str) -> dict[str, str]:
        """The variables that `source devel/setup.bash` sets, and nothing of the caller's."""
        paths = [self.devel, Path("/usr")]
        return {
            "PATH": SYSTEM_PATH,
            "HOME": os.environ.get("HOME", "/"),
            "LANG": "C.UTF-8",
            "CMAKE_PREFIX_PATH": ":".join(map(str, paths)),
            "LD_LIBRARY_PATH": str(self.devel / "lib"),
            "PYTHONPATH": f"{self.devel / 'lib/python3/dist-packages'}",
            "ROS_PACKAGE_PATH": f"{self.root / 'src'}:/usr/share",
            "ROS_ETC_DIR": "/etc/ros",
            "ROS_ROOT": "/usr/share/ros",
            "ROS_VERSION": "1",
            "ROS_DISTRO": "Debian",
            "ROS_PYTHON_VERSION": "3",
            **more,
        }


def missing_ros() -> str | None:
    """Why packages cannot be built and run here, or None."""
    needed = ("roslaunch", "catkin_make", "cmake", "g++")
    for tool in needed:
        if shutil.which(tool, path=SYSTEM_PATH) is None:
            return f"ROS 1 is not installed: no {tool}"
    headers = ("ros/ros.h", "geometry_msgs/Twist.h", "diagnostic_msgs/DiagnosticArray.h")
    for header in headers:
        if not Path("/usr/include", header).exists():
            return f"ROS 1 is not installed: no {header}"
    return None


def build(packages: Sequence[Path], root: Path, options: Sequence[str] = ()) -> Workspace:
    """Build package directories in the workspace at `root`; does nothing when nothing changed.

    CMake gets the options.
    """
    build_once(packages, root, lambda made: _make(made, options))
    return Workspace(root)


def build_once(packages: Sequence[Path], root: Path, make: Callable[[Path], None]) -> None:
    """Put package directories below `root/src` and make them, unless nothing changed."""
    files = {
        str(Path(package.name, path.relative_to(package))): path
        for package in packages
        for path in sorted(package.rglob("*"))
        if path.is_file()
    }
    digest = _digest(files)
    root.mkdir(parents=True, exist_ok=True)
    stamp = root / "built"
    with _locked(root / "lock"):
        if not stamp.exists() or stamp.read_text() != digest:
            stamp.unlink(missing_ok=True)
            _synchronise(files, root / "src")
            make(root)
            stamp.write_text(digest)


def _digest(files: Mapping[str, Path]) -> str:
    contents = [(name, os.access(path, os.X_OK), path.read_bytes()) for name, path in files.items()]
    return hashlib.sha256(repr(sorted(contents)).encode()).hexdigest()


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    with path.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def _synchronise(files: Mapping[str, Path], source: Path) -> None:
    """Make `source` hold just these files; what is the same keeps its time, so make skips it."""
    source.mkdir(exist_ok=True)
    for path in sorted(source.glob("*/**/*"), reverse=True):
        if path.is_dir() and not any(path.iterdir()):
            path.rmdir()
        elif path.is_file() and str(path.relative_to(source)) not in files:
            path.unlink()
    for name, original in files.items():
        path = source / name
        if not path.exists() or path.read_bytes() != original.read_bytes():
            path.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(original, path)


def _make(root: Path, options: Sequence[str]) -> None:
    has_cpp = any((root / "src").rglob("*.cpp"))
    flags = "-Werror"
    if has_cpp:
        # The name of the package, which only logging asks for, is the one thing that differs.
        flags += f" -fPIC -UROS_PACKAGE_NAME -include {_common(root.parent)}"
    command = [
        *("catkin_make", "-C", str(root), "-j2"),
        *(f"-DPYTHON_EXECUTABLE={SYSTEM_PYTHON}", "-DCATKIN_ENABLE_TESTING=OFF"),
        f"-DCMAKE_CXX_FLAGS={flags}",
        *options,
    ]
    _run(command, ROS_LANG_DISABLE="genlisp" if has_cpp else "genlisp:gencpp")


def _common(folder: Path) -> Path:
    """The header that is compiled once for all workspaces of a folder."""
    header = folder / "common.h"
    with _locked(folder / "common.lock"):
        if not Path(f"{header}.gch").exists():
            header.write_text(_COMMON)
            made = folder / "common.gch.part"
            _run(["g++", *_AS_CATKIN, "-x", "c++-header", str(header), "-o", str(made)])
            made.rename(f"{header}.gch")
    return header


def _run(command: Sequence[str], **more: str) -> None:
    environment = {"PATH": SYSTEM_PATH, "HOME": os.environ.get("HOME", "/"), "LANG": "C.UTF-8"}
    done = subprocess.run(
        command,
        env={**environment, **more},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if done.returncode != 0:
        raise BuildError(done.stdout)
