"""The mailbox of both dialects on a real ROS 2: order, times, and what is reported."""

from __future__ import annotations

import pytest

from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros2.test_mailbox import (
    test_parameters_reach_the_constructor,
    test_the_more_urgent_message_goes_first_and_is_answered,
    test_the_newest_message_beyond_the_capacity_is_dropped,
    test_violations_are_reported_and_serving_goes_on,
    test_what_is_not_taken_in_time_is_dropped,
)
from tests.ros2real.conftest import DIALECTS, Play, office

__all__ = [
    "test_parameters_reach_the_constructor",
    "test_the_more_urgent_message_goes_first_and_is_answered",
    "test_the_newest_message_beyond_the_capacity_is_dropped",
    "test_violations_are_reported_and_serving_goes_on",
    "test_what_is_not_taken_in_time_is_dropped",
]


@pytest.fixture(scope="module", params=DIALECTS)
def recording(
    request: pytest.FixtureRequest, play_real: Play, tmp_path_factory: pytest.TempPathFactory
) -> Recording:
    dialect = str(request.param)
    package = office(tmp_path_factory.mktemp("mailbox"), dialect)
    return play_real(package, dialect, Clock(until=70, quiet=30))
