import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool

def hush(s):
    s.callback = print


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.p = self.create_publisher(Bool, "a", 1)
        self.sub = self.create_subscription(Bool, "go", self.on_go, 1)
        self.timer = self.create_timer(1.0, self.tick)

    def on_go(self, msg):
        self.p.publish(Bool(data=msg.data))
        self.timer.timer_period_ns *= 5
        del self.sub.callback
        setattr(self.timer, "callback", print)
        hush(self.sub)

    def tick(self):
        self._timers = []


def main():
    rclpy.init()
    rclpy.spin(N())
    rclpy.shutdown()

if __name__ == "__main__":
    main()
