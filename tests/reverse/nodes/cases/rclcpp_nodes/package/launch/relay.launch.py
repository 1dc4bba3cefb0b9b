from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            Node(
                package="relay", executable="counter", parameters=[{"step": 3, "limits.most": 20}]
            ),
            Node(
                package="relay", executable="relay_gate", name="gate", remappings=[("in", "count")]
            ),
            Node(package="relay", executable="watch", name="watch"),
        ]
    )
