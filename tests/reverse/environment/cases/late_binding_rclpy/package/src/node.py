import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32
class Level(Node):
    def __init__(self):
        super().__init__("level")
        self.pub = self.create_publisher(Int32, "level", 10)
        for i in (1, 3):
            if i == 1:
                self.timer = self.create_timer(1.0, lambda: self.fire(i))
    def fire(self, n):
        self.pub.publish(Int32(data=n))
def main():
    rclpy.init()
    rclpy.spin(Level())
if __name__ == "__main__":
    main()
