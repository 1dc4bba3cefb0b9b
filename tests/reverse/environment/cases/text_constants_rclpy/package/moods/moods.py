import rclpy
from moods.msg import Mood
from rclpy.node import Node
from std_msgs.msg import Int32

PREFIX = "ha"
GREEDY = PREFIX + "ppy"


class Moods(Node):
    def __init__(self):
        super().__init__("moods")
        self.out = self.create_publisher(Int32, "out", 10)
        self.create_subscription(Mood, "mood", self.on_mood, 10)

    def on_mood(self, msg):
        if msg.mood == Mood.HAPPY:
            self.out.publish(Int32(data=1))
        elif msg.mood == Mood.SAD:
            self.out.publish(Int32(data=2))
        elif msg.mood == GREEDY:
            self.out.publish(Int32(data=3))
        elif msg.mood == Mood.CALM:
            self.out.publish(Int32(data=5))
        else:
            self.out.publish(Int32(data=4))


def main():
    rclpy.init()
    rclpy.spin(Moods())


if __name__ == "__main__":
    main()
