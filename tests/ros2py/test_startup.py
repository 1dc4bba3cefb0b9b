"""Start and end of systems of rclpy nodes, in one process."""

from __future__ import annotations

from tests.ros1.test_startup import (
    test_a_rebec_without_a_list_runs_alone,
    test_nothing_is_lost_however_late_nodes_start,
    test_stopping_in_a_long_delay_is_quick_and_sends_nothing,
    test_time_0_is_when_the_last_is_ready,
)

# What is waited for in real time, restarts and namespaces need a real ROS.
__all__ = [
    "test_a_rebec_without_a_list_runs_alone",
    "test_nothing_is_lost_however_late_nodes_start",
    "test_stopping_in_a_long_delay_is_quick_and_sends_nothing",
    "test_time_0_is_when_the_last_is_ready",
]
