"""How many arguments client libraries of Python give to the functions that they call back."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class CallbackArguments:
    """Where a callback stands among the arguments, by place and by name, and how many it gets.

    It gets one more where something is given under the name `more`, or by place behind it. `gets`
    is the class of the first, where that is no message.
    """

    at: int
    name: str
    count: int
    more: str = ""
    gets: str = ""


CALLBACKS: Mapping[str, CallbackArguments] = {
    "create_subscription": CallbackArguments(2, "callback", 1),
    "create_timer": CallbackArguments(1, "callback", 0),
    "create_service": CallbackArguments(2, "callback", 2),
    **dict.fromkeys(
        (f"add_{when}_set_parameters_callback" for when in ("pre", "on", "post")),
        CallbackArguments(0, "callback", 1, gets="parameters"),
    ),
    "rospy.Subscriber": CallbackArguments(2, "callback", 1, "callback_args"),
    "rospy.Timer": CallbackArguments(1, "callback", 1, gets="rospy.timer.TimerEvent"),
    "rospy.Service": CallbackArguments(2, "handler", 1),
    "rospy.on_shutdown": CallbackArguments(0, "h", 0),
}
