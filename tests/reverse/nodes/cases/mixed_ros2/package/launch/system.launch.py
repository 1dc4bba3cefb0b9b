from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="mixed_ros2", executable="counter", name="counter"),
        Node(package="mixed_ros2", executable="player.py", name="first"),
        Node(package="mixed_ros2", executable="player.py", name="second",
             parameters=[{"step": 3}]),
        Node(package="mixed_ros2", executable="player.py", name="deaf",
             remappings=[("turn", "elsewhere")]),
    ])
