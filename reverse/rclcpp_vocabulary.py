"""What rclcpp code says to ask ROS for something: tables, from which the readers work.

Calls are described as those of roscpp are, in `roscpp_vocabulary`; names are not looked up in the
namespace of a node handle, and what waits in a queue is part of a quality of service.
"""

from __future__ import annotations

from rebsync.reverse.graph import Access
from rebsync.reverse.roscpp_vocabulary import Ask, Kind
from rebsync.reverse.syntax.cpp_words import places_of


def _asks(
    kind: Kind, *arguments: str, access: Access | None = None, wall: bool = False, least: int = 9
) -> Ask:
    return Ask(kind, arguments, access, wall=wall, flat=True, least=least)


def _image(kind: Kind, *arguments: str) -> Ask:
    return Ask(kind, arguments, type="sensor_msgs/Image", transport="image_transport", flat=True)


# The classes of nodes, by their names in `rclcpp` and `rclcpp_lifecycle`.
NODE_CLASSES = frozenset({"Node", "LifecycleNode"})
NODE_SCOPES = frozenset({"rclcpp", "rclcpp_lifecycle"})
NAMED = _asks(Kind.NODE, "name")
MAKERS = frozenset({"make_shared", "make_unique"})

# Classes of timers, which a program may make by itself and then add to a node.
TIMERS: dict[str, Ask] = {
    "GenericTimer": _asks(Kind.TIMER, "", "period", "callback"),
    "WallTimer": _asks(Kind.TIMER, "period", "callback", wall=True),
}

# Methods of a node.
NODE: dict[str, Ask] = {
    "create_publisher": _asks(Kind.PUBLISHER, "name", "depth", least=2),
    "create_generic_publisher": _asks(Kind.PUBLISHER, "name", "interface", "depth", least=3),
    "create_subscription": _asks(Kind.SUBSCRIPTION, "name", "depth", "callback", least=3),
    "create_generic_subscription": _asks(
        Kind.SUBSCRIPTION, "name", "interface", "depth", "callback", least=4
    ),
    "create_wall_timer": _asks(
        Kind.TIMER, "period", "callback", "", "autostart", wall=True, least=2
    ),
    "create_timer": _asks(Kind.TIMER, "period", "callback", least=2),
    "create_service": _asks(Kind.SERVICE, "name", "callback", least=2),
    "create_client": _asks(Kind.CLIENT, "name", least=1),
    "declare_parameter": _asks(Kind.PARAMETER, "name", "default", access=Access.DECLARE, least=1),
    "declare_parameters": _asks(Kind.DECLARED, "name", "default", access=Access.DECLARE),
    "get_parameter": _asks(Kind.PARAMETER, "name", "variable", access=Access.GET),
    "get_parameter_or": _asks(Kind.PARAMETER, "name", "variable", "default", access=Access.GET),
    "get_parameters": _asks(Kind.READ, "name", access=Access.GET),
    "has_parameter": _asks(Kind.PARAMETER, "name", access=Access.HAS),
    "undeclare_parameter": _asks(Kind.PARAMETER, "name", access=Access.DELETE),
    "set_parameter": _asks(Kind.SET, "name", access=Access.SET),
}
# Those of them that give the value of a parameter, or write it to an argument.
READING = frozenset({"declare_parameter", "get_parameter", "get_parameter_or"})

# Functions, by what is written before their name and the name.
FUNCTIONS: dict[tuple[str, str], Ask] = {
    ("rclcpp", "create_publisher"): _asks(Kind.PUBLISHER, "", "name", "depth"),
    ("rclcpp", "create_subscription"): _asks(Kind.SUBSCRIPTION, "", "name", "depth", "callback"),
    ("rclcpp", "create_timer"): _asks(Kind.TIMER, "", "", "period", "callback"),
    ("rclcpp", "create_wall_timer"): _asks(Kind.TIMER, "period", "callback", wall=True),
    ("image_transport", "create_publisher"): _image(Kind.PUBLISHER, "", "name", "depth"),
    ("image_transport", "create_camera_publisher"): _image(Kind.PUBLISHER, "", "name", "depth"),
    ("image_transport", "create_subscription"): _image(
        Kind.SUBSCRIPTION, "", "name", "callback", "", "depth"
    ),
    ("image_transport", "create_camera_subscription"): _image(
        Kind.SUBSCRIPTION, "", "name", "callback", "", "depth"
    ),
}

# Qualities of service by the classes that make them, with the depth they have by themselves (None:
# the first argument says it), and by the names that rmw gives them.
QUALITIES: dict[str, int | None] = {
    "QoS": None,
    "QoSInitialization": None,
    "KeepLast": None,
    "KeepAll": 0,
    "SensorDataQoS": 5,
    "ServicesQoS": 10,
    "ParametersQoS": 1000,
    "ParameterEventsQoS": 1000,
    "RosoutQoS": 1000,
    "ClockQoS": 1,
    "SystemDefaultsQoS": 0,
    "BestAvailableQoS": 10,
}
PROFILES = {
    "rmw_qos_profile_default": 10,
    "rmw_qos_profile_sensor_data": 5,
    "rmw_qos_profile_services_default": 10,
    "rmw_qos_profile_parameters": 1000,
    "rmw_qos_profile_parameter_events": 1000,
    "rmw_qos_profile_system_default": 0,
    "rmw_qos_profile_best_available": 10,
}
# Methods that change the quality that they are called on, and give it; the others of them leave
# alone what is read of it.
CHANGING = frozenset({"keep_last", "keep_all", "history", "durability"}) | {
    "transient_local",
    "durability_volatile",
}
LEAVING = frozenset(
    {
        *("reliable", "best_effort", "reliability", "deadline", "lifespan", "liveliness"),
        *("liveliness_lease_duration", "avoid_ros_namespace_conventions", "get_rmw_qos_profile"),
        *("reliability_best_available", "durability_best_available"),
    }
)

# Spans of time: how many seconds a unit has, by its class and by the suffix of a literal.
UNITS = {
    "nanoseconds": 1e-9,
    "microseconds": 1e-6,
    "milliseconds": 1e-3,
    "seconds": 1.0,
    "minutes": 60.0,
    "hours": 3600.0,
}
SUFFIXES = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0}
RATIOS = {"std::nano": 1e-9, "std::micro": 1e-6, "std::milli": 1e-3}
# Functions that make a span of a number, with the seconds of its unit.
FROM = {"from_seconds": 1.0, "from_nanoseconds": 1e-9}
# Methods that give what a parameter holds.
HELD = frozenset(
    {
        *("as_bool", "as_int", "as_double", "as_string", "get_value", "as_bool_array"),
        *("as_integer_array", "as_double_array", "as_string_array", "get_parameter_value"),
    }
)
# Classes that hold the value that they are made of.
VALUES = frozenset({"ParameterValue"})

# Macros that make a component of a class.
COMPONENT = "RCLCPP_COMPONENTS_REGISTER_NODE"
# Without this no file of a package uses rclcpp.
MARK = b"rclcpp"

_NAMES = frozenset({*NODE, *(name for _, name in FUNCTIONS), *NODE_CLASSES, *TIMERS})
_PLAIN = frozenset(name.encode() for name in _NAMES)


def words_in(data: bytes, words: frozenset[bytes]) -> list[tuple[int, int, str]]:
    """The places of words of the vocabulary in a text whose words are known, from the first.

    Start, end, and the word.
    """
    found = [(at, word) for word in _PLAIN & words for at in places_of(data, word)]
    return [(at, at + len(word), word.decode()) for at, word in sorted(found)]
