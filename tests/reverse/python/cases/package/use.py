from std_msgs.msg import Empty

from . import names
from package.names import TOPIC, Base


class Derived(Base):
    def __init__(self):
        super().__init__("derived")
        self.create_publisher(Empty, TOPIC, 1)  #= publisher "shared" "std_msgs/Empty" 1
        self.create_publisher(Empty, names.TOPIC + "_2", 1)  #= publisher "shared_2" "std_msgs/Empty" 1

    def make(self, topic):
        self.create_publisher(Empty, topic, 1)  #= publisher "made" "std_msgs/Empty" 1
