"""The ping-pong as one writes it by hand, with the messages of the generated package: a or b."""

import sys

import rospy
from ping.msg import PingerPing, PingerState, PongerPong, PongerState, RefereeMark

DEPTH = {"queue_size": 1000, "tcp_nodelay": True}


class Pinger:
    def __init__(self) -> None:
        self.n = 0
        self.pong = rospy.Publisher("b/pong", PongerPong, **DEPTH)
        self.mark = rospy.Publisher("c/mark", RefereeMark, **DEPTH)
        self.state = rospy.Publisher("a/state", PingerState, queue_size=1000, latch=True)
        self.subscriber = rospy.Subscriber("a/ping", PingerPing, self.receive, **DEPTH)

    def begin(self) -> None:
        while not rospy.is_shutdown() and not self.pong.get_num_connections():
            rospy.rostime.wallsleep(0.05)
        rospy.rostime.wallsleep(1.0)  # until the other hears, too
        self.receive(PingerPing())

    def receive(self, message: PingerPing) -> None:
        self.n += 1
        if self.n % 200 == 0:
            self.mark.publish(RefereeMark(k=self.n))
        self.pong.publish(PongerPong(k=self.n))
        self.state.publish(PingerState(server="ping", n=self.n))


class Ponger:
    def __init__(self) -> None:
        self.ping = rospy.Publisher("a/ping", PingerPing, **DEPTH)
        self.state = rospy.Publisher("b/state", PongerState, queue_size=1000, latch=True)
        self.subscriber = rospy.Subscriber("b/pong", PongerPong, self.receive, **DEPTH)

    def begin(self) -> None:
        pass

    def receive(self, message: PongerPong) -> None:
        self.ping.publish(PingerPing())
        self.state.publish(PongerState(server="pong", arguments=str(message.k), n=message.k))


rospy.init_node(sys.argv[1])
player = Pinger() if sys.argv[1] == "a" else Ponger()
player.begin()
rospy.spin()
