"""The words of rclcpp (`rebsync.forward.cpp_words`)."""

from __future__ import annotations

from rebsync.names import header_stem
from rebsync.package import Offer

TEMPLATES = "ros2_cpp"
HEADER = "hpp"
BREAKS_LINES = True
TYPED_PUBLISHERS = True
FRAME = "rclcpp/rclcpp.hpp"


def guard(package: str, stem: str) -> str:
    return f"{package}__{stem}_HPP_".upper()


def message(type_: str) -> str:
    package, slash, name = type_.rpartition("/")
    return f"{package}::msg::{name}" if slash else f"msg::{name}"


def message_header(package: str, type_: str) -> str:
    owner, slash, name = type_.rpartition("/")
    return f"{owner if slash else package}/msg/{header_stem(name)}.hpp"


def offer(offered: Offer) -> str:
    return f"{_folder(offered)}::{offered.type}"


def offer_header(package: str, offered: Offer) -> str:
    return f"{package}/{_folder(offered)}/{header_stem(offered.type)}.hpp"


def offered(offered: Offer) -> str:
    kind = "rclcpp_action::Server" if offered.is_action else "rclcpp::Service"
    return f"{kind}<{offer(offered)}>::SharedPtr"


def _folder(offered: Offer) -> str:
    return "action" if offered.is_action else "srv"


def received(type_: str) -> str:
    return f"{message(type_)}::ConstSharedPtr"


def published(publisher: str) -> str:
    return f"{publisher}->publish"


def truth(field: str) -> str:
    return field


def publisher(type_: str) -> str:
    return f"rclcpp::Publisher<{message(type_)}>::SharedPtr"


def publishers(type_: str) -> str:
    return f"Publishers<{message(type_)}>"


def subscriber(type_: str) -> str:
    return f"rclcpp::Subscription<{message(type_)}>::SharedPtr"
