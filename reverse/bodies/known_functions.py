"""Functions of C++'s and ROS's libraries that are known by what they do to a node."""

from __future__ import annotations

import re
from functools import lru_cache

from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_declarations import CppParameter
from rebsync.reverse.syntax.cpp_tree import text_of

LOGGING = (
    *("ROS_DEBUG", "ROS_INFO", "ROS_WARN", "ROS_ERROR", "ROS_FATAL", "NODELET_", "ROS_LOG"),
    *("RCLCPP_DEBUG", "RCLCPP_INFO", "RCLCPP_WARN", "RCLCPP_ERROR", "RCLCPP_FATAL", "RCLCPP_LOG"),
)
CONSOLE = frozenset({"printf", "std::printf", "puts", "std::puts"})
STREAMS = frozenset(
    {"std::cout", "std::cerr", "std::clog", "cout", "cerr", "clog", "std::endl", "endl"}
)
# Functions that take time, end the node or run other callbacks, by their last name.
ACTS = {
    **dict.fromkeys(("sleep", "usleep", "nanosleep", "sleep_for", "sleep_until"), "takes time"),
    **dict.fromkeys(("sleepUntil", "clock_nanosleep"), "takes time"),
    **dict.fromkeys(("waitForService", "waitForExistence", "waitForServer"), "waits"),
    **dict.fromkeys(("waitForTransform", "waitForMessage", "waitForResult"), "waits"),
    **dict.fromkeys(("waitForValid", "sendGoalAndWait", "waitForShutdown", "join"), "waits"),
    **dict.fromkeys(("wait", "wait_for", "wait_until", "timed_wait", "call"), "waits"),
    **dict.fromkeys(("shutdown", "requestShutdown", "exit", "_exit", "abort"), "ends the node"),
    **dict.fromkeys(("quick_exit", "terminate", "kill", "raise"), "ends the node"),
    **dict.fromkeys(("spin", "spinOnce", "callAvailable", "callOne"), "runs other callbacks"),
    **dict.fromkeys(("spin_some", "spin_once", "spin_all"), "runs other callbacks"),
    **dict.fromkeys(("spin_until_future_complete", "spin_node_once"), "runs other callbacks"),
    **dict.fromkeys(("wait_for_service", "wait_for_action_server"), "waits"),
    **dict.fromkeys(("create_subscription", "create_wall_timer"), "asks for callbacks"),
    **dict.fromkeys(("create_service", "create_timer"), "asks for callbacks"),
    **dict.fromkeys(("longjmp", "fork", "execv", "execvp"), "leaves the function"),
    **dict.fromkeys(("subscribe", "createTimer", "createWallTimer"), "asks for callbacks"),
    **dict.fromkeys(("advertiseService", "createSteadyTimer"), "asks for callbacks"),
}
# Free functions that wait for what comes from elsewhere, as long as they are told to, or for ever.
_AWAITS = frozenset({"select", "pselect", "poll", "ppoll", "epoll_wait", "epoll_pwait"})
ASSERTS = frozenset({"ROS_ASSERT", "ROS_ASSERT_MSG", "assert", "BOOST_ASSERT", "ROS_BREAK"})
ACTS |= dict.fromkeys(ASSERTS, "checks")
# Member functions that only look at an array, a number, a publisher, a timer, or in the mailbox of
# generated code at the message that is served.
LOOKS = frozenset(
    {
        *("at", "back", "count", "empty", "front", "getNumSubscribers", "getTopic", "hasPending"),
        *("hasStarted", "isLatched", "isValid", "isZero", "length", "max_size", "size", "toNSec"),
        *("get_subscription_count", "get_publisher_count", "get_topic_name", "get_logger"),
        *("is_canceled", "time_until_trigger", "service_is_ready", "nanoseconds", "seconds"),
        *("toSec", "c_str", "str", "cbegin", "cend"),
        *("is_activated", "assert_liveliness", "get_network_flow_endpoints", "get_actual_qos"),
        *("can_loan_messages", "get_content_filter", "is_cft_enabled", "get_gid"),
        *("now", "self", "sender", "arrival", "expiry", "waitingTime"),
    }
)
_VALUES = frozenset(
    {
        *(
            "close",
            "fcntl",
            "fclose",
            "ioctl",
            "open",
            "setParam",
            "socket",
            "write",
        ),
        *("abs", "acos", "asin", "atan", "atan2", "atof", "atoi", "cbrt", "ceil", "clamp", "cos"),
        *("cosh", "defined", "exp", "exp2", "expm1", "fabs", "fabsf", "floor", "fmax", "fmin"),
        *("fmod", "fprintf", "hypot", "isfinite", "isinf", "isnan", "isnormal", "labs", "log"),
        *("log10", "log1p", "log2", "lround", "max", "min", "mod", "pow", "printf", "puts"),
        *("rand", "remainder", "rint", "round", "roundf", "signbit", "sin", "sinh", "sqrt"),
        *("sqrtf", "tan", "tanh", "to_string", "trunc", "toSec", "fromSec"),
        *("static_cast", "narrow_cast", "numeric_cast", "normalize_angle", "from_degrees"),
        *("shortest_angular_distance", "to_degrees", "createQuaternionMsgFromYaw"),
        *("createQuaternionFromYaw", "createQuaternionFromRPY", "getYaw", "quatToRPY"),
        "to_yaml",
        *("setRPY", "setOrigin", "setRotation", "setX", "setY", "setZ", "setValue"),
    }
)
# Member functions of containers, which copy what they get.
_COPIES = frozenset(
    {
        *("push_back", "push", "push_front", "reserve", "resize", "insert", "assign", "at"),
        *("count", "find", "erase", "substr", "append"),
    }
)
_CONVERSION = re.compile(
    r"(?:::)?(?:u?int(?:8|16|32|64)?(?:_t)?|float|double|bool|char|long|short|unsigned|size_t)\Z"
)
_LIBRARIES = re.compile(
    r"(?:::)?(?:std|boost|ros|tf2?|tf2_ros|Eigen|cv|pcl|diagnostic_updater|\w+_msgs|\w+_srvs)::"
)
# Pointers to what is not constant.
_SHARED = re.compile(
    r"(?<!Const)(?<!ConstShared)(?<!ConstUnique)(?:Shared|Unique)?Ptr\b|\w+_ptr<(?!\s*const\b)"
)
# What makes an object of a type.
_MAKES = re.compile(r"(?:std|boost)::make_(?:shared|unique)<\s*(?:const\s+)?([\w:]+)")
# Types whose objects, when they are called, give an element of themselves.
_MATRIX = re.compile(
    r"(?:const\s+)?(?:::)?Eigen::(?:Matrix|(?:Row)?Vector|Array)(?:X?\d?X?[dfi]|<.*>)\Z", re.DOTALL
)


