# Constants and classes that another file of the package imports.
from rclpy.node import Node

TOPIC = "shared"


class Base(Node):
    def __init__(self, name):
        super().__init__(name)  #= node "derived"
        self.make("made")

    def make(self, topic):
        raise NotImplementedError
