"""rclpy, and what is used with it: message_filters, actions, nodes with managed states."""

from __future__ import annotations

from rebsync.reverse.libraries.routines import (
    Access,
    Effect,
    Kind,
    Language,
    Library,
    LogCall,
    Routine,
    Table,
)

_KEYWORDS = (
    *(("node_name", "name"), ("msg_type", "type"), ("srv_type", "type"), ("srv_name", "name")),
    *(("topic", "name"), ("qos_profile", "depth"), ("timer_period_sec", "period")),
    *(("frequency", "hz"), ("alternative_value", "default"), ("topic_name", "name")),
    *(("parameter_list", "parameters"),),
)

_ACTION_KEYWORDS = (("action_type", "type"), ("action_name", "name"))


def _asks(kind: Kind, *arguments: str, access: Access | None = None, least: int = 9) -> Routine:
    return Routine(kind, arguments, _KEYWORDS, access, flat=True, least=least)


def _hook(*arguments: str, **keywords: str) -> Routine:
    return Routine(Kind.HOOK, arguments, tuple(keywords.items()))


def _events(*names: str) -> Routine:
    return _hook(**dict.fromkeys(names, "callback"))


_NAMED = _asks(Kind.NODE, "name")
_PUBLISHER = _asks(Kind.PUBLISHER, "type", "name", "depth", least=3)
_DECLARE = Access.DECLARE
_CALLED = _hook("callback", callback="callback")
_NODE = {
    "create_publisher": _PUBLISHER,
    "create_lifecycle_publisher": _PUBLISHER,
    "create_subscription": _asks(Kind.SUBSCRIPTION, "type", "name", "callback", "depth", least=4),
    "create_timer": _asks(Kind.TIMER, "period", "callback", "", "", "autostart", least=2),
    "create_rate": _asks(Kind.RATE, "hz", least=1),
    "create_service": _asks(Kind.SERVICE, "type", "name", "callback", least=3),
    "create_client": _asks(Kind.CLIENT, "type", "name", least=2),
    "declare_parameter": _asks(Kind.PARAMETER, "name", "default", access=_DECLARE, least=1),
    "declare_parameters": _asks(Kind.DECLARED, access=_DECLARE, least=2),
    "get_parameter": _asks(Kind.PARAMETER, "name", access=Access.GET, least=1),
    "get_parameter_or": _asks(Kind.PARAMETER, "name", "default", access=Access.GET, least=2),
    "has_parameter": _asks(Kind.PARAMETER, "name", access=Access.HAS, least=1),
    "undeclare_parameter": _asks(Kind.PARAMETER, "name", access=Access.DELETE, least=1),
    "get_parameters": _asks(Kind.READ, "names", access=Access.GET, least=1),
    "get_parameters_by_prefix": _asks(Kind.READ, "prefix", access=Access.GET, least=1),
    **dict.fromkeys(
        ("set_parameters", "set_parameters_atomically"),
        _asks(Kind.SET, "parameters", access=Access.SET),
    ),
    "get_name": Routine(Kind.NAME, result="~"),
    "get_namespace": Routine(Kind.NAME),
    "get_clock": Routine(Kind.VALUE, does=Effect.NONE),
    "get_logger": Routine(),
    "destroy_node": Routine(Kind.START, does=Effect.ENDS),
    **dict.fromkeys(("destroy_subscription", "destroy_timer"), Routine(does=Effect.ENDS)),
    "create_guard_condition": _CALLED,
    "add_on_set_parameters_callback": _CALLED,
    "add_pre_set_parameters_callback": _CALLED,
    "add_post_set_parameters_callback": _CALLED,
    "set_parameters_callback": _CALLED,
}
_LOG_KEYWORDS = frozenset(
    {"throttle_duration_sec", "throttle_time_source_type", "skip_first", "once", "name"}
)
_LOGGERS = ("get_logger", "rclpy.logging.get_logger")
_LEVELS = frozenset({0, 10, 20, 30, 40, 50}) | {
    f"rclpy.{of}.LoggingSeverity.{level}"
    for of in ("logging", "impl.logging_severity")
    for level in ("UNSET", "DEBUG", "INFO", "WARN", "ERROR", "FATAL")
}
_SPAN = Routine(Kind.SPAN, ("seconds", "nanoseconds"))
_NODES = (
    *("rclpy.node.Node", "rclpy.Node", "rclpy.lifecycle.Node", "rclpy.lifecycle.LifecycleNode"),
    "rclpy.lifecycle.node.LifecycleNode",
)
_EVENTS = ("deadline", "liveliness", "matched", "incompatible_type", "incompatible_qos")
_OF_PUBLISHERS = _events(*_EVENTS, "liveliness_lost")
_OF_SUBSCRIPTIONS = _events(*_EVENTS, "message_lost")
_FUNCTIONS = {
    "rclpy.create_node": _NAMED,
    "rclpy.node.Node": _NAMED,
    "rclpy.Node": _NAMED,
    "rclpy.wait_for_message.wait_for_message": _asks(Kind.SINGLE, "type", "", "name"),
    "message_filters.Subscriber": _asks(Kind.SUBSCRIPTION, "", "type", "name", "depth", least=3),
    "rclpy.init": Routine(
        Kind.START, ("arguments",), (("args", "arguments"),), result="rclpy.InitContextManager"
    ),
    "rclpy.shutdown": Routine(Kind.START, does=Effect.ENDS),
    "rclpy.spin": Routine(Kind.SPIN),
    "rclpy.spin_until_future_complete": Routine(result="future", does=Effect.RUNS),
    "rclpy.spin_once": Routine(Kind.SERVE),
    "rclpy.ok": Routine(Kind.RUNNING, result="bool"),
    "rclpy.logging.get_logger": Routine(),
    "rclpy.duration.Duration": _SPAN,
    "rclpy.time.Duration": _SPAN,
    "rclpy.action.ActionServer": Routine(
        Kind.HOOK,
        ("", "", "", "callback"),
        tuple(
            (name, "callback")
            for name in (
                *("execute_callback", "goal_callback", "handle_accepted_callback"),
                "cancel_callback",
            )
        ),
    ),
    "rclpy.event_handler.PublisherEventCallbacks": _OF_PUBLISHERS,
    "rclpy.event_handler.SubscriptionEventCallbacks": _OF_SUBSCRIPTIONS,
    "rclpy.qos_event.PublisherEventCallbacks": _OF_PUBLISHERS,
    "rclpy.qos_event.SubscriptionEventCallbacks": _OF_SUBSCRIPTIONS,
}
_METHODS = {
    "rclpy.node.Node": _NODE,
    "rclpy.publisher.Publisher": {"publish": Routine(Kind.PUBLISH, ("message",))},
    "rclpy.parameter.Parameter": {
        "get_parameter_value": Routine(Kind.VALUE),
    },
    "rclpy.timer.Timer": {"cancel": Routine(does=Effect.CHANGES)},
    "rclpy.client.Client": {"call_async": Routine(does=Effect.SENDS)},
    "rclpy.clock.Clock": {"now": Routine(Kind.CLOCK)},
    "rclpy.executors.Executor": {
        "spin": Routine(Kind.SPIN),
        "spin_once": Routine(Kind.SERVE),
        "add_node": Routine(Kind.START),
        "remove_node": Routine(Kind.START, does=Effect.ENDS),
        "shutdown": Routine(Kind.START, does=Effect.ENDS),
        "try_shutdown": Routine(Kind.START, does=Effect.ENDS),
    },
    "rclpy.action.ActionServer": {
        "register_execute_callback": _hook("callback", execute_callback="callback"),
        "register_cancel_callback": _hook("callback", cancel_callback="callback"),
        "register_handle_accepted_callback": _hook("callback", handle_accepted_callback="callback"),
    },
    "rclpy.action.ActionClient": {
        "send_goal_async": Routine(
            Kind.HOOK,
            ("", "callback"),
            (("feedback_callback", "callback"),),
            does=Effect.SENDS,
        )
    },
    "rclpy.context.Context": {"on_shutdown": _CALLED},
    "rclpy.InitContextManager": {
        "__enter__": Routine(Kind.START),
        "__exit__": Routine(Kind.START, does=Effect.ENDS),
    },
    "rclpy.task.Future": {
        "add_done_callback": _CALLED,
        "set_result": Routine(does=Effect.CHANGES),
    },
}
# What is kept of a subscription or publisher whose queue a name stands for, in messages.
_PROFILES = {
    "qos_profile_sensor_data": 5,
    "qos_profile_services_default": 10,
    "qos_profile_parameters": 1000,
    "qos_profile_parameter_events": 1000,
    "qos_profile_system_default": 0,
    "qos_profile_action_status_default": 1,
    "qos_profile_best_available": 10,
    "QoSPresetProfiles.SENSOR_DATA": 5,
    "QoSPresetProfiles.SERVICES_DEFAULT": 10,
    "QoSPresetProfiles.PARAMETERS": 1000,
    "QoSPresetProfiles.PARAMETER_EVENTS": 1000,
    "QoSPresetProfiles.SYSTEM_DEFAULT": 0,
    "QoSPresetProfiles.ACTION_STATUS_DEFAULT": 1,
    "QoSPresetProfiles.BEST_AVAILABLE": 10,
}
# Reliability and durability of those that are not reliable and volatile.
_POLICIES = {
    **dict.fromkeys(
        ("qos_profile_sensor_data", "QoSPresetProfiles.SENSOR_DATA"), ("best_effort", "volatile")
    ),
    **dict.fromkeys(
        ("qos_profile_action_status_default", "QoSPresetProfiles.ACTION_STATUS_DEFAULT"),
        ("reliable", "transient_local"),
    ),
    **dict.fromkeys(
        ("qos_profile_system_default", "QoSPresetProfiles.SYSTEM_DEFAULT"),
        ("system_default", "system_default"),
    ),
    **dict.fromkeys(
        ("qos_profile_best_available", "QoSPresetProfiles.BEST_AVAILABLE"),
        ("best_available", "best_available"),
    ),
}

