"""Which types of messages, services and actions the names of Python stand for."""

from __future__ import annotations

from rebsync.reverse.libraries.python import messages_of_any_type


def interface_of(name: str) -> str | None:
    """`std_msgs/String` for `std_msgs.msg.String` or the like; None for what is no interface."""
    parts = name.split(".")
    if name in messages_of_any_type():
        return "*"
    for kind in ("msg", "srv", "action"):
        if kind in parts[1:-1]:
            return f"{parts[parts.index(kind, 1) - 1]}/{parts[-1]}"
    return None
