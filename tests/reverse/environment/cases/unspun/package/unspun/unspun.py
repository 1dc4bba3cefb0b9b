import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool

class N(Node):
    def __init__(self):
        super().__init__("n")
        self.p = self.create_publisher(Bool, "a", 1)
        self.sub = self.create_subscription(Bool, "go", self.on_go, 1)
        self.once = False

    def on_go(self, msg):
        self.p.publish(Bool(data=msg.data))



def main():
    rclpy.init()
    n = N()
    e = SingleThreadedExecutor()
    e.spin()

if __name__ == "__main__":
    main()
