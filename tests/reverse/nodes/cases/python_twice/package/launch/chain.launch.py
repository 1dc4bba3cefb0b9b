from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="python_twice", executable="source"),
        Node(package="python_twice", executable="relay", name="one",
             remappings=[("in", "numbers"), ("out", "between")]),
        Node(package="python_twice", executable="relay", name="two",
             remappings=[("in", "between"), ("out", "done")]),
        Node(package="python_twice", executable="relay", namespace="left", name="one",
             remappings=[("in", "/numbers"), ("out", "/done")],
             parameters=[{"most": 2}]),
        Node(package="elsewhere", executable="relay", name="three",
             remappings=[("in", "numbers")]),
    ])
