#!/usr/bin/env python3
# Objects that nobody in the files gives, and those of libraries, which are trusted.
import importlib
import json
import logging
import math
import time

import rospy
import tf
from std_msgs.msg import Int32

LATER = None


class Writer:
    def __init__(self, journal, sinks, *rest):
        self.journal = journal
        self.sinks = sinks
        self.rest = rest
        self.count = 0
        self.log = logging.getLogger("writer")
        self.listener = tf.TransformListener()
        self.times = []
        rospy.Timer(rospy.Duration(1), self.on_first)
        rospy.Timer(rospy.Duration(1), self.on_other)
        rospy.Timer(rospy.Duration(1), self.on_plain)
        rospy.Subscriber("seen", Int32, self.on_seen)

    def on_first(self, event):
        self.journal.write(1)
        self.count = self.journal.write(event)
        self.journal.file.handle.write(1)
        self.journal.file().write(1)
        self.sinks[0].write(1)
        self.sinks()
        self.rest[0].write(1)

    def on_other(self, event):
        one, other = self.sinks
        other.write(1)
        for sink in self.sinks:
            sink.write(1)
        put(self.journal)
        LATER.write(1)
        importlib.import_module("later").write(1)

    def on_plain(self, event):
        self.times.append(time.time())
        self.log.info("%s", event.current_real.to_sec())
        text = json.dumps({"a": math.sin(1.0)})
        words = text.split(",")[0].strip()
        age = rospy.Time.now().to_sec()
        self.listener.clear()

    def on_seen(self, msg):
        if self.count > 2:
            self.journal.write(msg.data)


def put(journal):
    journal.write(1)
