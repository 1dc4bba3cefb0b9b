"""The package value as read: what the code of nodes asks ROS for, each with its place.

`rebsync.package` describes a package that a model makes: whole, and closed. Code that people wrote
leaves things open, so here a name, number or type may depend on a parameter, be one of several, or
be unknown with the reason. Names are as the code gives them, before any remapping: absolute `/x`,
relative `x`, private `~x`; the namespace of a node handle is part of the name.
"""

from __future__ import annotations

from dataclasses import field
from enum import Enum
from typing import TypeAlias

from tree_sitter import Node as SyntaxNode

from rebsync.records import dataclass
from rebsync.reverse.libraries.routines import Access
from rebsync.reverse.policies import Policies
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp
from rebsync.source import Source, Span


@dataclass(frozen=True, slots=True)
class Place:
    """Where something stands in the code."""

    source: Source
    span: Span

    @property
    def line(self) -> int:
        return self.source.position(self.span.start).line


# --- values -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Unresolved:
    """A value that the code alone does not tell: why, and the place that makes it so.

    `partial` is what is known of a text, `*` standing for the unknown rest.
    """

    why: str
    place: Place
    partial: str | None = None


@dataclass(frozen=True, slots=True)
class FromParameter:
    """The value of a parameter, looked up by the name that `name` gives.

    `default` is what stands in for it where it is not set (None: nothing). `expression` says how
    the value is used when not as it is, with `value` for it; `search` that it is looked up upwards.
    `within` are the namespaces in which a text that is a name is resolved (empty: the global one).
    """

    name: Resolved
    default: Resolved | None = None
    expression: str | None = None
    search: bool = False
    within: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class OneOf:
    """One of several values, by the way that the program takes.

    `by` says which it is after which calls: those whose arguments are the nodes of these numbers.
    """

    values: tuple[Resolved, ...]
    by: tuple[tuple[frozenset[int], Resolved], ...] = field(default=(), compare=False)


@dataclass(frozen=True, slots=True)
class Under:
    """A name under a node handle that callers outside of the files choose.

    `handles` are the namespaces that callers inside give it.
    """

    name: str
    handles: tuple[str, ...] = ()


Plain: TypeAlias = "bool | int | float | str | tuple[Plain, ...]"
Resolved: TypeAlias = "Plain | FromParameter | OneOf | Under | Unresolved"


# --- callbacks ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Callback:
    """What is called: a function with its body, a lambda, or one of which only the name is known.

    `name` is `function` or `Class::method`, empty for a lambda. `bound` are the arguments that a
    bind puts before those of the message. `through` names the functor's class that calls it.
    """

    name: str
    place: Place
    function: CppFunction | None = None
    lambda_: SyntaxNode | None = None
    bound: tuple[SyntaxNode, ...] = ()
    through: str | None = None


# None for a call that waits for one message; several where one is chosen at run time.
Callbacks: TypeAlias = tuple[Callback | Unresolved, ...]


# --- what is asked of ROS -----------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Site:
    """The call by which a node asks for something.

    `owner` is the class, without namespaces, whose member function holds the call; or the name of
    the free function; None outside of both. `kept` is the expression or member in which the code
    keeps what the call gives (`pub_`, `this->timer`), empty if it does not.
    """

    owner: str | None
    function: CppFunction | None
    cpp: Cpp
    call: SyntaxNode
    place: Place
    kept: str = ""


@dataclass(frozen=True, slots=True)
class NodeFact:
    """A program that is a node, or a nodelet class (then `name` is None: launch files name it)."""

    site: Site
    name: Resolved | None
    anonymous: bool = False
    nodelet: str | None = None


@dataclass(frozen=True, slots=True)
class PublisherFact:
    """`type` is `package/Type`, as for all others.

    `policies` are those of its quality of service; None in ROS 1, which has none.
    """

    site: Site
    topic: Resolved
    type: Resolved
    depth: Resolved
    latched: Resolved = False
    transport: str | None = None
    policies: Policies | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class SubscriptionFact:
    """`single` says that the call waits for one message; `policies` as of a publisher."""

    site: Site
    topic: Resolved
    type: Resolved
    depth: Resolved
    callbacks: Callbacks
    single: bool = False
    transport: str | None = None
    policies: Policies | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class TimerFact:
    """`period` in seconds; `wall` says that it goes by the clock on the wall."""

    site: Site
    period: Resolved
    one_shot: Resolved
    callbacks: Callbacks
    autostart: Resolved = True
    wall: bool = False


@dataclass(frozen=True, slots=True)
class RateFact:
    """A loop's frequency in hertz."""

    site: Site
    hz: Resolved
    wall: bool = False


@dataclass(frozen=True, slots=True)
class ParameterFact:
    """`default` is what the code uses where it is not set (None: nothing), `value` what it sets."""

    site: Site
    name: Resolved
    access: Access
    default: Resolved | None = None
    value: Resolved | None = None
    search: bool = False


@dataclass(frozen=True, slots=True)
class ServiceFact:
    """A service that a node offers."""

    site: Site
    name: Resolved
    type: Resolved
    callbacks: Callbacks


@dataclass(frozen=True, slots=True)
class ClientFact:
    """A service that a node calls."""

    site: Site
    name: Resolved
    type: Resolved


Fact: TypeAlias = (
    NodeFact
    | PublisherFact
    | SubscriptionFact
    | TimerFact
    | RateFact
    | ParameterFact
    | ServiceFact
    | ClientFact
)


class Unmodelled(Enum):
    """What nodes make that has no place in a model, where what it does may be anything.

    The two last are of dynamic_reconfigure: what lets others change parameters, and what does so.
    """

    ACTION_SERVER = "action server"
    ACTION_CLIENT = "action client"
    BROADCASTER = "broadcaster"
    STATIC_BROADCASTER = "static broadcaster"
    LISTENER = "listener"
    CONFIGURED = "server"
    CONFIGURING = "client"


@dataclass(frozen=True, slots=True)
class UnmodelledFact:
    """An end of an action with its name and type; or what sends or gets transforms.

    Of what lets others change parameters `type` is the class of its configuration, `name` the node
    that has it. Both are None where there is no such thing, or it is the node's own.
    """

    site: Site
    what: Unmodelled
    name: Resolved | None = None
    type: Resolved | None = None


@dataclass(frozen=True, slots=True)
class Graph:
    """All that some files ask of ROS, in the order of files and places.

    `unmodelled` is what is listed beside the facts; nothing that makes a model looks at it.
    """

    facts: tuple[Fact, ...] = ()
    unmodelled: tuple[UnmodelledFact, ...] = ()
