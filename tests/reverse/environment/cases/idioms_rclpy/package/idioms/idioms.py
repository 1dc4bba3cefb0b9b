import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Idioms(Node):
    def __init__(self):
        super().__init__("idioms")
        self.near, self.far = 1, 2
        self.swapped = self.create_publisher(Int32, "swapped", 10)
        self.count = self.create_publisher(Int32, "count", 10)
        self.found = self.create_publisher(Int32, "found", 10)
        self.kind = self.create_publisher(Int32, "kind", 10)
        self.level = self.create_publisher(Int32, "level", 10)
        self.create_subscription(Int32, "number", self.on_number, 10)

    def on_number(self, msg):
        self.near, self.far = self.far, self.near
        self.swapped.publish(Int32(data=self.near))
        self.count.publish(Int32(data=int(msg.data == 3) + (msg.data > 0)))
        for i in (3, 5, 8):
            if i == msg.data:
                break
        else:
            i = -1
        self.found.publish(Int32(data=i))
        match msg.data:
            case 0 | 1:
                k = 1
            case -1:
                k = 2
            case n if n > 10:
                k = 3
            case _:
                k = 4
        self.kind.publish(Int32(data=k))
        if (level := msg.data or 7) > 6 and self.is_low:
            self.level.publish(Int32(data=self.limited(level)))
            self.near = self.far = 1

    @property
    def is_low(self):
        return self.near < 2

    def limited(self, value):
        most = 9
        if value > most:
            return most
        return value


def main():
    rclpy.init()
    rclpy.spin(Idioms())


if __name__ == "__main__":
    main()
