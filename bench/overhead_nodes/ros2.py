"""The ping-pong as one writes it by hand, with the messages of the generated package: a or b."""

import sys
import time

import rclpy
from ping_interfaces.msg import PingerPing, PingerState, PongerPong, PongerState, RefereeMark
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

KEPT = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Pinger(Node):
    def __init__(self) -> None:
        super().__init__("a")
        self.n = 0
        self.pong = self.create_publisher(PongerPong, "b/pong", 1000)
        self.mark = self.create_publisher(RefereeMark, "c/mark", 1000)
        self.state = self.create_publisher(PingerState, "a/state", KEPT)
        self.subscription = self.create_subscription(PingerPing, "a/ping", self.receive, 1000)

    def begin(self) -> None:
        while rclpy.ok() and not self.pong.get_subscription_count():
            time.sleep(0.05)
        time.sleep(1.0)  # until the other hears, too
        self.receive(PingerPing())

    def receive(self, message: PingerPing) -> None:
        self.n += 1
        if self.n % 200 == 0:
            self.mark.publish(RefereeMark(k=self.n))
        self.pong.publish(PongerPong(k=self.n))
        self.state.publish(PingerState(server="ping", n=self.n))


class Ponger(Node):
    def __init__(self) -> None:
        super().__init__("b")
        self.ping = self.create_publisher(PingerPing, "a/ping", 1000)
        self.state = self.create_publisher(PongerState, "b/state", KEPT)
        self.subscription = self.create_subscription(PongerPong, "b/pong", self.receive, 1000)

    def begin(self) -> None:
        pass

    def receive(self, message: PongerPong) -> None:
        self.ping.publish(PingerPing())
        self.state.publish(PongerState(server="pong", arguments=str(message.k), n=message.k))


rclpy.init()
player = Pinger() if sys.argv[1] == "a" else Ponger()
try:
    player.begin()
    rclpy.spin(player)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
