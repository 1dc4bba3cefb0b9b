"""What roscpp code says to ask ROS for something: one table, from which the readers work.

Each entry names a call, the kind of thing it asks for, and what its arguments are, in their order.
"""

from __future__ import annotations

from enum import Enum

from rebsync.records import dataclass
from rebsync.reverse.graph import Access
from rebsync.reverse.syntax.cpp_words import places_of


class Kind(Enum):
    """What a call asks for."""

    NODE = "node"
    NODELET = "nodelet"
    PUBLISHER = "publisher"
    SUBSCRIPTION = "subscription"
    SINGLE = "single"
    TIMER = "timer"
    RATE = "rate"
    PARAMETER = "parameter"
    DECLARED = "declared together"
    READ = "read together"
    SET = "set together"
    SERVICE = "service"
    CLIENT = "client"


@dataclass(frozen=True, slots=True)
class Ask:
    """A call that asks for something; `arguments` are the roles of its arguments.

    `type` is the message type where the call has no other; `wall` says that it goes by the clock
    on the wall. `options` is the class that may stand for all of the arguments. Names of `flat`
    calls, those of ROS 2, are not under the namespace of a handle, and their arguments stand in
    one order; `least` is how many a method has at least that is taken for this one without knowing
    its object.
    """

    kind: Kind
    arguments: tuple[str, ...]
    access: Access | None = None
    type: str | None = None
    transport: str | None = None
    wall: bool = False
    options: str | None = None
    flat: bool = False
    least: int = 9


HANDLE_TYPE = "NodeHandle"
_IMAGE = "sensor_msgs/Image"
_IMAGES = "image_transport"
_SUBSCRIBE = ("name", "depth", "callback")
_ADVERTISE = ("name", "depth", "latched", "", "", "latched")
_TIMER = ("period", "callback", "one_shot", "autostart")


def _parameter(access: Access, *arguments: str) -> Ask:
    return Ask(Kind.PARAMETER, arguments, access)


_PARAMETERS = {
    "get": _parameter(Access.GET, "name", "variable"),
    "getCached": _parameter(Access.GET, "name", "variable"),
    "param": _parameter(Access.GET, "name", "variable", "default"),
    "set": _parameter(Access.SET, "name", "value"),
    "has": _parameter(Access.HAS, "name"),
    "del": _parameter(Access.DELETE, "name"),
    "search": _parameter(Access.SEARCH, "name", "found"),
}

# Methods of a node handle.
HANDLE: dict[str, Ask] = {
    "advertise": Ask(Kind.PUBLISHER, _ADVERTISE, options="AdvertiseOptions"),
    "subscribe": Ask(Kind.SUBSCRIPTION, _SUBSCRIBE, options="SubscribeOptions"),
    "advertiseService": Ask(Kind.SERVICE, ("name", "callback"), options="AdvertiseServiceOptions"),
    "serviceClient": Ask(Kind.CLIENT, ("name",), options="ServiceClientOptions"),
    "createTimer": Ask(Kind.TIMER, _TIMER, options="TimerOptions"),
    "createWallTimer": Ask(Kind.TIMER, _TIMER, wall=True, options="WallTimerOptions"),
    "createSteadyTimer": Ask(Kind.TIMER, _TIMER, wall=True, options="SteadyTimerOptions"),
    "getParam": _PARAMETERS["get"],
    "getParamCached": _PARAMETERS["get"],
    "param": _PARAMETERS["param"],
    "param_cached": _PARAMETERS["param"],
    "setParam": _PARAMETERS["set"],
    "hasParam": _PARAMETERS["has"],
    "deleteParam": _PARAMETERS["del"],
    "searchParam": _PARAMETERS["search"],
}

# Methods of what is made of a node handle, by class.
TRANSPORTS: dict[str, dict[str, Ask]] = {
    "ImageTransport": {
        "advertise": Ask(Kind.PUBLISHER, _ADVERTISE[:3], type=_IMAGE, transport=_IMAGES),
        "advertiseCamera": Ask(Kind.PUBLISHER, _ADVERTISE[:3], type=_IMAGE, transport=_IMAGES),
        "subscribe": Ask(Kind.SUBSCRIPTION, _SUBSCRIBE, type=_IMAGE, transport=_IMAGES),
        "subscribeCamera": Ask(Kind.SUBSCRIPTION, _SUBSCRIBE, type=_IMAGE, transport=_IMAGES),
    }
}

# Functions, by what is written before their name and the name: `ros::param::get`.
FUNCTIONS: dict[tuple[str, str], Ask] = {
    ("ros", "init"): Ask(Kind.NODE, ("", "", "name", "options")),
    ("topic", "waitForMessage"): Ask(Kind.SINGLE, ("name", "handle", "")),
    ("service", "createClient"): Ask(Kind.CLIENT, ("name",)),
    ("service", "call"): Ask(Kind.CLIENT, ("name", "call")),
    # A method of nodelets that publish only while somebody listens.
    ("", "advertise"): Ask(Kind.PUBLISHER, ("handle", *_ADVERTISE[:3])),
    **{("param", name): ask for name, ask in _PARAMETERS.items()},
}

