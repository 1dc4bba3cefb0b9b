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
    rclcpp,
    roscpp,
    sending,
    spelling,
    surroundings,
)
from tests.roundtrip.mutations.package import Kind

_CPP = (*bodies.KINDS, *sending.KINDS, *joints.KINDS, *surroundings.KINDS, *building.KINDS)
_CPP_NEUTRAL = (
    *neutral.KINDS,
    *spelling.KINDS,
    *surroundings.NEUTRAL,
    *building.NEUTRAL,
    *layout.KINDS,
)

BEHAVIOUR: Mapping[str, tuple[Kind, ...]] = {
    "ros1-cpp": (*_CPP, *roscpp.KINDS, *launch_xml.KINDS),
    "ros2-cpp": (*_CPP, *rclcpp.KINDS, *launch_py.KINDS),
}
NEUTRAL: Mapping[str, tuple[Kind, ...]] = {
    "ros1-cpp": (*_CPP_NEUTRAL, *roscpp.NEUTRAL, *launch_xml.NEUTRAL),
    "ros2-cpp": (*_CPP_NEUTRAL, *rclcpp.NEUTRAL, *launch_py.NEUTRAL),
}


@cache
def named(dialect: str) -> Mapping[str, Kind]:
    """The kinds of a dialect by their names."""
    return {kind.name: kind for kind in (*BEHAVIOUR[dialect], *NEUTRAL[dialect])}
