"""All kinds of changes, by dialect: those that change what a system does, and those that do not."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from tests.roundtrip.mutations import (
    bodies,
    building,
    built,
    interplay,
    interplay_launch,
    joints,
    launch_py,
    launch_xml,
    layout,
    neutral,
    py_bodies,
    py_joints,
    py_neutral,
    py_sending,
    py_surroundings,
    rclcpp,
    roscpp,
    sending,
    set_up,
    slips,
    spelling,
    surroundings,
)
from tests.roundtrip.mutations.package import Kind

_CPP = (*bodies.KINDS, *sending.KINDS, *joints.KINDS, *building.KINDS, *interplay.CPP, *built.CPP)
_CPP_NEUTRAL = (
    *neutral.KINDS,
    *spelling.KINDS,
    *surroundings.NEUTRAL,
    *built.NEUTRAL,
    *building.NEUTRAL,
    *interplay.CPP_NEUTRAL,
    *interplay.ALL_NEUTRAL,
    *layout.KINDS,
)

_PY = (
    *py_bodies.KINDS,
    *py_sending.KINDS,
    *py_joints.KINDS,
    *py_surroundings.KINDS,
    *slips.PYTHON,
    *interplay.PYTHON,
)
_PY_NEUTRAL = (
    *py_neutral.KINDS,
    *slips.PYTHON_NEUTRAL,
    *interplay.PYTHON_NEUTRAL,
    *interplay.ALL_NEUTRAL,
    *surroundings.NEUTRAL,
    *built.NEUTRAL,
    *layout.KINDS,
)
_ALL = (*surroundings.KINDS, *slips.ANY, *interplay.ALL, *built.ALL)
_XML = (*launch_xml.KINDS, *slips.LAUNCH_XML, *interplay_launch.XML, *interplay.ROS1)
_LAUNCH_PY = (*launch_py.KINDS, *slips.LAUNCH_PY, *interplay_launch.PY, *interplay.ROS2)
_XML_NEUTRAL = (*launch_xml.NEUTRAL, *interplay_launch.XML_NEUTRAL)
_LAUNCH_PY_NEUTRAL = (
    *launch_py.NEUTRAL,
    *slips.LAUNCH_PY_NEUTRAL,
    *interplay_launch.PY_NEUTRAL,
    *interplay.ROS2_NEUTRAL,
)

BEHAVIOUR: Mapping[str, tuple[Kind, ...]] = {
    "ros1-cpp": (*_CPP, *_ALL, *roscpp.KINDS, *_XML, *set_up.KINDS["ros1-cpp"]),
    "ros2-cpp": (
        *_CPP,
        *_ALL,
        *rclcpp.KINDS,
        *slips.RCLCPP,
        *_LAUNCH_PY,
        *set_up.KINDS["ros2-cpp"],
    ),
    "ros1-py": (*_PY, *_ALL, *py_surroundings.ROSPY, *_XML, *set_up.KINDS["ros1-py"]),
    "ros2-py": (
        *_PY,
        *_ALL,
        *py_surroundings.RCLPY,
        *slips.RCLPY,
        *built.RCLPY,
        *_LAUNCH_PY,
        *set_up.KINDS["ros2-py"],
    ),
}
NEUTRAL: Mapping[str, tuple[Kind, ...]] = {
    "ros1-cpp": (*_CPP_NEUTRAL, *roscpp.NEUTRAL, *_XML_NEUTRAL),
    "ros2-cpp": (*_CPP_NEUTRAL, *rclcpp.NEUTRAL, *_LAUNCH_PY_NEUTRAL),
    "ros1-py": (*_PY_NEUTRAL, *py_neutral.ROSPY, *_XML_NEUTRAL),
    "ros2-py": (*_PY_NEUTRAL, *py_neutral.RCLPY, *_LAUNCH_PY_NEUTRAL),
}


def made_by(module: str) -> list[Kind]:
    """The kinds of all dialects that modules of changes have whose names begin so."""
    modules = (vars(m) for name, m in globals().items() if name.startswith(module))
    every = (value for m in modules for value in m.values() if isinstance(value, tuple))
    return [kind for value in every for kind in value if isinstance(kind, Kind)]


@cache
def named(dialect: str) -> Mapping[str, Kind]:
    """The kinds of a dialect by their names."""
    return {kind.name: kind for kind in (*BEHAVIOUR[dialect], *NEUTRAL[dialect])}