# Classes whose objects subscribe when they are made, or when `subscribe` is called.
FILTERS: dict[str, Ask] = {
    "Subscriber": Ask(Kind.SUBSCRIPTION, ("handle", "name", "depth")),
    "SubscriberFilter": Ask(
        Kind.SUBSCRIPTION, ("handle", "name", "depth"), type=_IMAGE, transport=_IMAGES
    ),
}
# Classes of the client library, whose own code asks for nothing.
LIBRARY = frozenset({HANDLE_TYPE, *TRANSPORTS, *FILTERS})
FILTER_SCOPES = {"Subscriber": "message_filters", "SubscriberFilter": "image_transport"}

# What loops wait with.
RATES: dict[str, Ask] = {
    "Rate": Ask(Kind.RATE, ("hz",)),
    "WallRate": Ask(Kind.RATE, ("hz",), wall=True),
}
SPANS = frozenset({"Duration", "WallDuration", "SteadyDuration"})

# Macros that make a nodelet of a class.
NODELETS: dict[str, Ask] = {
    "PLUGINLIB_EXPORT_CLASS": Ask(Kind.NODELET, ("class", "base")),
    "PLUGINLIB_DECLARE_CLASS": Ask(Kind.NODELET, ("", "", "class", "base")),
    "PLUGINLIB_REGISTER_CLASS": Ask(Kind.NODELET, ("", "class", "base")),
}

# Classes that hold the arguments of a call: the roles of those of `init` and `create`, of the
# constructor, and of the fields.
OPTIONS: dict[str, tuple[tuple[str, ...], tuple[str, ...], dict[str, str]]] = {
    "SubscribeOptions": (
        _SUBSCRIBE,
        ("name", "depth"),
        {"topic": "name", "queue_size": "depth", "datatype": "type"},
    ),
    "AdvertiseOptions": (
        ("name", "depth"),
        ("name", "depth", "", "type"),
        {"topic": "name", "queue_size": "depth", "latch": "latched", "datatype": "type"},
    ),
    "AdvertiseServiceOptions": (
        ("name", "callback"),
        (),
        {"service": "name", "datatype": "type"},
    ),
    "ServiceClientOptions": ((), ("name", "", "", ""), {"service": "name"}),
    **{
        name: (
            (),
            ("period", "callback", "", "one_shot", "autostart"),
            {
                "period": "period",
                "callback": "callback",
                "oneshot": "one_shot",
                "autostart": "autostart",
            },
        )
        for name in ("TimerOptions", "WallTimerOptions", "SteadyTimerOptions")
    },
}

# Functions of a nodelet that give a node handle, and its namespace.
OWN_HANDLES = {
    "getNodeHandle": "",
    "getMTNodeHandle": "",
    "getPrivateNodeHandle": "~",
    "getMTPrivateNodeHandle": "~",
}
# Functions of a nodelet that give its name, with which private names begin.
OWN_NAMES = frozenset({"getName"})

# How many arguments methods have at least that are taken for those of a node handle though no file
# declares what they are called on: members of classes of other packages.
LEAST = {
    "advertise": 2,
    "advertiseService": 2,
    "createTimer": 2,
    "createWallTimer": 2,
    "getParam": 2,
    "param": 3,
    "subscribe": 3,
}
ANONYMOUS = "AnonymousName"

# Functions of classes that programs outside of the files call.
ENTRIES = frozenset({"main", "onInit", "run"})

# Words without which a file asks for nothing: names of methods, classes and macros, and, only after
# a scope, those of functions.
_NAMES = frozenset(
    {
        *HANDLE,
        *(name for methods in TRANSPORTS.values() for name in methods),
        *(name for scope, name in FUNCTIONS if not scope),
        *FILTERS,
        *RATES,
        *NODELETS,
    }
)
_PLAIN = frozenset(name.encode() for name in _NAMES)
_FUNCTIONS = frozenset(name.encode() for _, name in FUNCTIONS) - _PLAIN
_WHITE = frozenset(b" \t\n\r\f\v")


def words_in(data: bytes, words: frozenset[bytes]) -> list[tuple[int, int, str]]:
    """The places of words of the vocabulary in a text whose words are known, from the first.

    Start, end, and the word.
    """
    found = [(at, word) for word in _PLAIN & words for at in places_of(data, word)]
    for word in _FUNCTIONS & words:
        found += ((at, word) for at in places_of(data, word) if _is_scoped(data, at))
    return [(at, at + len(word), word.decode()) for at, word in sorted(found)]


def _is_scoped(data: bytes, at: int) -> bool:
    """Whether a scope stands before a place: `::`, and maybe white space."""
    while at > 0 and data[at - 1] in _WHITE:
        at -= 1
    return data.endswith(b"::", 0, at)
