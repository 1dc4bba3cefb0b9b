"""The launch files of all packages that were read, and what they start."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field

from rebsync.records import dataclass
from rebsync.reverse.files.python_files import is_launch, is_launch_of_ros_2
from rebsync.reverse.launch.launch_files import read_launch
from rebsync.reverse.launch.launch_files_ros2 import read_ros2_launch, speaks_ros_2
from rebsync.reverse.launch.launch_values import Surroundings
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.launch.ros2_words import SHARE
from rebsync.rosgraph.ends import PackageCode
from rebsync.source import Source


@dataclass(slots=True)
class LaunchFiles:
    """Reads launch files with all that other packages have beside them."""

    packages: Sequence[PackageCode]
    _by_name: dict[str, Mapping[str, Source]] = field(default_factory=dict)
    _by_path: dict[str, Source] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for package in self.packages:
            self._by_name.setdefault(package.name, package.files)
            for source in package.files.values():
                self._by_path[os.path.realpath(source.path)] = source

    def all(self) -> Iterator[tuple[PackageCode, Source]]:
        """Those that are started by themselves, each with its package."""
        for package in self.packages:
            for path, source in sorted(package.files.items()):
                is_known = not is_launch_of_ros_2(path) or speaks_ros_2(source)
                is_whole = not path.endswith(".py") or "LaunchDescription" in source.text
                if is_launch(path) and is_known and is_whole:
                    yield package, source

    def named(self, path: str) -> tuple[PackageCode, str] | None:
        """The package and the path in it of a launch file: on the disk, or `package/file`."""
        every = [(package, inside) for package in self.packages for inside in package.files]
        real = os.path.realpath(path)
        for package, inside in every:
            if os.path.realpath(package.files[inside].path) == real:
                return package, inside
        ends = [(p, i) for p, i in every if f"/{p.name}/{i}".endswith(f"/{path}")]
        return ends[0] if len(ends) == 1 else None

    def read(self, package: PackageCode, source: Source) -> Launch:
        """What a launch file and all that it includes start."""
        if speaks_ros_2(source):
            return read_ros2_launch(source, package.files.get, package.name, self._elsewhere)
        return read_launch(source, Surroundings(self._load, self._find))

    def _find(self, package: str) -> str | None:
        return f"/{package}" if package in self._by_name else None

    def _load(self, path: str) -> Source | None:
        package, _, inside = path.lstrip("/").partition("/")
        found = self._by_name.get(package, {}).get(inside)
        return found or self._by_path.get(os.path.realpath(path))

    def _elsewhere(self, path: str) -> Source | None:
        if path.startswith(SHARE):
            return self._load(path.removeprefix(SHARE))
        return self._by_path.get(os.path.realpath(path))
