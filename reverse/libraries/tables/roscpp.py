"""roscpp, and what is used with it: nodelets, image_transport, message_filters."""

from __future__ import annotations

from rebsync.reverse.libraries.routines import (
    Access,
    Effect,
    Kind,
    Language,
    Library,
    Options,
    Routine,
    Table,
)

_IMAGE = "sensor_msgs/Image"
_IMAGES = "image_transport"
_SUBSCRIBE = ("name", "depth", "callback")
_ADVERTISE = ("name", "depth", "latched", "", "", "latched")
_TIMER = ("period", "callback", "one_shot", "autostart")
_SENDS = {"publish": Routine(Kind.PUBLISH, ("message",), writes=())}


def _parameter(access: Access, *arguments: str, least: int = 9) -> Routine:
    return Routine(Kind.PARAMETER, arguments, access=access, least=least)


def _timer(options: str, wall: bool = False, least: int = 9) -> Routine:
    return Routine(Kind.TIMER, _TIMER, wall=wall, options=options, least=least, result="ros::Timer")


def _does(effect: Effect, *names: str, kind: Kind = Kind.OTHER) -> dict[str, Routine]:
    return dict.fromkeys(names, Routine(kind, does=effect))


_GET = _parameter(Access.GET, "name", "variable", least=2)
_PARAM = _parameter(Access.GET, "name", "variable", "default", least=3)
_SET = _parameter(Access.SET, "name", "value", least=2)
_HAS = _parameter(Access.HAS, "name", least=1)
_DELETE = _parameter(Access.DELETE, "name", least=1)
_SEARCH = _parameter(Access.SEARCH, "name", "found", least=2)

