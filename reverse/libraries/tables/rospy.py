"""rospy, and what is used with it: message_filters, actionlib, dynamic_reconfigure."""

from __future__ import annotations

from rebsync.reverse.libraries.routines import (
    Access,
    Effect,
    Kind,
    Language,
    Library,
    LogCall,
    Routine,
)

_KEYWORDS = (
    *(("data_class", "type"), ("service_class", "type"), ("topic_type", "type")),
    *(("queue_size", "depth"), ("latch", "latched"), ("handler", "callback")),
    *(("oneshot", "one_shot"), ("param_name", "name"), ("param_value", "value")),
    *(("topic", "name"), ("caller_id", ""), ("frequency", "hz")),
)
_SUBSCRIBED = ("name", "type", "callback", "callback_args", "depth")
_ADVERTISED = ("name", "type", "listener", "", "latched", "", "depth")


def _asks(kind: Kind, *arguments: str, access: Access | None = None) -> Routine:
    return Routine(kind, arguments, _KEYWORDS, access)


def _hook(*arguments: str, **keywords: str) -> Routine:
    return Routine(Kind.HOOK, arguments, tuple(keywords.items()))


_GET = _asks(Kind.PARAMETER, "name", "default", access=Access.GET)
_SLEEP = Routine(Kind.SLEEP, ("period",))
_STOPPED = Routine(Kind.RUNNING, result="!bool")
_SPAN = Routine(Kind.SPAN, ("secs", "nsecs"))
_LOG = Routine(Kind.LOG)
_LOG_KEYWORDS = frozenset({"exc_info", "extra", "logger_name", "logger_level"})
_LOG_CALLS = {
    f"rospy.log{level}{often}": LogCall(int("throttle" in often), keywords=_LOG_KEYWORDS)
    for level in ("debug", "info", "warn", "err", "fatal")
    for often in ("", "_once", "_throttle", "_throttle_identical")
}
_DONE = tuple((name, "callback") for name in ("done_cb", "active_cb", "feedback_cb"))
_FUNCTIONS = {
    "rospy.init_node": Routine(
        Kind.NODE, ("name", "arguments", "anonymous"), (("argv", "arguments"),)
    ),
    "rospy.Publisher": Routine(
        Kind.PUBLISHER, _ADVERTISED, (*_KEYWORDS, ("subscriber_listener", "listener"))
    ),
    "rospy.Subscriber": _asks(Kind.SUBSCRIPTION, *_SUBSCRIBED),
    "rospy.wait_for_message": _asks(Kind.SINGLE, "name", "type"),
    "rospy.Timer": _asks(Kind.TIMER, "period", "callback", "one_shot"),
    "rospy.Rate": _asks(Kind.RATE, "hz"),
    "rospy.Service": _asks(Kind.SERVICE, "name", "type", "callback"),
    "rospy.ServiceProxy": _asks(Kind.CLIENT, "name", "type"),
    "rospy.get_param": _GET,
    "rospy.get_param_cached": _GET,
    "rospy.set_param": _asks(Kind.PARAMETER, "name", "value", access=Access.SET),
    "rospy.has_param": _asks(Kind.PARAMETER, "name", access=Access.HAS),
    "rospy.delete_param": _asks(Kind.PARAMETER, "name", access=Access.DELETE),
    "rospy.search_param": _asks(Kind.PARAMETER, "name", access=Access.SEARCH),
    "rospy.get_name": Routine(Kind.NAME, result="~"),
    "rospy.get_namespace": Routine(Kind.NAME),
    "rospy.resolve_name": Routine(Kind.RESOLVE, ("name",)),
    "rospy.sleep": _SLEEP,
    "rospy.rostime.sleep": _SLEEP,
    "rospy.spin": Routine(Kind.SPIN),
    "rospy.on_shutdown": Routine(Kind.START, ("callback",), (("h", "callback"),)),
    "rospy.signal_shutdown": Routine(Kind.START, does=Effect.ENDS),
    "rospy.is_shutdown": _STOPPED,
    "rospy.core.is_shutdown": _STOPPED,
    "rospy.get_time": Routine(Kind.CLOCK, result="seconds"),
    "rospy.get_rostime": Routine(Kind.CLOCK),
    "rospy.Time.now": Routine(Kind.CLOCK),
    "rospy.Duration": _SPAN,
    "rospy.Duration.from_sec": _SPAN,
    "rospy.rostime.Duration": _SPAN,
    "genpy.Duration": _SPAN,
    **dict.fromkeys(_LOG_CALLS, _LOG),
    "rospy.numpy_msg.numpy_msg": Routine(arguments=("type",), result="type"),
    "message_filters.Subscriber": _asks(Kind.SUBSCRIPTION, "name", "type", "depth"),
    "actionlib.SimpleActionServer": _hook("", "", "callback", execute_cb="callback"),
    "actionlib.ActionServer": _hook(
        "", "", "callback", "callback", goal_cb="callback", cancel_cb="callback"
    ),
    "dynamic_reconfigure.server.Server": _hook("", "callback", callback="callback"),
}
_METHODS = {
    "rospy.Publisher": {"publish": Routine(Kind.PUBLISH, ("message",))},
    "rospy.Rate": {"sleep": _SLEEP},
    "actionlib.SimpleActionServer": {
        "register_goal_callback": _hook("callback", cb="callback"),
        "register_preempt_callback": _hook("callback", cb="callback"),
    },
    "actionlib.SimpleActionClient": {
        "send_goal": Routine(
            Kind.HOOK, ("", "callback", "callback", "callback"), _DONE, does=Effect.SENDS
        )
    },
}

LIBRARIES = (
    Library(
        "rospy",
        Language.PYTHON,
        _FUNCTIONS,
        _METHODS,
        marks=("rospy", "message_filters"),
        log_arguments=_LOG_CALLS,
        plain=frozenset({"rospy.AnyMsg", "rospy.msg.AnyMsg"}),
        flat=False,
        threads=True,
        brings=frozenset(
            {"genpy", "roslib", "rospkg", "rosgraph", "roscpp", "rosgraph_msgs", "std_msgs", "yaml"}
        ),
        unmodelled={
            **dict.fromkeys(
                ("actionlib.SimpleActionServer", "actionlib.ActionServer"),
                Routine(Kind.ACTION_SERVER, ("name", "type"), (("ActionSpec", "type"),)),
            ),
            **dict.fromkeys(
                ("actionlib.SimpleActionClient", "actionlib.ActionClient"),
                Routine(
                    Kind.ACTION_CLIENT, ("name", "type"), (("ns", "name"), ("ActionSpec", "type"))
                ),
            ),
            "tf.TransformBroadcaster": Routine(Kind.BROADCASTER),
            "tf.TransformListener": Routine(Kind.LISTENER),
            "dynamic_reconfigure.server.Server": Routine(Kind.CONFIGURED, ("type",)),
            "dynamic_reconfigure.client.Client": Routine(Kind.CONFIGURING, ("name",)),
        },
    ),
)
