import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32
class N(Node):
    def __init__(self):
        super().__init__("node")
        self.declare_parameter("speed", 2)
        self.pub = self.create_publisher(Int32, "out", 10)
        self.create_timer(1.0, self.tick)
    def tick(self):
        self.pub.publish(Int32(data=self.get_parameter("speed").value))
def main():
    rclpy.init(); rclpy.spin(N())
if __name__ == "__main__":
    main()
