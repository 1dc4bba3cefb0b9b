import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool


class Groups(Node):
    def __init__(self):
        super().__init__("groups")
        self.group = ReentrantCallbackGroup()
        self.busy = False
        self.out = self.create_publisher(Bool, "out", 1)
        self.create_subscription(Bool, "go", self.on_go, 1, callback_group=self.group)
        self.create_timer(1.0, self.tell, callback_group=self.group)

    def on_go(self, message):
        self.busy = True
        self.busy = False

    def tell(self):
        self.out.publish(Bool(data=self.busy))


def main():
    rclpy.init()
    executor = MultiThreadedExecutor()
    executor.add_node(Groups())
    executor.spin()
