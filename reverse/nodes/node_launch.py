"""Which of the launch files of a package is the system that the model is of."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from functools import partial

from rebsync.records import dataclass
from rebsync.reverse.files.packages import BESIDE
from rebsync.reverse.files.python_files import is_launch_of_ros_2
from rebsync.reverse.findings import Findings
from rebsync.reverse.launch.launch_files import read_launch
from rebsync.reverse.launch.launch_files_ros2 import read_ros2_launch, speaks_ros_2
from rebsync.reverse.launch.launch_values import Surroundings
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.launch.ros2_words import SHARE
from rebsync.reverse.nodes.node_components import executables
from rebsync.reverse.nodes.node_presence import STAND_IN
from rebsync.reverse.nodes.node_programs import Program
from rebsync.source import NOWHERE, Source, Span

_ELSEWHERE = (
    "no launch file starts a program of these files: the model has one rebec for each object"
)
_HINT = "name the launch file instead of the package to have its system"


_PLAIN = LaunchedNode(
    "", "/", "", "", (), (), (), None, False, False, (), (), Source("", ""), NOWHERE
)


@dataclass(frozen=True, slots=True)
class System:
    """What one launch file and those that it includes start; `others` start something else.

    `starts` says whether any of it is C++ of the package.
    """

    launch: Launch
    others: tuple[tuple[Source, Launch], ...]
    starts: bool = True

    def beside(self, program: str) -> System:
        """The system with another program of Python that has a node of its own name."""
        node = replace(_PLAIN, name=program, type=f"{program}.py", source=self.launch.sources[0])
        return replace(self, launch=replace(self.launch, nodes=(*self.launch.nodes, node)))

    def note(self, findings: Findings, in_python: bool) -> None:
        """Lists the systems that the model is not of.

        `in_python` says that it starts generated classes, and no C++ beside it is written by hand.
        """
        if not self.starts and not in_python and self.launch.nodes:
            first = self.launch.nodes[0]
            findings.assumed(first.source, first.span, _ELSEWHERE)
            return
        for source, launch in self.others:
            own = (node.span for node in launch.nodes if node.source is source)
            span = next(own, Span(0, 0))  # it may only include
            path = self.launch.sources[0].path.rpartition("/")[2]
            why = f'this file starts another system than "{path}", which the model is of'
            findings.assumed(source, span, why, _HINT)


def system_of(
    files: Mapping[str, Source],
    package: str,
    only: str | None = None,
    programs: Sequence[Program] = (),
) -> System | None:
    """The system of a package: the launch file that is asked for, or that starts most of it.

    That is first of all most of its `programs` but those that stand in for sensors: what else it
    starts is no C++.
    """

    def load(path: str) -> Source | None:
        return files.get(path.removeprefix("/"))

    def find(name: str) -> str:
        return "" if name == package or not package else f"/{BESIDE}{name}"

    surroundings = Surroundings(load, find)
    paths = [only] if only is not None else sorted(p for p in files if _is_system(p, files[p]))
    read = [(files[p], _read(files[p], surroundings, package)) for p in paths]
    if not read:
        return None
    nodes = (p for p in programs if not p.name.endswith(STAND_IN))
    names = {name for p in nodes for name in (p.name, p.stem)}
    names = names.union(*executables(files).values())
    best = max(read, key=lambda each: (_known(each[1], names), _size(each[1], package)))
    included = {id(s) for s in best[1].sources}
    others = [
        (s, launch)
        for s, launch in read
        if id(s) not in included
        and _size(launch, package)
        and not _is_same(launch, best[1], package)
    ]
    whole = {id(s) for _, launch in others for s in launch.sources[1:]}
    starts = only is not None or not names or _known(best[1], names) > 0
    return System(best[1], tuple(each for each in others if id(each[0]) not in whole), starts)


def _known(launch: Launch, names: Collection[str]) -> int:
    """How many nodes it starts that are among the programs, or nodelets."""
    return sum(not n.test and (n.type in names or n.nodelet is not None) for n in launch.nodes)


def _is_same(launch: Launch, other: Launch, package: str) -> bool:
    """Whether two launch files start the same nodes of a package, be it with another clock."""
    ours, theirs = ([n for n in each.nodes if n.package == package] for each in (launch, other))
    same = [*map(_started, ours)], [*map(_started, theirs)]
    return len(same[0]) == len(same[1]) and all(each in same[1] for each in same[0])


def _started(node: LaunchedNode) -> tuple[object, ...]:
    """What a node is started with."""
    values = {p.name: p.value for p in node.parameters if p.name != "use_sim_time"}
    remaps = [(r.private, r.target) for r in node.remaps]
    return node.path, node.package, node.type, values, remaps, node.arguments, node.only_if


def _is_system(path: str, source: Source) -> bool:
    """Whether a file is a launch file that is started by itself.

    In ROS 1 `x.launch.xml` is the name of those that others include.
    """
    is_ros_2 = is_launch_of_ros_2(path) and speaks_ros_2(source)
    return not path.startswith(BESIDE) and (path.endswith(".launch") or is_ros_2)


def _read(source: Source, surroundings: Surroundings, package: str) -> Launch:
    if speaks_ros_2(source):
        return read_ros2_launch(source, surroundings.load, package, partial(_shared, surroundings))
    return read_launch(source, surroundings)


def _shared(surroundings: Surroundings, path: str) -> Source | None:
    """A file that another package of the workspace shares."""
    is_shared = path.startswith(SHARE)
    return surroundings.load(f"{BESIDE}{path.removeprefix(SHARE)}") if is_shared else None


def _size(launch: Launch, package: str) -> int:
    """How many nodes of the package it starts."""
    of_package = (n for n in launch.nodes if not package or n.package in (package, "nodelet"))
    return sum(not n.test for n in of_package)
