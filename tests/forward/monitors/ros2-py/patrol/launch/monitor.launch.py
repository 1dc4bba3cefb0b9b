"""Starts what compares a run of patrol with patrol.rebeca; start it before the system."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe the monitor."""
    params = PathJoinSubstitution([FindPackageShare("patrol"), "config", "params.yaml"])
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "namespace",
                default_value="",
                description="the namespace of the nodes of the system",
            ),
            DeclareLaunchArgument(
                "use_sim_time",
                default_value="false",
                description="whether the nodes follow the clock of a simulation",
            ),
            DeclareLaunchArgument(
                "params_file",
                default_value=params,
                description="parameters that replace those of config/params.yaml, one by one",
            ),
            Node(
                package="patrol",
                executable="monitor_node",
                name="monitor",
                namespace=LaunchConfiguration("namespace"),
                output="screen",
                parameters=[
                    params,
                    LaunchConfiguration("params_file"),
                    {"use_sim_time": LaunchConfiguration("use_sim_time")},
                ],
            ),
        ]
    )
