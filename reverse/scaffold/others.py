"""What nodes of other packages and commands are handed: texts that may be names of topics.

Nobody knows what such a node does with a text: it may publish under it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator

from rebsync.reverse.launch.launch_files import read_launch
from rebsync.reverse.launch.launch_files_ros2 import read_ros2_launch, speaks_ros_2
from rebsync.reverse.launch.launch_values import Surroundings
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.launch.parameters import ParameterValue
from rebsync.reverse.scaffold.fact import HANDED, OPEN, PARAMETERS, UNKNOWN, Fact, is_of_runtime
from rebsync.reverse.unknowns import Open, Text
from rebsync.source import Source, Span

Load = Callable[[str], "Source | None"]

_LAUNCH = re.compile(r"\.launch(?:\.py|\.xml|\.ya?ml)?\Z")
_LOADED = r"ya?ml|xml|launch|py"
# Files of which each has facts of its own for remaps and namespaces.
_ROS_1 = ".launch"
_READ_ALONE = (_ROS_1, ".launch.py")
_PACKAGE = re.compile(r"""\b(?:pkg|package)["']?\s*[=:]\s*([^\s,)>]+)""")
_MORE = re.compile(r"include|ExecuteProcess|ExecuteLocal|<executable|executable:", re.I)
# Programs that publish under no name that they are given: they record, show, or tell of frames.
_QUIET = frozenset(
    {
        *("rosbag/record", "rosbag2_transport/recorder", "rviz/rviz", "rviz2/rviz2"),
        *("rqt_plot/rqt_plot", "rqt_graph/rqt_graph", "rqt_console/rqt_console"),
        *("rqt_bag/rqt_bag", "rqt_tf_tree/rqt_tf_tree", "rqt_image_view/rqt_image_view"),
        *("rqt_robot_monitor/rqt_robot_monitor", "image_view/image_view"),
        *("plotjuggler/plotjuggler", "diagnostic_aggregator/aggregator_node"),
        *("tf/static_transform_publisher", "tf2_ros/static_transform_publisher"),
        *("robot_state_publisher/robot_state_publisher", "gazebo_ros/spawn_model"),
        *("gazebo_ros/spawn_entity.py", "ros_gz_sim/create"),
    }
)
# Commands of the same kind.
_LOOKING = re.compile(
    r"(?:\S*/)?(?:(?:ros2 bag|rosbag) record|(?:ros2 topic|rostopic) (?:echo|hz|bw|list|info)"
    r"|rviz2?|rqt_\w+|plotjuggler|xacro)\b"
)
# Parameters by whose names it is known that they hold no topic, but a description, or a frame.
_NO_TOPIC = re.compile(r"(?:.*/)?(?:robot_description|use_sim_time|tf_prefix|\w*frame(?:_\w+)?)")


def facts_of_others(sources: Iterable[Source], load: Load, package: str) -> Iterator[Fact]:
    """What launch files hand to others than nodes of `package`.

    Files that others of them include are read as these do, with the arguments they are given.
    """
    read = {
        source.path: _read(source, load, package)
        for source in sources
        if source.path.endswith(_ROS_1) or _may_start_others(source.text, package)
    }
    included = {each.path for launch in read.values() for each in launch.sources[1:]}
    for path, launch in read.items():
        if path not in included:
            yield from _facts(launch, package)
            yield from _unknown(launch, package)


def is_launch(path: str) -> bool:
    """Whether a file is a launch file, in whatever language."""
    return _LAUNCH.search(path) is not None


def is_quiet(node: LaunchedNode) -> bool:
    """Whether a node publishes under no name that it is given."""
    return f"{node.package}/{node.type}" in _QUIET


def handed(launch: Launch, own: Collection[LaunchedNode]) -> Iterator[Fact]:
    """What a launch file hands to nodes that are not among some, and to commands."""
    for node in (n for n in launch.nodes if n not in own and not is_quiet(n)):
        yield from _of_node(node)
        if node.source.path.endswith(_READ_ALONE):
            yield from _of_remaps(node)
    yield from _of_commands(launch)


