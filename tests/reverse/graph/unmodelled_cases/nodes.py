# What has no place in a model, in Python.
import actionlib
import rospy
import tf
import tf2_ros as transforms
from demo.cfg import BaseConfig
from demo.msg import GoAction
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.server import Server


class Base:
    def __init__(self):
        rospy.init_node("base")
        self.a = tf.TransformListener()  #= Base listener self.a
        self.b = transforms.TransformListener(transforms.Buffer())  #= Base listener self.b
        self.c = transforms.StaticTransformBroadcaster()  #= Base static broadcaster self.c
        self.go = actionlib.SimpleActionServer("go", GoAction, self.run, False)  #= Base action server self.go "go" "demo/GoAction"
        self.changed = Server(BaseConfig, self.on_change)  #= Base server self.changed "BaseConfig"
        self.changing = Client("other")  #= Base client self.changing "other"
