#!/usr/bin/env python3
import rclpy
from std_msgs.msg import Int32

count = 3
pub = None


def cb(m):
    global count
    count += m.data
    pub.publish(Int32(data=count))


def main():
    global pub
    rclpy.init()
    node = rclpy.create_node("n")
    pub = node.create_publisher(Int32, "out", 9)
    node.create_subscription(Int32, "inp", cb, 9)
    rclpy.spin(node)


if __name__ == "__main__":
    main()
