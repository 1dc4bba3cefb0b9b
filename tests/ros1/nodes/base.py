"""A robot's base: drives as it is told, but only so much of the way, and tells its odometry."""

import json
import math
import sys
import threading

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from std_msgs.msg import Float64

PERIOD = 0.02  # s


class Base:
    """Begins away from the origin and turned, as odometry does."""

    def __init__(self, name: str, grip: float, fastest: float, told: float) -> None:
        self.x, self.y, self.heading = 3.0, -2.0, 0.7
        self.grip, self.fastest = grip, fastest
        self.twist = Twist()
        self.velocities: list = []
        self.differences: list = []
        self.begun = self.x, self.y, self.heading
        self.odometry = rospy.Publisher(f"/{name}/odom", Odometry, queue_size=10)
        rospy.Subscriber(f"/{name}/cmd_vel", Twist, self.hear)
        rospy.Subscriber(f"/{name}/drive/difference", Float64, self.note)
        self.told = told  # metres, behind which odometry is lost

    def hear(self, twist: Twist) -> None:
        self.twist = twist
        self.velocities.append(twist.linear.x)

    def note(self, difference: Float64) -> None:
        self.differences.append(difference.data)

    def step(self, elapsed: float) -> None:
        """Drives on for some seconds."""
        way = self.grip * elapsed
        forward = max(-self.fastest, min(self.fastest, self.twist.linear.x)) * way
        left = max(-self.fastest, min(self.fastest, self.twist.linear.y)) * way
        self.x += forward * math.cos(self.heading) - left * math.sin(self.heading)
        self.y += forward * math.sin(self.heading) + left * math.cos(self.heading)
        self.heading += self.twist.angular.z * elapsed
        if math.hypot(*self.driven()) >= self.told:
            return
        msg = Odometry()
        msg.header.stamp = rospy.Time.now()
        msg.pose.pose.position.x, msg.pose.pose.position.y = self.x, self.y
        msg.pose.pose.orientation.z = math.sin(self.heading / 2)
        msg.pose.pose.orientation.w = math.cos(self.heading / 2)
        self.odometry.publish(msg)

    def driven(self) -> tuple:
        """How far it is from where it began, in the directions that it had then."""
        east, north, turn = self.x - self.begun[0], self.y - self.begun[1], -self.begun[2]
        return (
            east * math.cos(turn) - north * math.sin(turn),
            east * math.sin(turn) + north * math.cos(turn),
        )


rospy.init_node("base")
name, grip, fastest, told, seconds = sys.argv[1], *map(float, sys.argv[2:6])
base = Base(name, grip, fastest, told)
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
            "driven": base.driven(),
            "differences": base.differences,
            "last": base.velocities[-1] if base.velocities else None,
        }
    )
)
