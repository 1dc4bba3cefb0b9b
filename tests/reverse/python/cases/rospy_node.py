# What rospy offers: subscriptions, timers, services, parameters, callbacks of each kind.
from functools import partial

import message_filters
import rospy
from demo.srv import Reset, ResetResponse
from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import Image, LaserScan

pub = None


def heard(msg, more=None):
    pub.publish(msg)


class Handler:
    def __call__(self, msg):
        pass


class Base(object):
    def on_base(self, msg):
        pass


class Watcher(Base):
    def __init__(self):
        self.rate = rospy.get_param("~rate", 20.0)  #= parameter get "~rate" = 20.0
        self.gain = rospy.get_param("gain")  #= parameter get "gain"
        rospy.set_param("/seen", True)  #= parameter set "/seen" := true
        rospy.set_param(rospy.get_param("~base") + "/" + "x", 1)  #= parameter set {"~base" : value + '/x'} := 1 //= parameter get "~base"
        if rospy.has_param("~old"):  #= parameter has "~old"
            rospy.delete_param("~old")  #= parameter delete "~old"
        rospy.search_param("deep")  #= parameter search "deep"
        self.a = rospy.Subscriber("scan", LaserScan, self.scan, queue_size=3)  #= subscription "scan" "sensor_msgs/LaserScan" 3 -> Watcher.scan
        rospy.Subscriber("b", LaserScan, callback=self.on_base)  #= subscription "b" "sensor_msgs/LaserScan" ? -> Base.on_base
        rospy.Subscriber("n", numpy_msg(LaserScan), self.scan, queue_size=3)  #= subscription "n" "sensor_msgs/LaserScan" 3 -> Watcher.scan
        rospy.Subscriber("c", LaserScan, lambda m: self.scan(m), queue_size=1)  #= subscription "c" "sensor_msgs/LaserScan" 1 -> lambda
        rospy.Subscriber("d", LaserScan, partial(heard, more=1), queue_size=1)  #= subscription "d" "sensor_msgs/LaserScan" 1 -> heard
        rospy.Subscriber("e", LaserScan, Handler(), queue_size=1)  #= subscription "e" "sensor_msgs/LaserScan" 1 -> Handler.__call__ by Handler
        rospy.Timer(rospy.Duration(1.0 / self.rate), self.tick)  #= timer {"~rate" = 0.05 : 1.0 / value} -> Watcher.tick
        rospy.Timer(rospy.Duration(2), self.tick, oneshot=True)  #= timer 2 one_shot=true -> Watcher.tick
        rospy.Timer(rospy.Duration(1, 500000000), self.tick)  #= timer 1.5 -> Watcher.tick
        rospy.Service("~reset", Reset, self.reset)  #= service "~reset" "demo/Reset" -> Watcher.reset
        self.client = rospy.ServiceProxy("/other/reset", Reset)  #= client "/other/reset" "demo/Reset"
        first = message_filters.Subscriber("left", Image, queue_size=4)  #= subscription "left" "sensor_msgs/Image" 4 -> Watcher.both
        second = message_filters.Subscriber("right", Image)  #= subscription "right" "sensor_msgs/Image" ? -> Watcher.both
        both = message_filters.TimeSynchronizer([first, second], 10)
        both.registerCallback(self.both)
        third = message_filters.Subscriber("third", Image, queue_size=5)  #= subscription "third" "sensor_msgs/Image" 5 -> Watcher.scan
        cache = message_filters.Cache(third, 10)
        cache.registerCallback(self.scan)

    def both(self, left, right):
        pass

    def scan(self, msg):
        pass

    def tick(self, event):
        pass

    def reset(self, request):
        return ResetResponse()

    def run(self):
        rate = rospy.Rate(self.rate)  #= rate {"~rate" = 20.0}
        while not rospy.is_shutdown():
            rate.sleep()


def main():
    global pub
    rospy.init_node("watcher")  #= node "watcher"
    pub = rospy.Publisher("out", LaserScan, queue_size=1)  #= publisher "out" "sensor_msgs/LaserScan" 1
    rospy.wait_for_message("first", LaserScan)  #= subscription "first" "sensor_msgs/LaserScan" 1 single
    Watcher().run()


if __name__ == "__main__":
    main()
