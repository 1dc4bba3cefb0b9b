"""Stops for either bumper for two seconds, then drives on."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Bool


class Safety(Node):
    def __init__(self):
        super().__init__("safety")
        self.blocked = False
        self.last = Twist()
        self.outputs = {
            "cmd": self.create_publisher(Twist, "cmd_vel", 1),
            "lamp": self.create_publisher(Bool, "lamp", 1),
        }
        self.create_subscription(Bool, "bumper/front", self.on_bumper, 1)
        self.create_subscription(Bool, "bumper/rear", self.on_bumper, 1)
        self.create_subscription(Twist, "cmd_vel_raw", self.on_raw, 1)
        self.release = self.create_timer(2.0, self.on_release)
        self.release.cancel()
        self.create_timer(0.5, self.on_tick)

    def on_bumper(self, msg: Bool) -> None:
        if not msg.data:
            return
        self.blocked = True
        if self.release.is_canceled():
            self.get_logger().info("blocked")
        self.release.reset()
        self.outputs["lamp"].publish(Bool(data=True))
        self.outputs["cmd"].publish(self.stop())

    def on_raw(self, msg: Twist) -> None:
        self.last = msg

    def on_release(self) -> None:
        self.release.cancel()
        self.blocked = False
        self.outputs["lamp"].publish(Bool(data=False))

    def on_tick(self) -> None:
        if self.blocked:
            self.outputs["cmd"].publish(self.stop())
        else:
            self.outputs["cmd"].publish(self.last)

    def stop(self) -> Twist:
        return Twist()


def main(args=None):
    rclpy.init(args=args)
    node = Safety()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()


if __name__ == "__main__":
    main()
