from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("limit", default_value="7"),
            Node(
                package="py_robot",
                executable="robot",
                name="robot",
                parameters=[{"limit": LaunchConfiguration("limit")}],
                remappings=[("alarm", "siren")],
            ),
        ]
    )
