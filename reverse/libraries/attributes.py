"""Which attributes objects of client libraries of Python have, and the classes of what these give.

Those of all versions that are in use: what is not here is in none of them.
"""

from __future__ import annotations

import datetime
import pathlib
import queue
import threading
from collections.abc import Mapping

from rebsync.reverse.libraries import python
from rebsync.reverse.libraries.module_names import in_python
from rebsync.reverse.libraries.registry import derived

NODE = "rclpy.node.Node"
_OFNODES = """
    PARAM_REL_TOL add_on_set_parameters_callback add_post_set_parameters_callback
    add_pre_set_parameters_callback add_waitable assert_liveliness clients context count_clients
    count_publishers count_services count_subscribers create_client create_guard_condition
    create_publisher create_rate create_service create_subscription create_timer declare_parameter
    declare_parameters default_callback_group describe_parameter describe_parameters destroy_client
    destroy_guard_condition destroy_node destroy_publisher destroy_rate destroy_service
    destroy_subscription destroy_timer executor get_client_names_and_types_by_node
    get_clients_info_by_service get_clock get_fully_qualified_name get_fully_qualified_node_names
    get_logger get_name get_namespace get_node_names get_node_names_and_namespaces
    get_node_names_and_namespaces_with_enclaves get_parameter get_parameter_or get_parameter_type
    get_parameter_types get_parameters get_parameters_by_prefix
    get_publisher_names_and_types_by_node get_publishers_info_by_topic
    get_servers_info_by_service get_service_names_and_types
    get_service_names_and_types_by_node get_subscriber_names_and_types_by_node
    get_subscriptions_info_by_topic get_topic_names_and_types guards handle has_parameter
    list_parameters publishers remove_on_set_parameters_callback remove_post_set_parameters_callback
    remove_pre_set_parameters_callback remove_waitable resolve_service_name resolve_topic_name
    services set_descriptor set_parameters set_parameters_atomically set_parameters_callback
    subscriptions timers undeclare_parameter wait_for_node waitables
    _allow_undeclared_parameters _apply_descriptor _apply_descriptor_and_set _apply_descriptors
    _apply_floating_point_range _apply_integer_range _call_post_set_parameters_callback
    _call_pre_set_parameters_callback _check_undeclared_parameters _count_clients_or_servers
    _count_publishers_or_subscribers _declare_parameter_common _get_info_by_topic
    _set_parameters_atomically_common _validate_qos_or_depth_parameter
    _validate_topic_or_service_name _wake_executor _clients _clock _context _default_callback_group
    _descriptors _guards _logger _on_set_parameters_callbacks _parameter_event_publisher
    _parameter_overrides _parameter_service _parameters _post_set_parameters_callbacks
    _pre_set_parameters_callbacks _publishers _rate_group _services _set_parameters_atomically
    _subscriptions _time_source _timers _type_description_service"""
_OF_STATES = """
    add_managed_entity create_lifecycle_publisher destroy_lifecycle_publisher on_activate on_cleanup
    on_configure on_deactivate on_error on_shutdown trigger_activate trigger_cleanup
    trigger_configure trigger_deactivate trigger_shutdown _callbacks _managed_entities
    _state_machine"""
_THREAD = """
    daemon getName ident isAlive isDaemon is_alive join name native_id run setDaemon setName
    start"""
_OF_TOPICS = (
    "data_class get_num_connections impl md5sum name reg_type resolved_name type unregister"
)
_OF_VALUES = """
    bool_value integer_value double_value string_value byte_array_value bool_array_value
    integer_array_value double_array_value string_array_value"""
_TIME = "from_sec from_seconds is_zero nsecs secs set canon to_nsec to_sec to_time now"

# A time that is made without a clock: it has no operator with one of a node's clock.
_SYSTEM_TIME = "rclpy.time.Time of the system"
# By a class the argument without which it makes an object of another.
OTHERWISE = {"rclpy.time.Time": ("clock_type", _SYSTEM_TIME)}
_CLIENT_TIMES = (
    ("time", "duration"),
    ("rclpy.time.Time", "rclpy.duration.Duration"),
    (_SYSTEM_TIME, "rclpy.duration.Duration"),
)
_TIMES = ("rospy.Time", "rospy.Duration", "time", "duration")  # the last two in messages

