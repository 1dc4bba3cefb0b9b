from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package="counter", executable="counter", name="counter"),
            Node(package="counter", executable="alarm", name="alarm"),
        ]
    )
