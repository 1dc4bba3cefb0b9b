"""`rebsync doctor`: what this machine has of what rebsync and its packages can use."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from importlib.util import find_spec

import click

from rebsync.cli.status import Status
from rebsync.records import dataclass
from rebsync.terminal import say_lines


@dataclass(frozen=True, slots=True)
class Tool:
    """Programs of which one is enough, or modules of Python; what for, and how to get it."""

    names: tuple[str, ...]
    purpose: str
    install: str
    is_module: bool = False

    @property
    def found(self) -> str | None:
        """Where it is, or its name if it is a module."""
        if self.is_module:
            return next((name for name in self.names if find_spec(name) is not None), None)
        return next(filter(None, map(shutil.which, self.names)), None)


TOOLS = {
    "for rebsync itself": (
        Tool(("cc", "gcc", "clang"), "verify searches large state spaces in C", "a C compiler"),
        Tool(("git",), "check, sync and diff know revisions and repositories", "git"),
        Tool(("z3",), "check proves that edited bodies do the same", "pip install z3-solver", True),
        Tool(("rosbags",), "conform reads bags", "pip install 'rebsync[bags]'", True),
        Tool(("pygls",), "lsp serves editors", "pip install 'rebsync[lsp]'", True),
        Tool(("watchfiles",), "watch notices saved files", "pip install 'rebsync[watch]'", True),
        Tool(("dot",), "draws what graph --format dot writes", "Graphviz"),
    ),
    "for the packages that it generates": (
        Tool(("catkin_make", "catkin"), "builds packages of ROS 1", "ROS 1"),
        Tool(("catkin_pkg",), "catkin needs it in its Python", "pip install catkin_pkg", True),
        Tool(("roslaunch",), "starts packages of ROS 1", "ROS 1"),
        Tool(("colcon",), "builds packages of ROS 2", "ROS 2"),
        Tool(("ros2",), "starts packages of ROS 2", "ROS 2"),
        Tool(("c++", "g++", "clang++"), "compiles nodes in C++", "a C++ compiler"),
        Tool(("cmake",), "configures packages in C++", "cmake"),
    ),
}


@click.command("doctor")
def command() -> Status:
    """Tell which programs and libraries are found, and what each is for.

    None of them is needed to lint, generate, extract, check and verify; without a C compiler large
    state spaces take longer.
    """
    say_lines(_lines())
    return Status.CLEAN


def _lines() -> Iterator[str]:
    distribution = os.environ.get("ROS_DISTRO")
    yield f"ROS: {distribution} is sourced" if distribution else "ROS: none is sourced"
    for purpose, tools in TOOLS.items():
        yield ""
        yield purpose
        for tool in tools:
            where = tool.found
            name = tool.names[0]
            said = where if where is not None else f"not found: {tool.install}"
            yield f"  {name:12} {said:44} {tool.purpose}"