# By the full name of a class the attributes of its objects, beside those of all objects.
_ATTRIBUTES: Mapping[str, str] = {
    NODE: _OFNODES,
    "rclpy.publisher.Publisher": """
        assert_liveliness destroy event_handlers get_subscription_count handle msg_type publish
        publisher_handle qos_profile topic topic_name wait_for_all_acked""",
    "rclpy.subscription.Subscription": """
        callback callback_group destroy event_handlers get_publisher_count handle msg_type
        qos_profile raw subscription_handle topic topic_name""",
    "rclpy.timer.Timer": """
        callback callback_group cancel clock destroy handle is_canceled is_ready reset
        time_since_last_call time_until_next_call timer_handle timer_period_ns""",
    "rclpy.client.Client": """
        call call_async callback_group client_handle configure_introspection context destroy handle
        get_pending_request qos_profile remove_pending_request service_is_ready service_name
        srv_name srv_type wait_for_service""",
    "rclpy.timer.Rate": "destroy sleep",
    "rclpy.guard_condition.GuardCondition": "callback callback_group destroy handle trigger",
    "rclpy.qos.QoSProfile": """
        avoid_ros_namespace_conventions deadline depth durability get_c_qos_profile history lifespan
        liveliness liveliness_lease_duration reliability""",
    "rclpy.clock.Clock": """
        clock_handle clock_type create_jump_callback handle now ros_time_is_active
        set_ros_time_override sleep_for sleep_until""",
    "rclpy.parameter.Parameter": """
        Type from_parameter_msg get_parameter_value name to_parameter_msg type_ value""",
    "rcl_interfaces/ParameterValue": f"type {_OF_VALUES}",
    **dict.fromkeys(
        ("rclpy.time.Time", _SYSTEM_TIME),
        "clock_type from_msg nanoseconds seconds_nanoseconds to_msg",
    ),
    "rclpy.duration.Duration": "from_msg get_c_duration nanoseconds to_msg",
    "rclpy.logging.Logger": """
        contexts debug error fatal get_child get_effective_level info is_enabled_for log
        logger_sublogger_namepair name set_level warn warning""",
    "rospy.Publisher": f"publish {_OF_TOPICS}",
    "rospy.Subscriber": f"callback callback_args {_OF_TOPICS}",
    "rospy.Timer": f"shutdown {_THREAD}",
    "rospy.timer.TimerEvent": "current_expected current_real last_duration last_expected last_real",
    "rclpy.task.Future": """
        add_done_callback cancel cancelled done exception remove_pending_request result
        set_exception set_result""",
    "rospy.Rate": "last_time remaining sleep sleep_dur",
    **dict.fromkeys(_TIMES, _TIME),
    **{
        f"{of.__module__}.{of.__name__}": " ".join(dir(of))
        for of in (
            *(datetime.datetime, datetime.date, datetime.time, datetime.timedelta),
            *(datetime.timezone, threading.Event, threading.Thread, threading.Timer),
            *(queue.Queue, queue.PriorityQueue, queue.LifoQueue, pathlib.Path),
        )
    },
}
PATH = "pathlib.Path"
_COUNTS = ("get_subscription_count", "get_publisher_count")
# Modules that turn angles into quaternions and back: tuples and arrays of numbers.
_TURNING = (
    *("tf.transformations", "tf_transformations", "transformations", "tf_conversions"),
    *("tf_conversions.transformations", "transforms3d.euler", "transforms3d.quaternions"),
)
_OF_TURNS = """
    euler_from_quaternion quaternion_from_euler quaternion_multiply quaternion_inverse
    quaternion_conjugate euler_from_matrix translation_from_matrix quaternion_from_matrix euler2quat
    quat2euler qmult"""
_OF_NUMBERS = """
    sin cos tan arcsin arccos arctan arctan2 sinh cosh tanh sqrt cbrt abs absolute fabs sign hypot
    deg2rad rad2deg radians degrees exp log log2 log10 floor ceil round rint trunc clip minimum
    maximum mod fmod power isnan isinf isfinite square float32 float64 int32 int64"""
