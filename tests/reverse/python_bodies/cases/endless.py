"""What goes through iterators that have no end, and what only takes some of them."""

import collections
import itertools

import rospy
from std_msgs.msg import Int32

_TURNS = itertools.cycle([1, 2])


class Kept:
    def __init__(self, add):
        self.add = add


class Numbers:
    def __getitem__(self, n):
        return n


class Log:
    def __init__(self):
        self.lines = []

    def fill(self):
        self.lines = list(itertools.count())

    def turn(self):
        for each in _TURNS:
            self.lines = [each]

    def next_line(self):
        self.lines = list(itertools.islice(itertools.count(), 3))


class Endless:
    def __init__(self):
        self.count = 0
        self.ids = itertools.count()
        self.seen = []
        self.log = Log()
        rospy.Subscriber("summed", Int32, self.on_summed)
        rospy.Subscriber("asked", Int32, self.on_asked)
        rospy.Subscriber("spread", Int32, self.on_spread)
        rospy.Subscriber("kept", Int32, self.on_kept)
        rospy.Subscriber("listed", Int32, self.on_listed)
        rospy.Subscriber("indexed", Int32, self.on_indexed)
        rospy.Subscriber("filled", Int32, self.on_filled)
        rospy.Subscriber("turned", Int32, self.on_turned)
        rospy.Subscriber("bound", Int32, self.on_bound)
        rospy.Subscriber("held", Int32, self.on_held)
        rospy.Subscriber("mapped", Int32, self.on_mapped)
        rospy.Subscriber("ending", Int32, self.on_ending)

    def on_summed(self, msg):
        sum(itertools.repeat(1))
        self.count = 1

    def on_asked(self, msg):
        list(iter(lambda: 1, 0))
        self.count = 2

    def on_spread(self, msg):
        max(*map(abs, itertools.count()))
        self.count = 3

    def on_kept(self, msg):
        last = collections.deque(self.ids, maxlen=1)
        self.count = 4

    def on_listed(self, msg):
        all_ = [each for each in zip(itertools.count(), _TURNS)]
        self.count = 5

    def on_indexed(self, msg):
        all_ = sorted(Numbers())
        self.count = 6

    def on_filled(self, msg):
        self.log.fill()
        self.count = 7

    def on_turned(self, msg):
        self.log.turn()
        self.count = 8

    def on_bound(self, msg):
        add = self.seen.append
        for each in self.seen:
            add(each)
        self.count = 9

    def on_held(self, msg):
        seen = [1]
        kept = Kept(seen.append)
        for each in seen:
            kept.add(each)
        self.count = 10

    def on_mapped(self, msg):
        seen = [1]
        for each in seen:
            list(map(seen.append, [1]))
        self.count = 11

    def on_ending(self, msg):
        first = next(self.ids)
        some = list(itertools.islice(self.ids, 3))
        pairs = list(zip(self.ids, [1, 2]))
        self.log.next_line()
        for each in some:
            last = each
        self.count = 12


if __name__ == "__main__":
    rospy.init_node("endless")
    Endless()
    rospy.spin()
