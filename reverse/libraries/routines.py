"""A callable of a library as a value, in one format for C++ and Python, and a library of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from enum import Enum

from rebsync.records import dataclass

RECEIVER = "self"  # the role of the object that a method is called on
ANY_CONTAINER = "std::vector"  # the class that stands for all containers of C++


class Access(Enum):
    """What is done with a parameter; SEARCH is a look-up upwards, DECLARE that of ROS 2."""

    GET = "get"
    SET = "set"
    HAS = "has"
    DELETE = "delete"
    SEARCH = "search"
    DECLARE = "declare"


class Language(Enum):
    """What a library is called from."""

    CPP = "C++"
    PYTHON = "Python"


class Kind(Enum):
    """What a callable is for: first those that ask ROS for something, which is a fact."""

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

    PUBLISH = "publish"
    SPIN = "let all messages be served until the node ends"
    SERVE = "let those messages be served that wait"
    START = "start or end the client library"
    SHUTDOWN = "end the node"
    AUDIENCE = "tell, or wait for, who is at the other end"
    RUNNING = "tell whether the node runs"
    SLEEP = "sleep"
    CLOCK = "tell the time"
    SPAN = "make a span of time"
    LOG = "log"
    HOOK = "register a function that is called later"
    HANDLE = "give a node handle"
    NAME = "give the name of the node or a namespace"
    RESOLVE = "give a name as it is resolved"
    CHECK = "check a condition"
    EXIT = "end the program"
    POLL = "wait for what comes from outside"
    TOLD = "give what the model has a name for"
    QUALITY = "make a quality of service"
    CHANGE = "change a quality of service, and give it"
    VALUE = "give what a parameter holds"

    ACTION_SERVER = "action server"
    ACTION_CLIENT = "action client"
    BROADCASTER = "broadcaster"
    STATIC_BROADCASTER = "static broadcaster"
    LISTENER = "listener"
    CONFIGURED = "configured"
    CONFIGURING = "configuring"

    OTHER = "other"


ASKING = frozenset(
    {
        *(Kind.NODE, Kind.NODELET, Kind.PUBLISHER, Kind.SUBSCRIPTION, Kind.SINGLE, Kind.TIMER),
        *(Kind.RATE, Kind.PARAMETER, Kind.DECLARED, Kind.READ, Kind.SET),
        *(Kind.SERVICE, Kind.CLIENT),
    }
)


class Effect(Enum):
    """What a call does besides giving its result; a value is what a finding says of it."""

    NONE = "nothing"
    CLOCK = "reads the clock"
    RANDOM = "draws a number"
    LOGS = "logs"
    READS = "reads a parameter"
    SETS = "sets a parameter"
    OPENS = "makes what the node sends through"
    CHANGES = "changes its object or an argument"
    SENDS = "sends"
    ASKS = "asks for callbacks"
    TIME = "takes time"
    WAITS = "waits"
    RUNS = "runs other callbacks"
    ENDS = "ends the node"
    LEAVES = "leaves the function"
    CHECKS = "checks"
    UNKNOWN = "may do anything"


BLOCKING = frozenset({Effect.TIME, Effect.WAITS, Effect.RUNS})
# What acts on a node, so that a call cannot be left out of its model.
ACTING = BLOCKING | {Effect.ASKS, Effect.ENDS, Effect.LEAVES, Effect.CHECKS}
_PURE = frozenset({Effect.NONE, Effect.CLOCK, Effect.RANDOM, Effect.READS})
_EFFECTS = {
    **dict.fromkeys((Kind.SUBSCRIPTION, Kind.TIMER, Kind.SERVICE, Kind.HOOK), Effect.ASKS),
    **dict.fromkeys((Kind.PUBLISHER, Kind.CLIENT, Kind.NODE, Kind.NODELET), Effect.OPENS),
    **{Kind.SINGLE: Effect.WAITS, Kind.PUBLISH: Effect.SENDS, Kind.SLEEP: Effect.TIME},
    **dict.fromkeys((Kind.SPIN, Kind.SERVE), Effect.RUNS),
    **{Kind.SHUTDOWN: Effect.ENDS, Kind.CLOCK: Effect.CLOCK, Kind.LOG: Effect.LOGS},
    **dict.fromkeys((Kind.READ, Kind.VALUE), Effect.READS),
    **{Kind.DECLARED: Effect.SETS, Kind.SET: Effect.SETS, Kind.CHECK: Effect.CHECKS},
    **{Kind.CHANGE: Effect.CHANGES, Kind.START: Effect.OPENS, Kind.POLL: Effect.WAITS},
    Kind.EXIT: Effect.ENDS,
}
_READING = frozenset({Access.GET, Access.HAS, Access.SEARCH})
# Roles of arguments that a call of a kind writes.
_WRITTEN = frozenset({"variable", "found"})


@dataclass(frozen=True, slots=True)
class Routine:
    """A function, method, macro or constructor: what it is for, and what each argument is.

    `arguments` are the roles of the arguments in their order, `keywords` those of arguments that
    are given by a name (a role stands for itself too). The arguments of the role `callback` are
    called later. `type` is the type of messages where the call has no other, `result` the class of
    what it gives, or the unit of the time that it takes or tells, or `type` for a class of messages
    of the type that it is handed; `wall` says that it goes by the
    clock on the wall. `options` is the class that may stand for all of the arguments.

    Names of `flat` routines are not under the namespace of a handle, and their arguments stand in
    one order. `least` is how many arguments a method has at least that is taken for this one
    without knowing its object. `does` and `writes` say of the effect, and of the roles whose
    arguments are written, what does not follow from the kind.
    """

    kind: Kind = Kind.OTHER
    arguments: tuple[str, ...] = ()
    keywords: tuple[tuple[str, str], ...] = ()
    access: Access | None = None
    type: str | None = None
    transport: str | None = None
    wall: bool = False
    options: str | None = None
    flat: bool = False
    least: int = 9
    result: str = ""
    does: Effect | None = None
    writes: tuple[str, ...] = ()

    def role_of(self, keyword: str) -> str:
        """The role of an argument that is given by name."""
        return dict(self.keywords).get(keyword, keyword)

    @property
    def effect(self) -> Effect:
        """What a call does."""
        if self.does is not None:
            return self.does
        if self.kind is Kind.PARAMETER:
            return Effect.READS if self.access in _READING else Effect.SETS
        return _EFFECTS.get(self.kind, Effect.NONE)

    @property
    def is_pure(self) -> bool:
        """Whether a call only gives its result, which may depend on clock, chance or parameters."""
        return self.effect in _PURE and not self.written

    @property
    def written(self) -> frozenset[int]:
        """The places of the arguments that a call writes; -1 stands for its object."""
        roles = (*self.writes, *(_WRITTEN if self.kind is Kind.PARAMETER else ()))
        found = {i for i, role in enumerate(self.arguments) if role in roles}
        return frozenset(found | ({-1} if RECEIVER in roles or self.kind is Kind.CHANGE else set()))

    @property
    def callbacks(self) -> tuple[int, ...]:
        """The places of the arguments that are called later."""
        return tuple(i for i, role in enumerate(self.arguments) if role == "callback")


@dataclass(frozen=True, slots=True)
class Options:
    """A class that holds the arguments of a call, by their roles.

    Those of `init` and `create`, of the constructor, and of the fields.
    """

    made: tuple[str, ...]
    constructed: tuple[str, ...]
    fields: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Table:
    """Numbers that a library has names for.

    `qualities` are classes of qualities of service with the depth they have by themselves (None:
    the first argument says it), `profiles` names of such qualities, by the last name or the last
    two; `policies` are their reliability and durability where these are not the usual ones. `spans`
    are functions and classes that make a span of time of a number, with the seconds of its unit.
    """

    qualities: Mapping[str, int | None] = field(default_factory=dict)
    profiles: Mapping[str, int] = field(default_factory=dict)
    policies: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    spans: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class LogCall:
    """What a call that logs takes: so many arguments `before` the message, and then the message.

    The message is a text if it is `only_text`. Where it `formats`, the arguments behind it are what
    `%` puts into the message; elsewhere it takes none. `keywords` are arguments by name. One that
    says what is logged gets one of `levels` for a message: numbers, and constants by full names.
    """

    before: int = 0
    only_text: bool = False
    formats: bool = True
    keywords: frozenset[str] = frozenset()
    levels: frozenset[int | str] = frozenset()


@dataclass(frozen=True, eq=False, slots=True)
class Library:
    """A library as it is called from one language.

    `functions` are by their full names: functions, macros, and classes whose construction does
    something; `methods` by the full name of the class of their object, which is empty where any
    object is meant.

    `nodes` are the classes whose objects are nodes, those of `managed` nodes whose state others
    change, and `managed_senders` methods that make publishers which send only while that is active;
    `handles` those of handles under whose namespace names are looked up; `plain` other
    classes that hold a value they are made of. `copying` are outermost namespaces, of the library
    and of what comes with it, whose constructors only copy. `entries` are methods that programs
    call which are not in the files, `first` those that run before an object serves anything.

    One of `marks` is in every file that uses the library, and one of `starts` in some file of every
    package that has a node with it. `logs` are the beginnings of names of macros that log, or the
    names of methods that give what logs; `log_arguments` are in Python what logs with the arguments
    that it takes, by full names, methods as `get_logger().info`. `registers` is the macro that
    makes a component of a class, `commands` those of CMake that do.

    Of a `flat` library names are not under a handle, and parameters are the node's own. With
    `threads`, callbacks run beside each other; with `strict`, a field of a message takes no number
    of another kind. `threaded` are the last names of what makes callbacks run beside each other
    in other libraries. `versions` are macros that compare the library's version with their
    arguments; `included` is the folder that its headers are in where that has another name, and
    `brings` are modules that are installed with it. What
    is `generated` is called by code that rebsync makes, and its names mean
    something there only. `unmodelled` make what has no place in a model, by their full names: ends
    of actions, what sends and gets transforms, what lets others change parameters. They are no
    functions, as what they do may be anything. `own_arguments` are methods and keywords
    with which code gives its node arguments or parameters of its own, each with the value that says
    nothing.
    """

    name: str
    language: Language
    functions: Mapping[str, Routine] = field(default_factory=dict)
    methods: Mapping[str, Mapping[str, Routine]] = field(default_factory=dict)
    nodes: frozenset[str] = frozenset()
    managed: frozenset[str] = frozenset()
    managed_senders: frozenset[str] = frozenset()
    handles: frozenset[str] = frozenset()
    plain: frozenset[str] = frozenset()
    copying: tuple[str, ...] = ()
    marks: tuple[str, ...] = ()
    starts: tuple[str, ...] = ()
    logs: tuple[str, ...] = ()
    log_arguments: Mapping[str, LogCall] = field(default_factory=dict)
    registers: str = ""
    commands: tuple[str, ...] = ()
    options: Mapping[str, Options] = field(default_factory=dict)
    table: Table = field(default_factory=Table)
    entries: frozenset[str] = frozenset()
    first: frozenset[str] = frozenset()
    flat: bool = True
    threads: bool = False
    threaded: frozenset[str] = frozenset()
    versions: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    included: str = ""
    strict: bool = False
    generated: bool = False
    brings: frozenset[str] = frozenset()
    unmodelled: Mapping[str, Routine] = field(default_factory=dict)
    own_arguments: Mapping[str, str] = field(default_factory=dict)
