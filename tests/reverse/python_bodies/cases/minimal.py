"""A publisher and a subscriber of rclpy, as the tutorials write them."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool, Float64, Int32, String


class Counter(Node):
    STEP = 2

    def __init__(self):
        super().__init__("counter")
        self.publisher_ = self.create_publisher(Int32, "count", 10)
        self.names = self.create_publisher(String, "names", 10)
        self.timer = self.create_timer(1, self.timer_callback)
        self.i = 0
        self.label = "none"

    def timer_callback(self):
        msg = Int32()
        msg.data = self.i
        text = String()
        text.data = "Hello World: %d" % self.i
        self.publisher_.publish(msg)
        self.names.publish(text)
        self.get_logger().info('Publishing: "%s"' % text.data)
        self.i += self.STEP
        if self.i >= 10:
            self.i = 0


class Watcher(Node):
    def __init__(self):
        super().__init__("watcher")
        self.level = 0.5
        self.old = 0
        self.on = False
        self.levels = self.create_publisher(Float64, "level", 10)
        self.subscription = self.create_subscription(Int32, "count", self.listener_callback, 10)
        self.enable = self.create_publisher(Bool, "enable", 1)
        self.level_in = self.create_subscription(Float64, "level", lambda m: self.keep(m), 10)

    def listener_callback(self, msg):
        if not 0 <= msg.data < 9 or self.on:
            return
        self.on = msg.data != self.old and not self.on
        self.old = msg.data
        self.level = self.level * 1.5 if self.level < 4 else 0.25
        self.levels.publish(Float64(data=self.level))
        self.enable.publish(Bool(data=self.on))

    def keep(self, message):
        if message.data > 3:
            self.on = False


def main(args=None):
    rclpy.init(args=args)
    counter = Counter()
    watcher = Watcher()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(counter)
    executor.add_node(watcher)
    executor.spin()
    counter.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
