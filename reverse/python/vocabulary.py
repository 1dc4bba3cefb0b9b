"""What rospy and rclpy code says to ask ROS for something: tables, from which the readers work.

Each entry names a call, the kind of thing it asks for, and its arguments by their names, in order.
"""

from __future__ import annotations

from enum import Enum

from rebsync.records import dataclass
from rebsync.reverse.libraries.routines import Access


class Kind(Enum):
    """What a call asks for."""

    NODE = "node"
    PUBLISHER = "publisher"
    SUBSCRIPTION = "subscription"
    SINGLE = "single"
    TIMER = "timer"
    RATE = "rate"
    PARAMETER = "parameter"
    DECLARED = "declared"
    SET = "set"
    SERVICE = "service"
    CLIENT = "client"


@dataclass(frozen=True, slots=True)
class Ask:
    """A call that asks for something: `arguments` are the roles of its arguments in their order.

    `names` are roles of arguments that are given by name; a role stands for itself too. `least` is
    how many arguments a call has at least that is taken for this one without knowing its object.
    """

    kind: Kind
    arguments: tuple[str, ...]
    names: tuple[tuple[str, str], ...] = ()
    access: Access | None = None
    least: int = 9

    def role_of(self, keyword: str) -> str:
        """The role of an argument that is given by name."""
        return dict(self.names).get(keyword, keyword)


_ROSPY_NAMES = (
    *(("data_class", "type"), ("service_class", "type"), ("topic_type", "type")),
    *(("queue_size", "depth"), ("latch", "latched"), ("handler", "callback")),
    *(("oneshot", "one_shot"), ("param_name", "name"), ("param_value", "value")),
    *(("topic", "name"), ("caller_id", ""), ("frequency", "hz")),
)
_SUBSCRIBED = ("name", "type", "callback", "callback_args", "depth")
_ADVERTISED = ("name", "type", "", "", "latched", "", "depth")


def _rospy(kind: Kind, *arguments: str, access: Access | None = None) -> Ask:
    return Ask(kind, arguments, _ROSPY_NAMES, access)


ROSPY: dict[str, Ask] = {
    "init_node": _rospy(Kind.NODE, "name", "", "anonymous"),
    "Publisher": _rospy(Kind.PUBLISHER, *_ADVERTISED),
    "Subscriber": _rospy(Kind.SUBSCRIPTION, *_SUBSCRIBED),
    "wait_for_message": _rospy(Kind.SINGLE, "name", "type"),
    "Timer": _rospy(Kind.TIMER, "period", "callback", "one_shot"),
    "Rate": _rospy(Kind.RATE, "hz"),
    "Service": _rospy(Kind.SERVICE, "name", "type", "callback"),
    "ServiceProxy": _rospy(Kind.CLIENT, "name", "type"),
    "get_param": _rospy(Kind.PARAMETER, "name", "default", access=Access.GET),
    "get_param_cached": _rospy(Kind.PARAMETER, "name", "default", access=Access.GET),
    "set_param": _rospy(Kind.PARAMETER, "name", "value", access=Access.SET),
    "has_param": _rospy(Kind.PARAMETER, "name", access=Access.HAS),
    "delete_param": _rospy(Kind.PARAMETER, "name", access=Access.DELETE),
    "search_param": _rospy(Kind.PARAMETER, "name", access=Access.SEARCH),
}

_RCLPY_NAMES = (
    *(("node_name", "name"), ("msg_type", "type"), ("srv_type", "type"), ("srv_name", "name")),
    *(("topic", "name"), ("qos_profile", "depth"), ("timer_period_sec", "period")),
    *(("frequency", "hz"), ("alternative_value", "default"), ("topic_name", "name")),
)


def _rclpy(kind: Kind, *arguments: str, access: Access | None = None, least: int = 9) -> Ask:
    return Ask(kind, arguments, _RCLPY_NAMES, access, least)


_NODE = _rclpy(Kind.NODE, "name")
_PUBLISHER = _rclpy(Kind.PUBLISHER, "type", "name", "depth", least=3)
_DECLARE = Access.DECLARE

