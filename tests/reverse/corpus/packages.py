"""The public packages of which there are facts."""

from __future__ import annotations

import json
from pathlib import Path

from tests.reverse.corpus.values import Json

FACTS = Path(__file__).parent

# The packages that the facts cover, as README.md lists them.
PACKAGES = {
    "ros_tutorials": ("turtlesim", "roscpp_tutorials"),
    "teleop_twist_joy": (".",),
    "f1tenth_simulator": (".",),
    "costmap_converter": (".",),
    "yujin_ocs": (
        *("yocs_cmd_vel_mux", "yocs_velocity_smoother", "yocs_joyop", "yocs_navigator"),
        *("yocs_ar_marker_tracking", "yocs_ar_pair_tracking", "yocs_diff_drive_pose_controller"),
        *("yocs_virtual_sensor", "yocs_waypoint_provider"),
    ),
    "slam_gmapping": ("gmapping",),
    "joystick_drivers": ("joy", "spacenav_node", "wiimote"),
    "pointcloud_to_laserscan": (".",),
    "urg_node": (".",),
    "usb_cam": (".",),
    "autorally": ("autorally_core", "autorally_control"),
    "turtlebot3-ros1": ("turtlebot3_bringup", "turtlebot3_slam"),
    "turtlebot3_simulations-ros1": ("turtlebot3_fake", "turtlebot3_gazebo"),
    "twist_mux-ros1": (".",),
    "depthimage_to_laserscan-ros1": (".",),
    "robot_localization-ros1": (".",),
}

# Those for ROS 2 whose nodes in C++ the facts cover: the folder of the checkout, and the packages
# in it.
ROS2 = {
    "examples-cpp": ("examples", ("rclcpp",)),
    "demos-cpp": (
        "demos",
        (
            *("composition", "demo_nodes_cpp", "demo_nodes_cpp_native", "dummy_robot"),
            *("intra_process_demo", "lifecycle", "logging_demo"),
        ),
    ),
    "ros_tutorials-ros2": ("ros_tutorials-ros2", ("turtlesim",)),
    "twist_mux-ros2": ("twist_mux-ros2", (".",)),
    "pointcloud_to_laserscan-ros2": ("pointcloud_to_laserscan-ros2", (".",)),
    "teleop_twist_joy-ros2": ("teleop_twist_joy-ros2", (".",)),
    "urg_node2": ("urg_node2", (".",)),
    "usb_cam-ros2": ("usb_cam-ros2", (".",)),
    "turtlebot3-cpp": ("turtlebot3", ("turtlebot3_node",)),
    "turtlebot3_simulations-ros2": (
        "turtlebot3_simulations-ros2",
        ("turtlebot3_fake_node", "turtlebot3_gazebo"),
    ),
    "cmd_vel_mux": ("cmd_vel_mux", (".",)),
    "depthimage_to_laserscan-ros2": ("depthimage_to_laserscan-ros2", (".",)),
    "robot_localization-ros2": ("robot_localization-ros2", (".",)),
}

_TELEOP_TOOLS = ("joy_teleop", "key_teleop", "mouse_teleop")

# Those whose nodes in Python the facts cover: the folder of the checkout, and the packages in it.
PYTHON = {
    "autorally-python": ("autorally", ("autorally_core", "autorally_control", "autorally_gazebo")),
    "ros_tutorials-python": ("ros_tutorials", ("rospy_tutorials",)),
    "teleop_twist_keyboard-python": ("teleop_twist_keyboard", (".",)),
    "turtlebot3-python": ("turtlebot3", ("turtlebot3_teleop", "turtlebot3_example")),
    "examples-python": ("examples", ("rclpy",)),
    "demos-python": (
        "demos",
        (
            *("demo_nodes_py", "lifecycle_py", "quality_of_service_demo/rclpy", "topic_monitor"),
            "action_tutorials/action_tutorials_py",
        ),
    ),
    "turtlebot3-ros1-python": ("turtlebot3-ros1", ("turtlebot3_teleop", "turtlebot3_example")),
    "twist_mux-ros1-python": ("twist_mux-ros1", (".",)),
    "twist_mux-ros2-python": ("twist_mux-ros2", (".",)),
    "cmd_vel_mux-python": ("cmd_vel_mux", (".",)),
    "teleop_twist_keyboard-ros2-python": ("teleop_twist_keyboard-ros2", (".",)),
    "usb_cam-ros2-python": ("usb_cam-ros2", (".",)),
    "teleop_twist_joy-ros2-python": ("teleop_twist_joy-ros2", (".",)),
    "teleop_tools-ros1-python": ("teleop_tools-ros1", _TELEOP_TOOLS),
    "teleop_tools-ros2-python": ("teleop_tools-ros2", _TELEOP_TOOLS),
}


def facts_of(name: str) -> list[Json]:
    """The facts of a repository."""
    facts: list[Json] = json.loads((FACTS / f"{name}.json").read_text(encoding="utf-8"))
    return facts
