"""Locks that a thread may wait for while it holds them itself."""

import threading

import rospy
from std_msgs.msg import Int32


class Guarded:
    def __init__(self):
        self.count = 0
        self.lock = threading.Lock()
        self.other = threading.Lock()
        self.same = self.lock
        self.again = threading.RLock()
        rospy.Subscriber("nested", Int32, self.on_nested)
        rospy.Subscriber("apart", Int32, self.on_apart)
        rospy.Subscriber("called", Int32, self.on_called)
        rospy.Subscriber("plain", Int32, self.on_plain)
        rospy.Subscriber("reentrant", Int32, self.on_reentrant)
        rospy.Subscriber("renamed", Int32, self.on_renamed)
        rospy.Subscriber("asked", Int32, self.on_asked)
        rospy.Subscriber("hooked", Int32, self.on_hooked)
        rospy.Subscriber("both", Int32, self.on_both)

    def on_nested(self, msg):
        with self.lock:
            with self.lock:
                self.count = 1

    def on_apart(self, msg):
        with self.lock:
            with self.other:
                self.count = 2

    def on_called(self, msg):
        with self.lock:
            self.put(3)

    def on_plain(self, msg):
        with self.lock:
            self.put_unlocked(4)

    def on_reentrant(self, msg):
        with self.again:
            with self.again:
                self.count = 5

    def on_renamed(self, msg):
        with self.same:
            with self.lock:
                self.count = 6

    def on_asked(self, msg):
        with self.lock:
            self.lock.acquire()
            self.count = 7

    def on_hooked(self, msg):
        with self.lock:
            self.count = self.guarded

    def on_both(self, msg):
        with self.lock, self.lock:
            self.count = 9

    @property
    def guarded(self):
        with self.lock:
            return 8

    def put(self, value):
        with self.lock:
            self.count = value

    def put_unlocked(self, value):
        self.count = value


if __name__ == "__main__":
    rospy.init_node("guarded")
    Guarded()
    rospy.spin()
