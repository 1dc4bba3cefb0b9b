"""Launch files of ROS 2, however they are written: Python, XML, or YAML."""

from __future__ import annotations

from rebsync.reverse.launch import launch_python
from rebsync.reverse.launch.launch_tags import actions_of_xml, actions_of_yaml, has_words_of_ros_2
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.launch.ros2_actions import Action
from rebsync.reverse.launch.ros2_reading import Load, Reader, nothing
from rebsync.reverse.unknowns import Unknown
from rebsync.source import Source

_YAML = (".yaml", ".yml")


def speaks_ros_2(source: Source) -> bool:
    """Whether a launch file is for ROS 2: one in XML is where it has its words."""
    return source.path.endswith((".py", *_YAML)) or has_words_of_ros_2(source.text)


def actions_of(source: Source) -> tuple[Action, ...] | Unknown:
    """The actions of a launch file, or why there are none."""
    if source.path.endswith(".py"):
        return launch_python.actions_of(source)
    return actions_of_yaml(source) if source.path.endswith(_YAML) else actions_of_xml(source)


def read_ros2_launch(
    source: Source,
    load: Load,
    package: str = "",
    elsewhere: Load = nothing,
    any_way: bool = False,
) -> Launch:
    """What a launch file of ROS 2 and those that it includes start and set.

    `load` gives the text of a path below the folder of the package `package`, `elsewhere` that of
    a path as the file writes it: `share:/` and the package in front, or on the disk. With
    `any_way`, nodes count that the defaults of arguments leave out.
    """
    return Reader(load, actions_of, package, elsewhere, any_way).result(source)
