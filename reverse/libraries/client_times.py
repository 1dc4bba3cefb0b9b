"""Classes of times of the client libraries in C++: what of them throws beyond its range.

Each by its documentation. Times of clocks, and stamps of messages, are trusted to be between 0 and
2^31 s, and what is computed of such times without a factor to be within all ranges.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from rebsync.records import dataclass
from rebsync.reverse.libraries.outcome_rules import OutcomeRule, Raises


class TimeUse(Enum):
    """What a class of times stands for."""

    POINT = "a moment"
    SPAN = "the time between two moments"


@dataclass(frozen=True, slots=True)
class TimeClass:
    """A class of a library; its moments know their clock, or none of them is before a start."""

    use: TimeUse
    knows_clocks: bool = False


_POINTS = ("ros::Time", "ros::WallTime", "ros::SteadyTime")
TIME_CLASSES: Mapping[str, TimeClass] = {
    **dict.fromkeys(_POINTS, TimeClass(TimeUse.POINT)),
    **dict.fromkeys(("ros::Duration", "ros::WallDuration"), TimeClass(TimeUse.SPAN)),
    "rclcpp::Time": TimeClass(TimeUse.POINT, knows_clocks=True),
    "rclcpp::Duration": TimeClass(TimeUse.SPAN, knows_clocks=True),
}
CLOCK_CLASS = "rclcpp::Clock"
OWN_CLOCK = "RCL_ROS_TIME"  # of nodes, and of stamps
DEFAULT_CLOCK = "RCL_SYSTEM_TIME"
CLOCKS = frozenset({OWN_CLOCK, DEFAULT_CLOCK, "RCL_STEADY_TIME"})
NOW_OF_NODE = frozenset({"now", "rclcpp::Node::now", "rclcpp_lifecycle::LifecycleNode::now"})
STAMPS = frozenset({"stamp", "stamp_"})  # what fields that are times are called
STAMP_CLASSES = ("ros::Time", "rclcpp::Time")
ASKING_CLOCK = "get_clock_type"
# What makes a span of a number, besides constructors, and what stands for one.
_SECONDS = ("rclcpp::Duration::from_seconds", "rclcpp::Duration::from_nanoseconds")
MAKING: Mapping[str, str] = dict.fromkeys(_SECONDS, "rclcpp::Duration")
OF_THE_LANGUAGE = ("std::chrono::", "std::literals::")
LANGUAGE_SPAN = "rclcpp::Duration"
RATES = frozenset({"ros::Rate", "ros::WallRate", "rclcpp::Rate", "rclcpp::WallRate"})
THROWN = "std::runtime_error"
RULES = (
    OutcomeRule(
        "ros::Time ros::WallTime ros::SteadyTime ros::Time.fromSec ros::WallTime.fromSec",
        raises=THROWN,
        when=Raises.BEFORE_START,
    ),
    OutcomeRule(
        "ros::Duration ros::WallDuration ros::Duration.fromSec ros::WallDuration.fromSec",
        raises=THROWN,
        when=Raises.BEYOND_SPAN,
    ),
    OutcomeRule("rclcpp::Time", raises=THROWN, when=Raises.NEGATIVE_PAIR),
    OutcomeRule("ros::Rate ros::WallRate", raises=THROWN, when=Raises.NO_RATE),
    OutcomeRule(
        "rclcpp::Rate rclcpp::WallRate", raises="std::invalid_argument", when=Raises.NO_RATE
    ),
)


def is_of_times(name: str) -> bool:
    """Whether a function makes a time, or is a method of one."""
    name = name.removeprefix("::").removeprefix("new ")
    classes = {*TIME_CLASSES, CLOCK_CLASS, *RATES}
    return name in classes or name.rpartition("::")[0] in classes