# Functions of numpy that give a number for numbers.
OF_NUMBERS_ALONE = frozenset(f"numpy.{name}" for name in _OF_NUMBERS.split())
# By the full name of a function or method the class of what it gives.
_GIVES: Mapping[str, str] = {
    "rclpy.create_node": NODE,
    f"{NODE}.create_publisher": "rclpy.publisher.Publisher",
    f"{NODE}.create_subscription": "rclpy.subscription.Subscription",
    f"{NODE}.create_timer": "rclpy.timer.Timer",
    f"{NODE}.create_client": "rclpy.client.Client",
    f"{NODE}.create_rate": "rclpy.timer.Rate",
    f"{NODE}.create_guard_condition": "rclpy.guard_condition.GuardCondition",
    "rclpy.action.ActionClient.send_goal_async": "rclpy.task.Future",
    "rclpy.task.Future.exception": "builtins.Exception",
    "rclpy.client.Client.call_async": "rclpy.task.Future",
    **dict.fromkeys(
        (f"{NODE}.declare_parameter", f"{NODE}.get_parameter"), "rclpy.parameter.Parameter"
    ),
    f"{NODE}.get_clock": "rclpy.clock.Clock",
    f"{NODE}.get_logger": "rclpy.logging.Logger",
    **dict.fromkeys((f"{NODE}.get_name", f"{NODE}.get_namespace"), "str"),
    "rclpy.logging.get_logger": "rclpy.logging.Logger",
    "rclpy.clock.Clock.now": "rclpy.time.Time",
    **dict.fromkeys(
        ("rclpy.time.Time.to_msg", f"{_SYSTEM_TIME}.to_msg"), "builtin_interfaces/Time"
    ),
    "rclpy.duration.Duration.to_msg": "builtin_interfaces/Duration",
    **dict.fromkeys(("rospy.Time.now", "rospy.get_rostime", "rospy.Time.from_sec"), "rospy.Time"),
    "rospy.Duration.from_sec": "rospy.Duration",
    "rospy.get_time": "number",
    **dict.fromkeys(("rospy.get_name", "rospy.get_namespace", "rospy.get_caller_id"), "str"),
    **{f"{of}.{name}": "number" for of in _TIMES for name in ("to_sec", "to_nsec")},
    "datetime.timedelta.total_seconds": "number",
    "datetime.datetime.timestamp": "number",
    **{f"datetime.datetime.{name}": "str" for name in ("isoformat", "strftime")},
    "datetime.datetime.date": "datetime.date",
    "datetime.datetime.time": "datetime.time",
    **dict.fromkeys(("os.getcwd", "platform.node", "socket.gethostname"), "str"),
    **{f"{PATH}.{name}": PATH for name in ("absolute", "joinpath", "with_name", "with_suffix")},
    **dict.fromkeys(("rospy.resolve_name", "rospy.remap_name"), "str"),
    "rospy.Publisher.get_num_connections": "number",
    **dict.fromkeys(
        (
            f"rclpy.publisher.Publisher.{_COUNTS[0]}",
            f"rclpy.subscription.Subscription.{_COUNTS[1]}",
        ),
        "number",
    ),
    "rclpy.time.Time.from_msg": "rclpy.time.Time",
    "rclpy.duration.Duration.from_msg": "rclpy.duration.Duration",
    "rclpy.parameter.Parameter.get_parameter_value": "rcl_interfaces/ParameterValue",
    **{f"{of}.{name}": "numbers" for of in _TURNING for name in _OF_TURNS.split()},
    **dict.fromkeys(("builtins.pow", "numpy.linalg.norm"), "number"),
}
PARAMETER = "rclpy.parameter.Parameter"
FLOAT_METHODS = frozenset({"to_sec", "total_seconds", "timestamp", "rospy.get_time"})
# By the full name of an attribute the class of its value.
_HOLDS: Mapping[str, str] = {
    **{f"{of}.nanoseconds": "number" for pair in _CLIENT_TIMES[1:] for of in pair},
    **{f"numpy.{name}": "number" for name in ("pi", "e", "inf", "nan")},
    "sys.argv": "texts",
    **{f"rcl_interfaces/ParameterValue.{name}_value": "number" for name in ("bool", "integer")},
    "rcl_interfaces/ParameterValue.string_value": "str",
    "rclpy.timer.Timer.timer_period_ns": "number",
    "rclpy.qos.qos_profile_sensor_data": "rclpy.qos.QoSProfile",
    "rclpy.qos.qos_profile_system_default": "rclpy.qos.QoSProfile",
    **{
        f"rospy.timer.TimerEvent.{when}_{which}": "rospy.Time"
        for when in ("current", "last")
        for which in ("real", "expected")
    },
    **{f"{of}.{name}": "number" for of in _TIMES for name in ("secs", "nsecs")},
    f"{PATH}.parent": PATH,
    **{f"{PATH}.{name}": "str" for name in ("name", "stem", "suffix")},
    **{f"datetime.timedelta.{name}": "number" for name in ("days", "seconds", "microseconds")},
    **{
        f"datetime.{of}.{name}": "number"
        for of, names in (
            ("datetime", "year month day hour minute second microsecond"),
            ("date", "year month day"),
            ("time", "hour minute second microsecond"),
        )
        for name in names.split()
    },
}
# Those of messages are of the same classes.
SAME_TIMES = {"rospy.Time": "time", "rospy.Duration": "duration"}
TIMES = frozenset({*SAME_TIMES, *(name for pair in _CLIENT_TIMES for name in pair)})
_SPAN, _MOMENT, _DAY = "datetime.timedelta", "datetime.datetime", "datetime.date"
# What an operator gives for times and paths, by the classes of its operands.
GIVEN_BY: Mapping[tuple[str, str, str], str] = {
    **{("+", time, span): time for time, span in _CLIENT_TIMES},
    **{("+", span, time): time for time, span in _CLIENT_TIMES},
    **{("-", time, span): time for time, span in _CLIENT_TIMES},
    **{("-", time, time): span for time, span in _CLIENT_TIMES},
    **{(sign, span, span): span for _, span in _CLIENT_TIMES for sign in "+-"},
    **{("<", each, each): "number" for pair in _CLIENT_TIMES for each in pair},
    **{(sign, "duration", "number"): "duration" for sign in ("*", "/", "//")},
    **{(sign, "duration", "duration"): "number" for sign in ("/", "//")},
    ("*", "number", "duration"): "duration",
    ("+", _SPAN, _SPAN): _SPAN,
    ("-", _SPAN, _SPAN): _SPAN,
    ("*", _SPAN, "number"): _SPAN,
    ("*", "number", _SPAN): _SPAN,
    ("/", _SPAN, "number"): _SPAN,
    ("/", _SPAN, _SPAN): "number",
    ("+", _MOMENT, _SPAN): _MOMENT,
    ("+", _SPAN, _MOMENT): _MOMENT,
    ("-", _MOMENT, _SPAN): _MOMENT,
    ("-", _MOMENT, _MOMENT): _SPAN,
    ("+", _DAY, _SPAN): _DAY,
    ("-", _DAY, _SPAN): _DAY,
    ("-", _DAY, _DAY): _SPAN,
    **{("<", each, each): "number" for each in (_SPAN, _MOMENT, _DAY, "datetime.time", PATH)},
    **{("/", *pair): PATH for pair in ((PATH, PATH), (PATH, "str"), ("str", PATH))},
}
# Methods that take no arguments.
_ALONE = frozenset(
    {
        *(f"{NODE}.{name}" for name in ("get_logger", "get_clock", "get_name", "get_namespace")),
        *(f"rclpy.timer.Timer.{name}" for name in ("cancel", "reset", "is_ready", "is_canceled")),
        *("rclpy.clock.Clock.now", "rclpy.time.Time.to_msg", "rclpy.duration.Duration.to_msg"),
        *("rospy.Time.now", "rospy.get_time", "rospy.get_rostime", "rospy.Timer.shutdown"),
        *(f"{of}.{name}" for of in _TIMES for name in ("to_sec", "to_nsec", "is_zero")),
    }
)
_OF_MESSAGES = frozenset(
    {
        *("serialize", "deserialize", "serialize_numpy", "deserialize_numpy"),
        "get_fields_and_field_types",
    }
)
# Enumerations, and what they are beside: the members have these too.
_OF_MEMBERS: Mapping[str, frozenset[str]] = {
    "enum.Enum": frozenset(dir(object)),
    "enum.IntEnum": frozenset(dir(int)),
    "enum.StrEnum": frozenset(dir(str)),
    "enum.Flag": frozenset(dir(object)),
    "enum.IntFlag": frozenset(dir(int)),
}
_MEMBER = frozenset({"name", "value", "_name_", "_value_", "__members__", "__dict__"})
# Bases of which nothing is to be seen in the objects.
_PLAIN_BASES = frozenset({"builtins.object", "abc.ABC", "typing.Generic", "typing.Protocol"})


