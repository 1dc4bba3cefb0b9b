from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package="lamp", executable="lamp", name="lamp"),
            Node(package="lamp", executable="switch", name="switch"),
        ]
    )
