"""What the nodes of a package ask of ROS, as values that another process can hand over.

`rebsync.reverse.graph` has the same with the trees that it was read from; here are names, types and
places only, grouped by the nodes that have them.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from rebsync.records import dataclass
from rebsync.reverse.graph import Place, Resolved
from rebsync.reverse.libraries.routines import Access
from rebsync.reverse.policies import Policies
from rebsync.source import Source


class Role(Enum):
    """What a node is at a topic, service or action."""

    PUBLISHER = "publisher"
    SUBSCRIPTION = "subscription"
    SERVER = "server"
    CLIENT = "client"
    ACTION_SERVER = "action server"
    ACTION_CLIENT = "action client"


class Channel(Enum):
    """What a name of the graph stands for."""

    TOPIC = "topic"
    SERVICE = "service"
    ACTION = "action"


CHANNEL_OF = {
    Role.PUBLISHER: Channel.TOPIC,
    Role.SUBSCRIPTION: Channel.TOPIC,
    Role.SERVER: Channel.SERVICE,
    Role.CLIENT: Channel.SERVICE,
    Role.ACTION_SERVER: Channel.ACTION,
    Role.ACTION_CLIENT: Channel.ACTION,
}
# Those at which messages, requests or goals begin.
SENDING = frozenset({Role.PUBLISHER, Role.CLIENT, Role.ACTION_CLIENT})
OTHER_END = {
    Role.PUBLISHER: Role.SUBSCRIPTION,
    Role.SUBSCRIPTION: Role.PUBLISHER,
    Role.SERVER: Role.CLIENT,
    Role.CLIENT: Role.SERVER,
    Role.ACTION_SERVER: Role.ACTION_CLIENT,
    Role.ACTION_CLIENT: Role.ACTION_SERVER,
}


@dataclass(frozen=True, slots=True)
class End:
    """One end of a topic, service or action, as the code has it; `within` is the class around it.

    `policies` are None where there is no quality of service, or it is not of a topic. One that
    `is_lone` is there whether anybody has the other end or not.
    """

    role: Role
    name: Resolved
    type: Resolved
    place: Place
    within: str | None = None
    policies: Policies | None = None
    transport: str | None = None
    is_lone: bool = False


@dataclass(frozen=True, slots=True)
class ParameterUse:
    """A parameter that the code declares, gets or sets."""

    name: Resolved
    access: Access
    place: Place


@dataclass(frozen=True, slots=True)
class NodeCode:
    """A node as its code has it, or code of which it is not known which node runs it.

    `name` is None where the code gives none. `executables` are the names by which launch files
    start it: of programs, components, nodelets. `label` is its class or program. `is_node` says
    that something in the files runs it. `is_flat` says that it is for ROS 2. `closed` says that it
    hands its node to no library that could ask for more names than are here.
    """

    package: str
    label: str
    name: Resolved | None
    executables: frozenset[str]
    ends: tuple[End, ...]
    parameters: tuple[ParameterUse, ...]
    place: Place | None
    is_node: bool
    is_flat: bool
    closed: bool
    anonymous: bool = False


@dataclass(frozen=True, slots=True)
class PackageCode:
    """What was read of a package; `files` are the launch and parameter files by their paths in it.

    `interfaces` are the names of its types of messages, services and actions; `unreadable` the
    files that could not be read, with the reason.
    """

    name: str
    root: str
    nodes: tuple[NodeCode, ...]
    files: Mapping[str, Source]
    interfaces: frozenset[str] = frozenset()
    unreadable: tuple[tuple[str, str], ...] = ()
