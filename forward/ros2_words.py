"""The words of rclcpp (`rebsync.forward.cpp_words`)."""

from __future__ import annotations

from rebsync.names import header_stem

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


def service(type_: str) -> str:
    return f"srv::{type_}"


def service_header(package: str, type_: str) -> str:
    return f"{package}/srv/{header_stem(type_)}.hpp"


def service_server(type_: str) -> str:
    return f"rclcpp::Service<{service(type_)}>::SharedPtr"


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
