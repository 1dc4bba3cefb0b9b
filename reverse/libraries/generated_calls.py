"""How our own generated Python calls the client libraries, letter by letter.

Readers of generated code compare with these; what the calls are for is in the tables.
"""

from __future__ import annotations

from fractions import Fraction

# What makes a publisher: of ROS 1, then of ROS 2 in a node and beside one.
PUBLISHER_OF_ROS_1 = "rospy.Publisher"
PUBLISHER_OF_NODE = "self.create_publisher"
PUBLISHERS = frozenset({PUBLISHER_OF_ROS_1, PUBLISHER_OF_NODE, "node.create_publisher"})
PUBLISHER_METHOD = PUBLISHER_OF_NODE.rpartition(".")[2]
# What makes a timer.
TIMER_OF_ROS_1 = "rospy.Timer"
TIMER_OF_NODE = "self.create_timer"
# What has a function called when the node ends.
SHUTDOWN_HOOKS = frozenset({"rospy.on_shutdown", "self.context.on_shutdown"})
# What offers a service.
SERVICE_OF_ROS_1 = "rospy.Service"
SERVICE_OF_NODE = "self.create_service"
# How people subscribe by hand, as a regular expression.
SUBSCRIBES = r"\brospy\.Subscriber\(|\bcreate_subscription\("
DURATIONS = frozenset({"rospy.Duration", "rospy.Duration.from_sec"})
PARAMETER_OF_ROS_1 = "rospy.get_param"
LOGGER = "rclpy.logging.get_logger"


def is_period(seconds: Fraction | float) -> bool:
    """Whether a timer of this period leaves time for others, and ticks at all."""
    return 0.001 <= seconds <= 1e6
