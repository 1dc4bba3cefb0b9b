"""The drive of rclpy packages, in one process."""

from __future__ import annotations

from tests.ros1.test_drive import (
    test_a_differential_robot_never_slides,
    test_a_differential_robot_turns_first_and_the_short_way,
    test_a_holonomic_robot_moves_straight_and_evenly,
    test_a_move_takes_the_time_of_the_next_delay_or_the_last_or_a_parameter,
    test_a_robot_stops_when_a_body_fails,
    test_every_move_ends_in_its_cell,
    test_moves_queue_up_when_the_model_is_faster,
    test_the_last_velocity_is_zero_when_a_node_is_told_to_end_in_mid_move,
    test_velocities_come_at_ten_hertz_and_end_with_a_stop,
    tour,
)

__all__ = [
    "test_a_differential_robot_never_slides",
    "test_a_differential_robot_turns_first_and_the_short_way",
    "test_a_holonomic_robot_moves_straight_and_evenly",
    "test_a_move_takes_the_time_of_the_next_delay_or_the_last_or_a_parameter",
    "test_a_robot_stops_when_a_body_fails",
    "test_every_move_ends_in_its_cell",
    "test_moves_queue_up_when_the_model_is_faster",
    "test_the_last_velocity_is_zero_when_a_node_is_told_to_end_in_mid_move",
    "test_velocities_come_at_ten_hertz_and_end_with_a_stop",
    "tour",
]
