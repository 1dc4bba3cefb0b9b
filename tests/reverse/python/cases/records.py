# What fields of objects hold that a constructor fills which nobody wrote, and enumerations that count.
from dataclasses import dataclass, field
from enum import Enum, IntEnum, auto
from typing import NamedTuple

import rospy
from std_msgs.msg import String


@dataclass(frozen=True)
class Limits:
    depth: int = 5
    topic: str = "a"

    def later(self):
        return rospy.Publisher(self.topic, String, queue_size=1)  #= publisher ? "std_msgs/String" 1


class Pair(NamedTuple):
    depth: int
    topic: str = "c"


@dataclass
class Open:
    depth: int = 5
    topic: str = "d"


@dataclass
class Filled:
    topic: str = "e"

    def __post_init__(self):
        self.topic = "f"


@dataclass
class Apart:
    first: int = field(init=False, default=0)
    topic: str = "g"


class Mode(Enum):
    A = auto()
    B = 4
    C = auto()


class Level(IntEnum):
    A = 4
    B = 2
    C = auto()


class Own(Enum):
    def _generate_next_value_(name, start, count, last):
        return 9

    A = auto()


LIMITS = Limits(topic="b")
PAIR = Pair(7)
OPEN = Open(1, "h")
OPEN.depth = 3
rospy.init_node("n")  #= node "n"
rospy.Publisher(LIMITS.topic, String, queue_size=LIMITS.depth)  #= publisher "b" "std_msgs/String" 5
rospy.Publisher(PAIR.topic, String, queue_size=PAIR.depth)  #= publisher "c" "std_msgs/String" 7
rospy.Publisher(OPEN.topic, String, queue_size=OPEN.depth)  #= publisher "h" "std_msgs/String" ?
rospy.Publisher(Filled("i").topic, String, queue_size=1)  #= publisher ? "std_msgs/String" 1
rospy.Publisher(Apart("j").topic, String, queue_size=1)  #= publisher ? "std_msgs/String" 1
rospy.Publisher("k", String, queue_size=Mode.C.value)  #= publisher "k" "std_msgs/String" 5
rospy.Publisher("l", String, queue_size=Level.C)  #= publisher "l" "std_msgs/String" ?
rospy.Publisher("m", String, queue_size=Own.A.value)  #= publisher "m" "std_msgs/String" ?
