#!/usr/bin/env python3
import mesh
from std_msgs.msg import Int32


class Beat(mesh.Session):
    def __init__(self):
        super().__init__("beat")
        self.step = self.parameter("step", 2)
        self.count = 0
        self.was_heard = False
        self.pub = self.declare_publisher(Int32, "beats", 10)
        self.every(3, self.tick)
        self.declare_subscriber(Int32, "beats", self.heard)

    def tick(self):
        self.count = self.step
        self.pub.put(Int32(data=self.count))
        mesh.log_info("beat %d", self.count)

    def heard(self, message):
        if message.data == 2:
            mesh.pause(1)
            self.was_heard = True


if __name__ == "__main__":
    beat = Beat()
    beat.run()