def _read(source: Source, load: Load, package: str) -> Launch:
    if speaks_ros_2(source):
        return read_ros2_launch(source, load, package, load, any_way=True)
    own = Surroundings(load, lambda name: "" if name == package else None, any_way=True)
    return read_launch(source, own)


def _may_start_others(text: str, package: str) -> bool:
    named = {found.strip("\"'") for found in _PACKAGE.findall(text)}
    return not named <= {package} or _MORE.search(text) is not None


def _facts(launch: Launch, package: str) -> Iterator[Fact]:
    others = [n for n in launch.nodes if n.package != package and not is_quiet(n)]
    for node in others:
        yield from _of_node(node)
    yield from _of_commands(launch)
    for given in launch.parameters if others else ():
        if not is_of_runtime(given.name.strip("/").partition("/")[0]):
            yield from _parameter("", given.name, given.value, given.source, given.span)


def _of_commands(launch: Launch) -> Iterator[Fact]:
    for command in launch.commands:
        told = _text(command.arguments)
        if not _LOOKING.match(told):
            yield Fact(HANDED, "", "command", told, command.source, command.span)


def _unknown(launch: Launch, package: str) -> Iterator[Fact]:
    """What roslaunch refuses, or nobody knows, but for what nodes of other packages are handed.

    Of ROS 2, files of the package that are included or loaded, and are not there: nothing is
    started.
    """
    own = re.compile(rf"`(?:share:/{re.escape(package)}/|(?!share:))[^`]*\.(?:{_LOADED})`")
    is_ros_1 = launch.sources[0].path.endswith(_ROS_1)
    others = [(node.source, node.span) for node in launch.nodes if node.package != package]
    for unknown in launch.unknowns:
        told, at = f"{unknown.what} {unknown.why}", unknown.span.start
        is_missing = own.search(told) is not None and told.endswith("not at hand")
        is_own = is_ros_1 and not unknown.source.path.endswith(PARAMETERS)
        is_handed = any(unknown.source is s and span.start <= at < span.end for s, span in others)
        if is_missing or (is_own and not is_handed):
            yield Fact(UNKNOWN, "", unknown.what, unknown.why, unknown.source, unknown.span)


def _of_node(node: LaunchedNode) -> Iterator[Fact]:
    name = str(node.name)
    for given in node.parameters:
        yield from _parameter(name, given.name, given.value, given.source, given.span)
    for texts in (node.arguments, node.texts):
        if texts:
            yield Fact(HANDED, name, "command line", _text(texts), node.source, node.span)
    if not node.source.path.endswith(_READ_ALONE):
        space = _text(node.namespace)
        yield Fact(HANDED, name, "namespace", space, node.source, node.span)
        yield from _of_remaps(node)


def _of_remaps(node: LaunchedNode) -> Iterator[Fact]:
    for remap in node.remaps:
        told, name = _text(remap.target), str(node.name)
        yield Fact(HANDED, name, f"remap of {remap.private}", told, remap.source, remap.span)


def _parameter(
    node: str, name: str, value: ParameterValue | Open, source: Source, span: Span
) -> Iterator[Fact]:
    """A parameter that may have a text, under a name that a node may put others together from."""
    if not _NO_TOPIC.fullmatch(name):
        values = value if isinstance(value, tuple) else (value,)
        texts = [_text(each) for each in values if isinstance(each, str | Open)]
        yield Fact(HANDED, node, f"parameter {name}", " ".join(texts), source, span)


def _text(told: Text | tuple[str, ...]) -> str:
    """A text, or texts one behind the other; for one that the files do not tell, a word for it."""
    match told:
        case str():
            return told
        case Open():
            return OPEN
        case _:
            return " ".join(told)