_HANDLE = {
    "advertise": Routine(
        Kind.PUBLISHER, _ADVERTISE, options="AdvertiseOptions", least=2, result="ros::Publisher"
    ),
    "subscribe": Routine(
        Kind.SUBSCRIPTION, _SUBSCRIBE, options="SubscribeOptions", least=3, result="ros::Subscriber"
    ),
    "advertiseService": Routine(
        Kind.SERVICE, ("name", "callback"), options="AdvertiseServiceOptions", least=2
    ),
    "serviceClient": Routine(
        Kind.CLIENT, ("name",), options="ServiceClientOptions", result="ros::ServiceClient"
    ),
    "createTimer": _timer("TimerOptions", least=2),
    "createWallTimer": _timer("WallTimerOptions", wall=True, least=2),
    "createSteadyTimer": _timer("SteadyTimerOptions", wall=True),
    "getParam": _GET,
    "getParamCached": _parameter(Access.GET, "name", "variable"),
    "param": _PARAM,
    "param_cached": _parameter(Access.GET, "name", "variable", "default"),
    "setParam": _SET,
    "hasParam": _HAS,
    "deleteParam": _DELETE,
    "searchParam": _SEARCH,
}
_FUNCTIONS = {
    "ros::init": Routine(Kind.NODE, ("arguments", "arguments", "name", "options")),
    "ros::topic::waitForMessage": Routine(Kind.SINGLE, ("name", "handle", "")),
    "ros::service::createClient": Routine(Kind.CLIENT, ("name",)),
    "ros::service::call": Routine(Kind.CLIENT, ("name", "call"), does=Effect.WAITS),
    # A method of nodelets that publish only while somebody listens.
    "advertise": Routine(Kind.PUBLISHER, ("handle", *_ADVERTISE[:3])),
    "ros::param::get": _GET,
    "ros::param::getCached": _GET,
    "ros::param::param": _PARAM,
    "ros::param::set": _SET,
    "ros::param::has": _HAS,
    "ros::param::del": _DELETE,
    "ros::param::search": _SEARCH,
    "ros::spin": Routine(Kind.SPIN),
    "ros::spinOnce": Routine(Kind.SERVE),
    "ros::waitForShutdown": Routine(Kind.SPIN, does=Effect.WAITS),
    "ros::shutdown": Routine(Kind.SHUTDOWN),
    "ros::requestShutdown": Routine(does=Effect.ENDS),
    "ros::ok": Routine(Kind.RUNNING, result="bool"),
    "ros::isStarted": Routine(Kind.RUNNING, result="bool"),
    "ros::isShuttingDown": Routine(Kind.RUNNING, result="!bool"),
    **{f"ros::{c}::now": Routine(Kind.CLOCK) for c in ("Time", "WallTime", "SteadyTime")},
    **dict.fromkeys(
        ("ros::Duration", "ros::WallDuration", "ros::SteadyDuration"), Routine(Kind.SPAN)
    ),
    **dict.fromkeys(("ros::Time", "ros::WallTime"), Routine(Kind.SPAN)),
    "ros::Rate": Routine(Kind.RATE, ("hz",)),
    "ros::WallRate": Routine(Kind.RATE, ("hz",), wall=True),
    "ros::this_node::getName": Routine(Kind.NAME, result="~"),
    "message_filters::Subscriber": Routine(Kind.SUBSCRIPTION, ("handle", "name", "depth")),
    "image_transport::SubscriberFilter": Routine(
        Kind.SUBSCRIPTION, ("handle", "name", "depth"), type=_IMAGE, transport=_IMAGES
    ),
    # Macros that make a nodelet of a class.
    "PLUGINLIB_EXPORT_CLASS": Routine(Kind.NODELET, ("class", "base")),
    "PLUGINLIB_DECLARE_CLASS": Routine(Kind.NODELET, ("", "", "class", "base")),
    "PLUGINLIB_REGISTER_CLASS": Routine(Kind.NODELET, ("", "class", "base")),
    # Setters of messages and transforms, which change no argument, and functions of angles.
    **_does(Effect.CHANGES, "setRPY", "setOrigin", "setRotation", "setX", "setY", "setZ"),
    **_does(Effect.CHANGES, "setValue"),
    **_does(Effect.NONE, "normalize_angle", "from_degrees", "shortest_angular_distance"),
    **_does(Effect.NONE, "to_degrees", "createQuaternionMsgFromYaw", "getYaw", "quatToRPY"),
    **_does(Effect.NONE, "createQuaternionFromYaw", "createQuaternionFromRPY"),
    **_does(Effect.NONE, "narrow_cast", "numeric_cast", "fromSec", "toSec"),
    **dict.fromkeys(("ROS_ASSERT", "ROS_ASSERT_MSG"), Routine(Kind.CHECK, ("condition",))),
    "ROS_BREAK": Routine(Kind.CHECK),
    "ROS_STATIC_ASSERT": Routine(),
}
_IMAGE_PUBLISHER = Routine(Kind.PUBLISHER, _ADVERTISE[:3], type=_IMAGE, transport=_IMAGES)
_IMAGE_SUBSCRIPTION = Routine(Kind.SUBSCRIPTION, _SUBSCRIBE, type=_IMAGE, transport=_IMAGES)
_TO_NODELET = Routine(Kind.HANDLE, result="")
_TO_PRIVATE = Routine(Kind.HANDLE, result="~")
_METHODS = {
    "ros::NodeHandle": _HANDLE,
    "image_transport::ImageTransport": {
        **dict.fromkeys(("advertise", "advertiseCamera"), _IMAGE_PUBLISHER),
        **dict.fromkeys(("subscribe", "subscribeCamera"), _IMAGE_SUBSCRIPTION),
    },
    # Functions of a nodelet that give a node handle, by its namespace, or its name.
    "nodelet::Nodelet": {
        "getNodeHandle": _TO_NODELET,
        "getMTNodeHandle": _TO_NODELET,
        "getPrivateNodeHandle": _TO_PRIVATE,
        "getMTPrivateNodeHandle": _TO_PRIVATE,
        "getName": Routine(Kind.NAME, result="~"),
    },
    "ros::Publisher": {
        **_SENDS,
        **_does(Effect.NONE, "getTopic", "isLatched"),
        **_does(Effect.NONE, "getNumSubscribers", kind=Kind.AUDIENCE),
    },
    "ros::Subscriber": _does(Effect.NONE, "getNumPublishers", kind=Kind.AUDIENCE),
    "ros::Timer": _does(Effect.NONE, "hasPending", "hasStarted", "isValid"),
    "ros::Duration": _does(Effect.NONE, "isZero", "toNSec", "toSec"),
    "ros::Rate": {"sleep": Routine(Kind.SLEEP)},
    "ros::ServiceClient": {
        **_does(Effect.WAITS, "waitForExistence", "call"),
        **_does(Effect.WAITS, "waitForService", kind=Kind.AUDIENCE),
    },
    "ros::CallbackQueue": {
        **dict.fromkeys(("callAvailable", "callOne"), Routine(Kind.SERVE, ("timeout",))),
    },
    "ros::AsyncSpinner": {"start": Routine(Kind.START)},
    "actionlib::SimpleActionClient": _does(
        Effect.WAITS, "waitForServer", "waitForResult", "sendGoalAndWait"
    ),
    "tf::TransformListener": _does(Effect.WAITS, "waitForTransform"),
    "": {
        **_does(Effect.TIME, "sleepUntil"),
        **_does(Effect.WAITS, "waitForValid"),
    },
}

