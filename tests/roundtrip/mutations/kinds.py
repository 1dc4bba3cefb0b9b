"""All kinds of changes, by dialect: those that change what a system does, and those that do not."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from tests.roundtrip.mutations import (
    bodies,
    building,
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
    slips,
    spelling,
    surroundings,
)
from tests.roundtrip.mutations.package import Kind

_CPP = (*bodies.KINDS, *sending.KINDS, *joints.KINDS, *building.KINDS)
_CPP_NEUTRAL = (
    *neutral.KINDS,
    *spelling.KINDS,
    *surroundings.NEUTRAL,
    *building.NEUTRAL,
    *layout.KINDS,
)

_PY = (
    *py_bodies.KINDS,
    *py_sending.KINDS,
    *py_joints.KINDS,
    *py_surroundings.KINDS,
    *slips.PYTHON,
)
_PY_NEUTRAL = (
    *py_neutral.KINDS,
    *slips.PYTHON_NEUTRAL,
    *surroundings.NEUTRAL,
    *layout.KINDS,
)
_ALL = (*surroundings.KINDS, *slips.ANY)
_XML, _LAUNCH_PY = (*launch_xml.KINDS, *slips.LAUNCH_XML), (*launch_py.KINDS, *slips.LAUNCH_PY)
_LAUNCH_PY_NEUTRAL = (*launch_py.NEUTRAL, *slips.LAUNCH_PY_NEUTRAL)

BEHAVIOUR: Mapping[str, tuple[Kind, ...]] = {
    "ros1-cpp": (*_CPP, *_ALL, *roscpp.KINDS, *_XML),
    "ros2-cpp": (*_CPP, *_ALL, *rclcpp.KINDS, *slips.RCLCPP, *_LAUNCH_PY),
    "ros1-py": (*_PY, *_ALL, *py_surroundings.ROSPY, *_XML),
    "ros2-py": (*_PY, *_ALL, *py_surroundings.RCLPY, *slips.RCLPY, *_LAUNCH_PY),
}
NEUTRAL: Mapping[str, tuple[Kind, ...]] = {
    "ros1-cpp": (*_CPP_NEUTRAL, *roscpp.NEUTRAL, *launch_xml.NEUTRAL),
    "ros2-cpp": (*_CPP_NEUTRAL, *rclcpp.NEUTRAL, *_LAUNCH_PY_NEUTRAL),
    "ros1-py": (*_PY_NEUTRAL, *py_neutral.ROSPY, *launch_xml.NEUTRAL),
    "ros2-py": (*_PY_NEUTRAL, *py_neutral.RCLPY, *_LAUNCH_PY_NEUTRAL),
}


@cache
def named(dialect: str) -> Mapping[str, Kind]:
    """The kinds of a dialect by their names."""
    return {kind.name: kind for kind in (*BEHAVIOUR[dialect], *NEUTRAL[dialect])}
