"""A ROS package as a value that knows no dialect: ROS 1 or 2, C++ or Python render or read it.

Bodies of callbacks are Rebeca statements. Topics are given as one node sees them: `~` stands for
the node's own name. What belongs to one class is in its `NodeClass`; what `main` instantiates is
in `instances`.
"""

from __future__ import annotations

from typing import TypeAlias

from rebsync.model import Annotation, Block, Parameter, Type
from rebsync.names import free_name
from rebsync.records import dataclass

Value: TypeAlias = "int | float | bool | str | tuple[Value, ...]"


@dataclass(frozen=True, slots=True)
class Field:
    """A field of a message: its name in ROS, its type, and the name that it has in the model."""

    name: str
    type: Type
    source: str


@dataclass(frozen=True, slots=True)
class MessageType:
    """The type of a topic: made from the class that declares a server first, and the server."""

    name: str
    fields: tuple[Field, ...]
    carries_sender: bool
    path: str


@dataclass(frozen=True, slots=True)
class StateType:
    """What a node publishes about itself after each body: one field a state variable."""

    name: str
    fields: tuple[Field, ...]


@dataclass(frozen=True, slots=True)
class Draw:
    """One `?(...)` of a sensor server: the type drawn, its alternatives, and its field."""

    field: str
    type: Type
    alternatives: tuple[Value, ...]


@dataclass(frozen=True, slots=True)
class Sensor:
    """The real sensor of a `@Sensor` server, or the stand-in that plays it.

    `topic` is where the data comes from (None: the stand-in's own topic), `type` the message type,
    `seen` the user's expression on `msg` for the first draw, `period` the rate in model time.
    """

    server: str
    name: str
    type: str
    topic: str | None
    draws: tuple[Draw, ...]
    period: float
    seen: str | None = None

    @property
    def stands_in(self) -> bool:
        return self.topic is None


@dataclass(frozen=True, slots=True)
class Offer:
    """A server offered to clients: a request is a message, the first reply to it the response.

    `type` is that of the service or action, `server` the one that the reply is sent to; of an
    action also the one that the feedback is sent to, where it has any.
    """

    type: str
    is_action: bool
    request: MessageType
    server: str
    reply: MessageType
    feedback_server: str | None = None
    feedback: MessageType | None = None

    @property
    def messages(self) -> tuple[MessageType, ...]:
        """The messages that it turns into what a client sends and gets."""
        found = (self.request, self.reply, self.feedback)
        return tuple(m for m in found if m is not None)


@dataclass(frozen=True, slots=True)
class Subscription:
    """The topic of a message server and the callback that serves it.

    `topic` is relative to the node's private name, or for a controller to
    `control_bridge/<node>/`. `body` is None for an abstract server; `inherited` says that an
    ancestor has made the subscription already and this is its new body.
    """

    server: str
    key: str
    topic: str
    on_bridge: bool
    message: MessageType
    parameters: tuple[Parameter, ...]
    body: Block | None
    path: str
    annotations: tuple[Annotation, ...] = ()
    priority: int | None = None
    inherited: bool = False
    overridden: bool = False
    offer: Offer | None = None


@dataclass(frozen=True, slots=True)
class Publisher:
    """Where a class sends one server's messages.

    To a known rebec (`known` is its name) or, `known` being None, to any rebec of the class
    `target`, chosen by name at run time. `topic` is private: the launch file remaps it.
    """

    key: str
    target: str
    known: str | None
    server: str
    topic: str
    message: MessageType
    parameters: tuple[Parameter, ...]


@dataclass(frozen=True, slots=True)
class SelfSend:
    """A server that the class sends to itself."""

    key: str
    server: str
    parameters: tuple[Parameter, ...]


@dataclass(frozen=True, slots=True)
class Member:
    """A state variable."""

    name: str
    type: Type
    path: str
    annotations: tuple[Annotation, ...] = ()


@dataclass(frozen=True, slots=True)
class KnownRebec:
    """A known rebec: whom the launch file's remappings lead to.

    `is_value`: its name is a member, set by the launch file, as bodies do more than send to it or
    its publishers do not tell its class.
    """

    name: str
    type: str
    path: str
    annotations: tuple[Annotation, ...] = ()
    is_value: bool = True


@dataclass(frozen=True, slots=True)
class GlobalParameter:
    """An `env` variable: an entry of the parameter server with the model's value as default."""

    name: str
    key: str
    type: Type
    value: Value


@dataclass(frozen=True, slots=True)
class ConstructorOf:
    """A constructor: its parameters are the node's; `runs` says that `main` uses it."""

    parameters: tuple[Parameter, ...]
    keys: tuple[str, ...]
    body: Block | None
    annotations: tuple[Annotation, ...] = ()
    runs: bool = False


@dataclass(frozen=True, slots=True)
class Function:
    """A local method."""

    name: str
    type: Type
    parameters: tuple[Parameter, ...]
    body: Block | None
    path: str
    overridden: bool = False
    overrides: bool = False
    annotations: tuple[Annotation, ...] = ()


