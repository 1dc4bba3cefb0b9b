"""What calls do, as analyses ask for it: the same of one rule in both languages."""

from __future__ import annotations

import pytest

from rebsync.reverse.libraries.effects import UNKNOWN, of_function
from rebsync.reverse.libraries.routines import Effect, Language

CPP, PYTHON = Language.CPP, Language.PYTHON


@pytest.mark.parametrize(
    ("language", "name"),
    [
        *((CPP, name) for name in ("std::abs", "abs", "::fabs", "std::max", "boost::round")),
        *((PYTHON, name) for name in ("builtins.abs", "math.fabs", "builtins.len")),
        *((CPP, name) for name in ("ros::Time::now", "rand", "ros::param::has")),
        *((PYTHON, name) for name in ("rospy.get_time", "time.time", "random.choice")),
        *((PYTHON, name) for name in ("rospy.get_param", "rclpy.duration.Duration")),
    ],
)
def test_what_only_gives_its_result_is_pure(language: Language, name: str) -> None:
    found = of_function(language, name)
    assert found.is_pure
    assert found.writes == frozenset()


@pytest.mark.parametrize(
    ("language", "name", "effect"),
    [
        (CPP, "std::this_thread::sleep_for", Effect.TIME),
        (CPP, "usleep", Effect.TIME),
        (PYTHON, "time.sleep", Effect.TIME),
        (PYTHON, "rospy.sleep", Effect.TIME),
        (CPP, "ros::spinOnce", Effect.RUNS),
        (CPP, "rclcpp::spin_until_future_complete", Effect.RUNS),
        (PYTHON, "rclpy.spin_once", Effect.RUNS),
        (CPP, "ros::topic::waitForMessage", Effect.WAITS),
        (PYTHON, "rospy.wait_for_message", Effect.WAITS),
        (CPP, "poll", Effect.WAITS),
        (CPP, "somebody::does", Effect.UNKNOWN),
        (PYTHON, "somebody.does", Effect.UNKNOWN),
    ],
)
def test_what_takes_time_or_is_not_known_is_not_pure(
    language: Language, name: str, effect: Effect
) -> None:
    found = of_function(language, name)
    assert found.effect is effect
    assert not found.is_pure


def test_it_is_known_what_is_written() -> None:
    assert of_function(CPP, "close").writes is None
    assert UNKNOWN.writes is None


def test_what_calls_its_arguments_is_not_pure() -> None:
    assert not of_function(PYTHON, "builtins.map").is_pure
    assert not of_function(PYTHON, "builtins.max").is_pure
