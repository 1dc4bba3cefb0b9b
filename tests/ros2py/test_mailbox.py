"""The mailbox of rclpy packages, in one process."""

from __future__ import annotations

from tests.ros1.test_mailbox import (
    test_a_constructor_sends_to_itself_and_moves_on_in_time,
    test_a_delay_keeps_the_rebec_busy,
    test_a_message_after_its_deadline_is_dropped_and_reported,
    test_a_rebec_that_sends_to_itself_still_holds_its_place,
    test_a_robot_stands_that_no_longer_sends_to_itself,
    test_a_sensor_keeps_the_latest_message,
    test_a_sensor_that_hears_nothing_is_reported_once,
    test_a_time_unit_stretches_the_model,
    test_a_violation_is_reported_and_serving_goes_on,
    test_choices_come_from_the_seed_and_the_name,
    test_lateness_beyond_the_slack_is_reported,
    test_no_state_is_published_where_nobody_wants_it,
    test_order_is_arrival_then_priority_then_receipt,
    test_the_newest_beyond_the_capacity_is_dropped_and_reported,
    test_the_next_message_is_chosen_when_the_rebec_is_free,
    test_the_sender_is_known_and_answered,
    test_what_comes_from_outside_is_not_late_between_two_times,
    test_what_is_sent_at_once_is_ordered_as_if_it_came_at_once,
)

__all__ = [
    "test_a_constructor_sends_to_itself_and_moves_on_in_time",
    "test_a_delay_keeps_the_rebec_busy",
    "test_a_message_after_its_deadline_is_dropped_and_reported",
    "test_a_rebec_that_sends_to_itself_still_holds_its_place",
    "test_a_robot_stands_that_no_longer_sends_to_itself",
    "test_a_sensor_keeps_the_latest_message",
    "test_a_sensor_that_hears_nothing_is_reported_once",
    "test_a_time_unit_stretches_the_model",
    "test_a_violation_is_reported_and_serving_goes_on",
    "test_choices_come_from_the_seed_and_the_name",
    "test_lateness_beyond_the_slack_is_reported",
    "test_no_state_is_published_where_nobody_wants_it",
    "test_order_is_arrival_then_priority_then_receipt",
    "test_the_newest_beyond_the_capacity_is_dropped_and_reported",
    "test_the_next_message_is_chosen_when_the_rebec_is_free",
    "test_the_sender_is_known_and_answered",
    "test_what_comes_from_outside_is_not_late_between_two_times",
    "test_what_is_sent_at_once_is_ordered_as_if_it_came_at_once",
]
