"""The names of the client libraries occur in `reverse/libraries`, and in launch files."""

from __future__ import annotations

from tests.reverse.libraries.naming import naming, words_in


def test_no_other_module_names_a_client_library() -> None:
    assert naming() == {}


def test_comments_and_docstrings_name_what_they_like() -> None:
    assert not list(words_in('"""Of rospy."""\nx = 1  # rclpy\n'))
    assert list(words_in('x = "rospy.spin"\n')) == ["rospy.spin"]
    assert list(words_in("def f(is_rclpy): ...\n")) == ["is_rclpy"]
    assert list(words_in('x = b"ros::init"\n')) == ["ros::init"]