LIBRARIES = (
    Library(
        "rclpy",
        Language.PYTHON,
        _FUNCTIONS,
        _METHODS,
        brings=frozenset(
            {
                "ament_index_python",
                "builtin_interfaces",
                "rcl_interfaces",
                "rosgraph_msgs",
                "rpyutils",
            }
            | {"action_msgs", "lifecycle_msgs", "unique_identifier_msgs", "yaml"}
        ),
        unmodelled={
            "rclpy.action.ActionServer": Routine(
                Kind.ACTION_SERVER, ("", "type", "name"), _ACTION_KEYWORDS, flat=True
            ),
            "rclpy.action.ActionClient": Routine(
                Kind.ACTION_CLIENT, ("", "type", "name"), _ACTION_KEYWORDS, flat=True
            ),
            "tf2_ros.TransformBroadcaster": Routine(Kind.BROADCASTER),
            "tf2_ros.StaticTransformBroadcaster": Routine(Kind.STATIC_BROADCASTER),
            "tf2_ros.TransformListener": Routine(Kind.LISTENER),
        },
        nodes=frozenset(_NODES),
        managed=frozenset(n for n in _NODES if n.startswith("rclpy.lifecycle.")),
        managed_senders=frozenset({"create_lifecycle_publisher"}),
        own_arguments={
            **dict.fromkeys(("cli_args", "parameter_overrides"), "None"),
            **{"use_global_arguments": "True", "ignore_override": "False"},
        },
        marks=("rclpy", "message_filters"),
        table=Table(profiles=_PROFILES, policies=_POLICIES),
        logs=("get_logger",),
        log_arguments={
            f"{made}().{level}": LogCall(only_text=True, formats=False, keywords=_LOG_KEYWORDS)
            for made in _LOGGERS
            for level in ("debug", "info", "warn", "warning", "error", "fatal")
        }
        | {f"{made}().set_level": LogCall(formats=False, levels=_LEVELS) for made in _LOGGERS},
        strict=True,
    ),
)
