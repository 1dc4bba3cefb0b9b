"""A robot's base: drives as it is told, but only so much of the way, and tells its odometry."""

import json
import math
import sys
import threading

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from std_msgs.msg import Float64
from wheels import Wheels

PERIOD = 0.02  # s


class Base:
    """Tells odometry until it has driven some metres."""

    def __init__(self, name: str, wheels: Wheels, told: float) -> None:
        self.wheels, self.told = wheels, told
        self.twist = Twist()
        self.velocities: list = []
        self.differences: list = []
        self.odometry = rospy.Publisher(f"/{name}/odom", Odometry, queue_size=10)
        rospy.Subscriber(f"/{name}/cmd_vel", Twist, self.hear)
        rospy.Subscriber(f"/{name}/drive/difference", Float64, self.note)

    def hear(self, twist: Twist) -> None:
        self.twist = twist
        self.velocities.append(twist.linear.x)

    def note(self, difference: Float64) -> None:
        self.differences.append(difference.data)

    def step(self, elapsed: float) -> None:
        """Drives on for some seconds."""
        told = self.twist
        self.wheels.step(told.linear.x, told.linear.y, told.angular.z, elapsed)
        if math.hypot(*self.wheels.driven()) >= self.told:
            return
        msg = Odometry()
        msg.header.stamp = rospy.Time.now()
        msg.pose.pose.position.x, msg.pose.pose.position.y = self.wheels.x, self.wheels.y
        msg.pose.pose.orientation.z = math.sin(self.wheels.heading / 2)
        msg.pose.pose.orientation.w = math.cos(self.wheels.heading / 2)
        self.odometry.publish(msg)


rospy.init_node("base")
name, grip, fastest, told, seconds = sys.argv[1], *map(float, sys.argv[2:6])
base = Base(name, Wheels(grip, fastest), told)
end = rospy.Time.now() + rospy.Duration(seconds)
stop = threading.Event()
last = rospy.Time.now()
while last < end:
    now = rospy.Time.now()
    base.step((now - last).to_sec())
    last = now
    stop.wait(PERIOD)
print(
    json.dumps(
        {
            "driven": base.wheels.driven(),
            "differences": base.differences,
            "last": base.velocities[-1] if base.velocities else None,
        }
    )
)