@dataclass(frozen=True, slots=True)
class NodeClass:
    """A reactive class or interface as a class of ROS nodes; inherited parts stay with `bases`."""

    name: str
    file: str
    bases: tuple[str, ...]
    queue_length: int
    abstract: bool
    interface: bool
    robot: bool
    controller: bool
    moves: bool
    inherited_from: bool
    annotations: tuple[Annotation, ...]
    members: tuple[Member, ...]
    known: tuple[KnownRebec, ...]
    env: tuple[GlobalParameter, ...]
    constructors: tuple[ConstructorOf, ...]
    subscriptions: tuple[Subscription, ...]
    publishers: tuple[Publisher, ...]
    self_sends: tuple[SelfSend, ...]
    functions: tuple[Function, ...]
    sensors: tuple[Sensor, ...]
    state: StateType
    executable: bool
    tests_types: bool

    @property
    def values_known(self) -> tuple[KnownRebec, ...]:
        """The known rebecs whose names are members."""
        return tuple(k for k in self.known if k.is_value)

    def publishers_to(self, known: KnownRebec) -> tuple[Publisher, ...]:
        """Those to a known rebec of the class itself."""
        return tuple(p for p in self.publishers if p.known == known.name)

    @property
    def other_publishers(self) -> tuple[Publisher, ...]:
        """Those that do not stand for a known rebec that is no member."""
        standing = {k.name for k in self.known if not k.is_value}
        return tuple(p for p in self.publishers if p.known not in standing)

    def told_by(self, publisher: Publisher) -> tuple[KnownRebec, ...]:
        """The known rebec that is no member and that a publisher is the first one to."""
        return tuple(
            k for k in self.known if not k.is_value and self.publishers_to(k)[0] == publisher
        )


@dataclass(frozen=True, slots=True)
class NodeParameter:
    """A private parameter of one node."""

    key: str
    type: Type
    value: Value


@dataclass(frozen=True, slots=True)
class Remap:
    """A private name of a node and what it stands for, relative to the launch file's namespace."""

    private: str
    target: str


@dataclass(frozen=True, slots=True)
class Instance:
    """A rebec: one ROS node."""

    name: str
    rebec: str
    class_name: str
    parameters: tuple[NodeParameter, ...]
    remaps: tuple[Remap, ...]
    annotations: tuple[Annotation, ...] = ()


@dataclass(frozen=True, slots=True)
class StandIn:
    """A node that plays the unbound sensors of one rebec."""

    name: str
    class_name: str
    remaps: tuple[Remap, ...]


@dataclass(frozen=True, slots=True)
class Maintainer:
    name: str
    email: str


@dataclass(frozen=True, slots=True)
class Settings:
    """What the run-time part reads: times in seconds, lengths in metres, angles in radians."""

    time_unit: float = 1.0
    slack: float = 0.5
    seed: int = 0
    cell_size: float = 1.0
    drive: str = "holonomic"
    heading: float = 0.0
    odometry: str | None = None
    lifecycle: bool = False
    monitor: bool = False


@dataclass(frozen=True, slots=True)
class Package:
    """The whole package."""

    name: str
    version: str
    description: str
    license: str
    copyright: str | None
    maintainers: tuple[Maintainer, ...]
    settings: Settings
    messages: tuple[MessageType, ...]
    env: tuple[GlobalParameter, ...]
    classes: tuple[NodeClass, ...]
    instances: tuple[Instance, ...]
    stand_ins: tuple[StandIn, ...]
    instances_of: tuple[tuple[str, tuple[str, ...]], ...]

    @property
    def offers(self) -> tuple[Offer, ...]:
        """What the classes offer to clients, each once."""
        found = (s.offer for c in self.classes for s in c.subscriptions if not s.inherited)
        return tuple(dict.fromkeys(s for s in found if s is not None))

    @property
    def services(self) -> tuple[Offer, ...]:
        """What is offered as a service."""
        return tuple(o for o in self.offers if not o.is_action)

    @property
    def actions(self) -> tuple[Offer, ...]:
        """What is offered as an action."""
        return tuple(o for o in self.offers if o.is_action)

    @property
    def executables(self) -> tuple[str, ...]:
        """The programs: of the classes that rebecs are of, of the stand-ins, the monitor."""
        runs = [f"{c.file}_node" for c in self.classes if c.executable]
        plays = [f"{c.file}_stand_in" for c in self.classes if any(s.stands_in for s in c.sensors)]
        monitors = ["monitor_node"] if self.monitored else []
        return tuple(sorted([*runs, *plays, *monitors]))

    @property
    def monitored(self) -> bool:
        """Whether a node compares a run of the system with the model."""
        return self.settings.monitor and bool(self.instances)

    @property
    def monitor_node(self) -> str:
        """The name of the node that compares a run with the model."""
        return free_name(
            "monitor", {i.name for i in self.instances} | {s.name for s in self.stand_ins}
        )

    def node_class(self, name: str) -> NodeClass:
        """The class of that name; KeyError when there is none."""
        for node in self.classes:
            if node.name == name:
                return node
        raise KeyError(name)
