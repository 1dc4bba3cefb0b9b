import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool


class Rebound(Node):
    def __init__(self):
        super().__init__("rebound")
        self.p = self.create_publisher(Bool, "a", 1)
        self.q = self.create_publisher(Bool, "b", 1)
        self.r = self.create_publisher(Bool, "c", 1)
        self.s = self.create_publisher(Bool, "d", 1)
        self.each = {}
        self.each["e"] = self.create_publisher(Bool, "e", 1)
        self.each["f"] = self.create_publisher(Bool, "f", 1)
        self.act = self.publish_g
        self.g = self.create_publisher(Bool, "g", 1)
        self.h = self.create_publisher(Bool, "h", 1)
        self.create_subscription(Bool, "go", self.on_go, 1)
        self.create_subscription(Bool, "swap", self.on_swap, 1)

    def on_go(self, message):
        self.p.publish(message)
        self.p = self.q
        self.r.publish(message)
        self.r, self.s = self.s, self.r
        self.each["e"].publish(message)
        self.act(message)
        self.act = self.publish_h

    def publish_g(self, message):
        self.g.publish(message)

    def publish_h(self, message):
        self.h.publish(message)

    def on_swap(self, message):
        self.each["e"] = self.each["f"]


def main():
    rclpy.init()
    rclpy.spin(Rebound())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
