"""The words of roscpp (`rebsync.forward.cpp_words`)."""

from __future__ import annotations

from rebsync.package import Offer

TEMPLATES = "ros1_cpp"
HEADER = "h"
BREAKS_LINES = False
TYPED_PUBLISHERS = False
FRAME = "ros/ros.h"


def guard(package: str, stem: str) -> str:
    return f"{package}_{stem}_H".upper()


def message(type_: str) -> str:
    return type_.replace("/", "::")


def message_header(package: str, type_: str) -> str:
    return f"{type_}.h" if "/" in type_ else f"{package}/{type_}.h"


def offer(offered: Offer) -> str:
    return f"{offered.type}{'Action' * offered.is_action}"


def offer_header(package: str, offered: Offer) -> str:
    return f"{package}/{offer(offered)}.h"


def offered(offered: Offer) -> str:
    return f"ActionServer<{offer(offered)}>" if offered.is_action else "ros::ServiceServer"


def received(type_: str) -> str:
    return f"{message(type_)}::ConstPtr"


def published(publisher: str) -> str:
    return f"{publisher}.publish"


def truth(field: str) -> str:
    return f"{field} != 0"  # ROS's bool is a byte


def publisher(type_: str) -> str:
    return "ros::Publisher"


def publishers(type_: str) -> str:
    return "Publishers"


def subscriber(type_: str) -> str:
    return "ros::Subscriber"
