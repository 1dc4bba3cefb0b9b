"""How many arguments client libraries of Python give to the functions that they call back."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class CallbackArguments:
    """Where a callback stands among the arguments, by place and by name, and how many it gets.

    It gets one more where something is given under the name `more`, or by place behind it.
    """

    at: int
    name: str
    count: int
    more: str = ""


CALLBACKS: Mapping[str, CallbackArguments] = {
    "create_subscription": CallbackArguments(2, "callback", 1),
    "create_timer": CallbackArguments(1, "callback", 0),
    "create_service": CallbackArguments(2, "callback", 2),
    "add_on_set_parameters_callback": CallbackArguments(0, "callback", 1),
    "rospy.Subscriber": CallbackArguments(2, "callback", 1, "callback_args"),
    "rospy.Timer": CallbackArguments(1, "callback", 1),
    "rospy.Service": CallbackArguments(2, "handler", 1),
    "rospy.on_shutdown": CallbackArguments(0, "h", 0),
}