def is_matrix(type_: str) -> bool:
    """Whether to call an object of a type only gives an element of it."""
    return _MATRIX.match(type_) is not None


def acts(call: CppCall) -> str | None:
    """What a call does to the node by its name: it takes time, or ends it; None for others."""
    name = call.name.rpartition("::")[2]
    if name in _AWAITS and call.target is None:
        return "waits"
    return ACTS.get(name)


def takes_values(call: CppCall) -> bool:
    """Whether a function is known to change none of its arguments."""
    return _takes_values(call.name, call.target is not None)


@lru_cache(maxsize=1024)  # the same few names are called again and again
def _takes_values(called: str, of_object: bool) -> bool:
    made = _MAKES.match(called)
    name = made[1] if made is not None else called.partition("<")[0]
    plain = name.rpartition("::")[2]
    if called.startswith(LOGGING) or plain in _VALUES or _CONVERSION.match(called):
        return True
    if of_object:
        return plain in _COPIES
    return plain[:1].isupper() and type_takes_values(name)


def may_change(parameter: CppParameter) -> bool:
    """Whether a function may change what it gets for a parameter: also through a pointer."""
    return parameter.may_change or _SHARED.search(text_of(parameter.type)) is not None


def type_takes_values(name: str) -> bool:
    """Whether constructors of a type are known to change none of their arguments."""
    return bool(_CONVERSION.match(name) or _LIBRARIES.match(name))
