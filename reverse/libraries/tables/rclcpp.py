"""rclcpp, and what is used with it: rclcpp_lifecycle, rclcpp_components, image_transport."""

from __future__ import annotations

from rebsync.reverse.libraries.routines import (
    Access,
    Effect,
    Kind,
    Language,
    Library,
    Routine,
    Table,
)


def _asks(
    kind: Kind,
    *arguments: str,
    access: Access | None = None,
    wall: bool = False,
    least: int = 9,
    result: str = "",
) -> Routine:
    return Routine(kind, arguments, access=access, wall=wall, flat=True, least=least, result=result)


def _image(kind: Kind, *arguments: str) -> Routine:
    return Routine(
        kind, arguments, type="sensor_msgs/Image", transport="image_transport", flat=True
    )


def _does(effect: Effect, *names: str, kind: Kind = Kind.OTHER) -> dict[str, Routine]:
    return dict.fromkeys(names, Routine(kind, does=effect))


_SENT = "rclcpp::Publisher"
_NODE = {
    "create_publisher": _asks(Kind.PUBLISHER, "name", "depth", least=2, result=_SENT),
    "create_generic_publisher": _asks(
        Kind.PUBLISHER, "name", "interface", "depth", least=3, result=_SENT
    ),
    "create_subscription": _asks(Kind.SUBSCRIPTION, "name", "depth", "callback", least=3),
    "create_generic_subscription": _asks(
        Kind.SUBSCRIPTION, "name", "interface", "depth", "callback", least=4
    ),
    "create_wall_timer": _asks(
        Kind.TIMER, "period", "callback", "", "autostart", wall=True, least=2
    ),
    "create_timer": _asks(Kind.TIMER, "period", "callback", least=2),
    "create_service": _asks(Kind.SERVICE, "name", "callback", least=2),
    "create_client": _asks(Kind.CLIENT, "name", least=1, result="rclcpp::Client"),
    "declare_parameter": _asks(Kind.PARAMETER, "name", "default", access=Access.DECLARE, least=1),
    "declare_parameters": _asks(Kind.DECLARED, "name", "default", access=Access.DECLARE, least=2),
    "get_parameter": _asks(Kind.PARAMETER, "name", "variable", access=Access.GET, least=1),
    "get_parameter_or": _asks(
        Kind.PARAMETER, "name", "variable", "default", access=Access.GET, least=2
    ),
    "get_parameters": _asks(Kind.READ, "name", access=Access.GET, least=1),
    "has_parameter": _asks(Kind.PARAMETER, "name", access=Access.HAS, least=1),
    "undeclare_parameter": _asks(Kind.PARAMETER, "name", access=Access.DELETE, least=1),
    "set_parameter": _asks(Kind.SET, "name", access=Access.SET, least=1),
    "now": Routine(Kind.CLOCK),
    **_does(Effect.NONE, "get_logger"),
}
_NAMED = _asks(Kind.NODE, "name")
_FUNCTIONS = {
    "rclcpp::Node": _NAMED,
    "rclcpp::LifecycleNode": _NAMED,
    "rclcpp_lifecycle::Node": _NAMED,
    "rclcpp_lifecycle::LifecycleNode": _NAMED,
    "rclcpp::create_publisher": _asks(Kind.PUBLISHER, "", "name", "depth"),
    "rclcpp::create_subscription": _asks(Kind.SUBSCRIPTION, "", "name", "depth", "callback"),
    "rclcpp::create_timer": _asks(Kind.TIMER, "", "", "period", "callback"),
    "rclcpp::create_wall_timer": _asks(Kind.TIMER, "period", "callback", wall=True),
    # Classes of timers, which a program may make by itself and then add to a node.
    "rclcpp::GenericTimer": _asks(Kind.TIMER, "", "period", "callback"),
    "rclcpp::WallTimer": _asks(Kind.TIMER, "period", "callback", wall=True),
    "rclcpp::Rate": Routine(Kind.RATE, ("hz",)),
    "rclcpp::WallRate": Routine(Kind.RATE, ("hz",), wall=True),
    # What packages use that are seldom read with it.
    "nav2_util::declare_parameter_if_not_declared": _asks(
        Kind.PARAMETER, "", "name", "default", access=Access.DECLARE, least=2
    ),
    "image_transport::create_publisher": _image(Kind.PUBLISHER, "", "name", "depth"),
    "image_transport::create_camera_publisher": _image(Kind.PUBLISHER, "", "name", "depth"),
    "image_transport::create_subscription": _image(
        Kind.SUBSCRIPTION, "", "name", "callback", "", "depth"
    ),
    "image_transport::create_camera_subscription": _image(
        Kind.SUBSCRIPTION, "", "name", "callback", "", "depth"
    ),
    "rclcpp::init": Routine(Kind.START, ("arguments", "arguments")),
    "rclcpp::spin": Routine(Kind.SPIN),
    "rclcpp::spin_some": Routine(Kind.SERVE),
    "rclcpp::spin_all": Routine(Kind.SERVE, ("timeout",)),
    "rclcpp::spin_once": Routine(Kind.SERVE, ("timeout",)),
    "rclcpp::spin_node_some": Routine(does=Effect.RUNS),
    "rclcpp::spin_node_once": Routine(does=Effect.RUNS),
    "rclcpp::spin_until_future_complete": Routine(does=Effect.RUNS),
    "rclcpp::shutdown": Routine(Kind.SHUTDOWN),
    "rclcpp::ok": Routine(Kind.RUNNING, result="bool"),
    "rclcpp::to_yaml": Routine(),
    **_does(Effect.NONE, "rclcpp::get_logger", "rclcpp::get_c_string"),
    **_does(Effect.LOGS, "rcutils_logging_set_logger_level"),
    "rclcpp::Duration": Routine(Kind.SPAN),
}
_METHODS = {
    "rclcpp::Node": _NODE,
    # The part of a node that has its parameters, and what asks other nodes for theirs.
    "rclcpp::node_interfaces::NodeParametersInterface": {
        n: r for n, r in _NODE.items() if r.access is not None
    },
    "rclcpp::SyncParametersClient": {},
    "rclcpp::AsyncParametersClient": {},
    _SENT: {
        "publish": Routine(Kind.PUBLISH, ("message",)),
        **_does(Effect.NONE, "get_topic_name", "is_activated"),
        **_does(Effect.NONE, "get_subscription_count", kind=Kind.AUDIENCE),
        **_does(Effect.NONE, "assert_liveliness", "get_network_flow_endpoints", "get_actual_qos"),
        **_does(Effect.NONE, "can_loan_messages", "get_gid"),
    },
    "rclcpp::Subscription": _does(
        Effect.NONE, "get_publisher_count", "get_content_filter", "is_cft_enabled"
    ),
    "rclcpp::TimerBase": _does(Effect.NONE, "is_canceled", "time_until_trigger"),
    "rclcpp::Client": {
        **_does(Effect.NONE, "service_is_ready"),
        **_does(Effect.WAITS, "wait_for_service", "wait_for_action_server"),
    },
    "rclcpp::Clock": {"now": Routine(Kind.CLOCK)},
    "rclcpp::Rate": {"sleep": Routine(Kind.SLEEP)},
    "rclcpp::Executor": {
        "add_node": Routine(Kind.START),
        "spin": Routine(Kind.SPIN),
        "spin_some": Routine(Kind.SERVE),
        **dict.fromkeys(("spin_all", "spin_once"), Routine(Kind.SERVE, ("timeout",))),
    },
    "rclcpp::Time": _does(Effect.NONE, "nanoseconds", "seconds"),
    "rclcpp::QoS": {
        # Those that change what is read of a quality of service, and those that leave it alone.
        **dict.fromkeys(("keep_last", "keep_all", "history", "durability"), Routine(Kind.CHANGE)),
        **dict.fromkeys(("transient_local", "durability_volatile"), Routine(Kind.CHANGE)),
        **dict.fromkeys(("reliable", "best_effort", "reliability"), Routine(Kind.CHANGE)),
        **dict.fromkeys(("deadline", "liveliness"), Routine(Kind.CHANGE)),
        **dict.fromkeys(("liveliness_lease_duration",), Routine(Kind.CHANGE)),
        **dict.fromkeys(("reliability_best_available",), Routine(Kind.CHANGE)),
        **dict.fromkeys(("durability_best_available",), Routine(Kind.CHANGE)),
        **_does(Effect.NONE, "lifespan", kind=Kind.QUALITY),
        **_does(Effect.NONE, "avoid_ros_namespace_conventions", kind=Kind.QUALITY),
        **_does(Effect.NONE, "get_rmw_qos_profile", kind=Kind.QUALITY),
    },
    "rclcpp::Parameter": {
        **dict.fromkeys(("as_bool", "as_int", "as_double", "as_string"), Routine(Kind.VALUE)),
        **dict.fromkeys(("as_bool_array", "as_integer_array"), Routine(Kind.VALUE)),
        **dict.fromkeys(("as_double_array", "as_string_array"), Routine(Kind.VALUE)),
        **dict.fromkeys(("get_value", "get_parameter_value"), Routine(Kind.VALUE)),
    },
}
_QUALITIES: dict[str, int | None] = {
    **{"QoS": None, "QoSInitialization": None, "KeepLast": None, "KeepAll": 0},
    **{"SensorDataQoS": 5, "ServicesQoS": 10, "ParametersQoS": 1000, "ParameterEventsQoS": 1000},
    **{"RosoutQoS": 1000, "ClockQoS": 1, "SystemDefaultsQoS": 0, "BestAvailableQoS": 10},
}
_PROFILES = {
    "rmw_qos_profile_default": 10,
    "rmw_qos_profile_sensor_data": 5,
    "rmw_qos_profile_services_default": 10,
    "rmw_qos_profile_parameters": 1000,
    "rmw_qos_profile_parameter_events": 1000,
    "rmw_qos_profile_system_default": 0,
    "rmw_qos_profile_best_available": 10,
}
# Reliability and durability of those that are not reliable and volatile.
_POLICIES = {
    "SensorDataQoS": ("best_effort", "volatile"),
    "ClockQoS": ("best_effort", "volatile"),
    "RosoutQoS": ("reliable", "transient_local"),
    "SystemDefaultsQoS": ("system_default", "system_default"),
    "BestAvailableQoS": ("best_available", "best_available"),
    "rmw_qos_profile_sensor_data": ("best_effort", "volatile"),
    "rmw_qos_profile_system_default": ("system_default", "system_default"),
    "rmw_qos_profile_best_available": ("best_available", "best_available"),
}

