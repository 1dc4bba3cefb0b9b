from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(package="doors", executable="door", name="door"),
            Node(package="doors", executable="guard", name="guard"),
        ]
    )