def _is_node(name: str) -> bool:
    """Whether a class is one of rclpy's nodes, by any of the names that packages give it."""
    return name in python.node_classes() and name.startswith("rclpy.")


@derived
def attributes_of(name: str) -> frozenset[str] | None:
    """The attributes of objects of a class, by its full name; None if no table has it."""
    if _is_node(name):
        return frozenset((_OFNODES + _OF_STATES * (name in python.managed())).split())
    if name in _OF_MEMBERS:
        return _OF_MEMBERS[name] | _MEMBER
    found = "" if name in _PLAIN_BASES else _ATTRIBUTES.get(name)
    return frozenset(found.split()) if found is not None else None


@derived
def result_of(name: str) -> str:
    """The class of what a function or method gives; empty if that is not known."""
    of, _, last = name.rpartition(".")
    if _is_node(of):
        name = f"{NODE}.{last}"
    return _GIVES.get(name, "")


@derived
def takes_nothing(name: str) -> bool:
    """Whether a function or method takes no arguments, by its full name."""
    of, _, last = name.rpartition(".")
    return name in _ALONE or (_is_node(of) and f"{NODE}.{last}" in _ALONE)


def held_in(name: str) -> str:
    """The class of the value of an attribute, or of a constant; empty if that is not known."""
    return _HOLDS.get(name) or _CONSTANTS.get(type(in_python(name)), "")


def is_float(name: str) -> bool:
    """Whether what Python's own library has under a full name is a number with a point."""
    return isinstance(in_python(name), float)


_CONSTANTS = {int: "number", float: "number", bool: "number", str: "str", bytes: "bytes"}


def may_be_of_messages(name: str) -> bool:
    """Whether a message may have an attribute that is none of its fields."""
    return name in _OF_MESSAGES or name.startswith("_") or name.isupper()