# Methods of a node.
NODE: dict[str, Ask] = {
    "create_publisher": _PUBLISHER,
    "create_lifecycle_publisher": _PUBLISHER,
    "create_subscription": _rclpy(Kind.SUBSCRIPTION, "type", "name", "callback", "depth", least=4),
    "create_timer": _rclpy(Kind.TIMER, "period", "callback", "", "", "autostart", least=2),
    "create_rate": _rclpy(Kind.RATE, "hz", least=1),
    "create_service": _rclpy(Kind.SERVICE, "type", "name", "callback", least=3),
    "create_client": _rclpy(Kind.CLIENT, "type", "name", least=2),
    "declare_parameter": _rclpy(Kind.PARAMETER, "name", "default", access=_DECLARE, least=1),
    "declare_parameters": _rclpy(Kind.DECLARED, access=_DECLARE, least=2),
    "get_parameter": _rclpy(Kind.PARAMETER, "name", access=Access.GET, least=1),
    "get_parameter_or": _rclpy(Kind.PARAMETER, "name", "default", access=Access.GET, least=2),
    "has_parameter": _rclpy(Kind.PARAMETER, "name", access=Access.HAS, least=1),
    "undeclare_parameter": _rclpy(Kind.PARAMETER, "name", access=Access.DELETE, least=1),
    "set_parameters": _rclpy(Kind.SET, "parameters", access=Access.SET),
}
# Functions of the library.
RCLPY: dict[str, Ask] = {
    "rclpy.create_node": _NODE,
    "rclpy.node.Node": _NODE,
    "rclpy.Node": _NODE,
    "rclpy.wait_for_message.wait_for_message": _rclpy(Kind.SINGLE, "type", "", "name"),
}
FILTER = "message_filters.Subscriber"
FILTER_OF_ROSPY = _rospy(Kind.SUBSCRIPTION, "name", "type", "depth")
FILTER_OF_RCLPY = _rclpy(Kind.SUBSCRIPTION, "", "type", "name", "depth")

NODES = frozenset(
    {
        *("rclpy.node.Node", "rclpy.Node", "rclpy.lifecycle.Node", "rclpy.lifecycle.LifecycleNode"),
        *("rclpy.lifecycle.node.LifecycleNode",),
    }
)
# Functions that give the name of the node, with which private names begin, or its namespace.
OWN_NAMES = {"rospy.get_name": "~", "rospy.get_namespace": ""}

_TIMES = frozenset(
    {
        *("rospy.Duration", "rospy.Duration.from_sec", "rospy.rostime.Duration", "genpy.Duration"),
        *("rclpy.duration.Duration", "rclpy.time.Duration"),
    }
)
# What is kept of a subscription or publisher whose queue a name stands for, in messages.
PROFILES = {
    "qos_profile_sensor_data": 5,
    "qos_profile_services_default": 10,
    "qos_profile_parameters": 1000,
    "qos_profile_parameter_events": 1000,
    "qos_profile_system_default": 0,
    "qos_profile_action_status_default": 1,
    "qos_profile_best_available": 10,
}
PRESETS = {
    "SENSOR_DATA": 5,
    "SERVICES_DEFAULT": 10,
    "PARAMETERS": 1000,
    "PARAMETER_EVENTS": 1000,
    "SYSTEM_DEFAULT": 0,
    "ACTION_STATUS_DEFAULT": 1,
    "BEST_AVAILABLE": 10,
}


def is_time(name: str) -> bool:
    """Whether what is called makes a span of time."""
    return name in _TIMES


def rclpy_name(name: str) -> bool:
    """Whether something is of the client library of ROS 2."""
    return name.startswith("rclpy.")


def interface_of(name: str) -> str | None:
    """`std_msgs/String` for `std_msgs.msg.String` or the like; None for what is no interface."""
    parts = name.split(".")
    if name in ("rospy.AnyMsg", "rospy.msg.AnyMsg"):
        return "*"
    for kind in ("msg", "srv", "action"):
        if kind in parts[1:-1]:
            return f"{parts[parts.index(kind, 1) - 1]}/{parts[-1]}"
    return None