_OF_TIMERS = Options(
    (),
    ("period", "callback", "", "one_shot", "autostart"),
    {"period": "period", "callback": "callback", "oneshot": "one_shot", "autostart": "autostart"},
)
_OPTIONS = {
    "SubscribeOptions": Options(
        _SUBSCRIBE,
        ("name", "depth"),
        {"topic": "name", "queue_size": "depth", "datatype": "type"},
    ),
    "AdvertiseOptions": Options(
        ("name", "depth"),
        ("name", "depth", "", "type"),
        {"topic": "name", "queue_size": "depth", "latch": "latched", "datatype": "type"},
    ),
    "AdvertiseServiceOptions": Options(
        ("name", "callback"), (), {"service": "name", "datatype": "type"}
    ),
    "ServiceClientOptions": Options((), ("name", "", "", ""), {"service": "name"}),
    **dict.fromkeys(("TimerOptions", "WallTimerOptions", "SteadyTimerOptions"), _OF_TIMERS),
}

LIBRARIES = (
    Library(
        "roscpp",
        Language.CPP,
        _FUNCTIONS,
        _METHODS,
        unmodelled={
            "actionlib::SimpleActionServer": Routine(Kind.ACTION_SERVER, ("handle", "name")),
            "actionlib::ActionServer": Routine(Kind.ACTION_SERVER, ("handle", "name")),
            "actionlib::SimpleActionClient": Routine(Kind.ACTION_CLIENT, ("handle", "name")),
            "actionlib::ActionClient": Routine(Kind.ACTION_CLIENT, ("handle", "name")),
            "tf::TransformBroadcaster": Routine(Kind.BROADCASTER),
            "tf::TransformListener": Routine(Kind.LISTENER),
            "dynamic_reconfigure::Server": Routine(Kind.CONFIGURED),
            "dynamic_reconfigure::Client": Routine(Kind.CONFIGURING),
        },
        handles=frozenset({"ros::NodeHandle"}),
        copying=("ros", "tf", "tf2", "tf2_ros", "diagnostic_updater"),
        marks=(
            *("ros::", "ros/", "NodeHandle", "nodelet", "NODELET", "PLUGINLIB", "ROS_"),
            *("image_transport", "message_filters", "dynamic_reconfigure", "actionlib"),
            *("_msgs", "_srvs"),
        ),
        starts=(
            *("NodeHandle", "odelet", "NODELET", "ros::init", "ros::spin", "advertise"),
            *("subscribe", "Rate", "param::", ".param", ">param", "getParam", "setParam"),
            *("hasParam", "deleteParam", "searchParam", "topic::", "service::", "actionlib"),
            *("dynamic_reconfigure", "message_filters", "image_transport", "Timer"),
            *("Publisher", "Subscriber", "ServiceServer", "ServiceClient"),
        ),
        logs=(
            *("ROS_DEBUG", "ROS_INFO", "ROS_WARN", "ROS_ERROR", "ROS_FATAL", "ROS_LOG"),
            *("NODELET_", "ROSCONSOLE_"),
        ),
        options=_OPTIONS,
        table=Table(spans=dict.fromkeys(("Duration", "WallDuration", "SteadyDuration"), 1.0)),
        first=frozenset({"onInit"}),
        entries=frozenset({"onInit", "run"}),  # that programs outside of the files call
        threaded=frozenset(
            {
                *("AsyncSpinner", "MultiThreadedSpinner", "NodeletMultiThreaded"),
                *("CallbackQueue", "setCallbackQueue", "getMTNodeHandle", "getMTPrivateNodeHandle"),
            }
        ),
        versions={"ROS_VERSION_MINIMUM": (1, 16, 0)},  # noetic, the last one
        included="ros",
        flat=False,
    ),
)