LIBRARIES = (
    Library(
        "rclcpp",
        Language.CPP,
        _FUNCTIONS,
        _METHODS,
        unmodelled={
            "rclcpp_action::create_server": _asks(Kind.ACTION_SERVER, "", "name"),
            "rclcpp_action::create_client": _asks(Kind.ACTION_CLIENT, "", "name"),
            "tf2_ros::TransformBroadcaster": Routine(Kind.BROADCASTER),
            "tf2_ros::StaticTransformBroadcaster": Routine(Kind.STATIC_BROADCASTER),
            "tf2_ros::TransformListener": Routine(Kind.LISTENER),
        },
        nodes=frozenset({"rclcpp::Node", "rclcpp_lifecycle::LifecycleNode"}),
        managed=frozenset({"rclcpp_lifecycle::LifecycleNode"}),
        first=frozenset({"on_configure"}),
        own_arguments={
            **dict.fromkeys(("arguments", "parameter_overrides"), ""),
            **{"append_parameter_override": "", "use_global_arguments": "true"},
        },
        plain=frozenset({"ParameterValue"}),
        marks=("rclcpp",),
        starts=("rclcpp",),
        logs=(
            *("RCLCPP_DEBUG", "RCLCPP_INFO", "RCLCPP_WARN", "RCLCPP_ERROR", "RCLCPP_FATAL"),
            *("RCLCPP_LOG", "RCUTILS_LOG"),
        ),
        registers="RCLCPP_COMPONENTS_REGISTER_NODE",
        commands=("rclcpp_components_register_node", "rclcpp_components_register_nodes"),
        threaded=frozenset({"MultiThreadedExecutor", "EventsExecutor"}),
        table=Table(
            _QUALITIES,
            _PROFILES,
            _POLICIES,
            spans={"rclcpp::Duration": 1e-9, "from_seconds": 1.0, "from_nanoseconds": 1e-9},
        ),
    ),
)
