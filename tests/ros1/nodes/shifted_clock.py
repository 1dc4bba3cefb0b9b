"""A clock that is off: `shifted_clock.py TOPIC SECONDS` publishes what /clock shows, shifted."""

from __future__ import annotations

import sys

import rospy
from rosgraph_msgs.msg import Clock


def main(topic: str, seconds: float) -> None:
    rospy.init_node("shifted_clock")
    offset = rospy.Duration.from_sec(seconds)
    shifted = rospy.Publisher(topic, Clock, queue_size=1000, tcp_nodelay=True)
    rospy.Subscriber(
        "/clock", Clock, lambda tick: shifted.publish(Clock(tick.clock + offset)), tcp_nodelay=True
    )
    rospy.spin()


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]))
