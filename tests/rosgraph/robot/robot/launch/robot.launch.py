from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(
                package="robot",
                executable="driver",
                namespace="base",
                parameters=[{"topic": "/laser"}],
                remappings=[("cmd_vel", "/cmd_vel")],
            ),
            Node(package="robot", executable="planner", remappings=[("scan", "/laser")]),
            Node(package="tools", executable="console", name="panel"),
            Node(package="rviz2", executable="rviz2", name="rviz"),
        ]
    )
