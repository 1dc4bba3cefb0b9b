from rclpy.action import ActionClient
from rclpy.node import Node
from robot_msgs.action import Go
from std_srvs.srv import Empty


class Console(Node):
    def __init__(self):
        super().__init__("console")
        self.client = ActionClient(self, Go, "go")
        self.stop = self.create_client(Empty, "/driver/stop")
