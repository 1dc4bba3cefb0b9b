#!/usr/bin/env python3
import mesh
from std_msgs.msg import Int32


class Relay:
    def __init__(self, session):
        self.limit = session.parameter("limit", 3)
        self.count = 0
        self.pub = session.declare_publisher(Int32, "out", 10)
        session.declare_subscriber(Int32, "in", self.on)
        session.every(2.0, self.tick)

    def on(self, message):
        if message.data < self.limit:
            self.count = message.data
            mesh.log_info("took %d", self.count)

    def tick(self):
        self.pub.put(Int32(data=self.count))


class Sink:
    def __init__(self, session):
        self.last = 0
        session.declare_subscriber(Int32, "out", self.on)

    def on(self, message):
        self.last = message.data


def main():
    session = mesh.Session("relay")
    relay = Relay(session)
    sink = Sink(session)
    session.run()


if __name__ == "__main__":
    main()
