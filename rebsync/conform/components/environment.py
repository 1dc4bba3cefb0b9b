"""Closes a package that people wrote: a node more, at the other end of every recorded topic.

What nobody in the files subscribes to is not sent in an extracted model, and what nobody publishes
does not come. So the package is read with a node that subscribes to all topics of a recording and
publishes on them. In the model it stands for what is outside: who sends to it publishes, and to
whom it sends subscribes. It is text as people write it, so that names, types, remappings and
fields mean what they mean everywhere in a package, in all four dialects.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import PurePath

from rebsync.conform.bags import OwnTypes
from rebsync.model import Type
from rebsync.records import dataclass
from rebsync.reverse.build.manifests import package_name
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.files.packages import BESIDE
from rebsync.reverse.files.reading import Chosen
from rebsync.reverse.graph import Graph, PublisherFact, SubscriptionFact
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.recovery import Extracted, extract
from rebsync.source import Source

NODE = "rebsync_environment"
CLASS = "RebsyncEnvironment"
FILE = f"{NODE}.py"
SETTINGS = "rebsync.toml"
_UNIT = 0.001  # s, where nobody has said another: the periods of most timers are multiples


@dataclass(frozen=True, slots=True)
class Link:
    """A topic of the environment: its type, `package/Name`, and the fields that a model has.

    `zeros` are the values with which they begin, as Python has them.
    """

    topic: str
    type: str
    fields: tuple[str, ...]
    zeros: tuple[str, ...]

    @property
    def parameters(self) -> tuple[str, ...]:
        """The names that the fields have as parameters of the environment's server."""
        return tuple(path.replace(".", "_") for path in self.fields)


@dataclass(frozen=True, slots=True)
class Closed:
    """A package read together with its environment; `links` by the names of its servers.

    `keeping` are topics on which a node may keep its last messages for who connects later, and
    `getting` those on which nodes get such.
    `is_clocked`: nodes may have gone by the clock of a topic.
    """

    extracted: Extracted
    settings: Source
    links: Mapping[str, Link]
    depth: int  # the shortest queue of a topic; 0: none is bounded
    dropped: Mapping[str, tuple[str, ...]]  # by topic, the fields that no model has
    keeping: frozenset[str]
    getting: frozenset[str]
    is_clocked: bool


def closed(given: Chosen, topics: Sequence[str]) -> Closed:
    """The model of a package with the environment of some topics."""
    files = dict(given.files)
    if SETTINGS not in files:
        files[SETTINGS] = Source(SETTINGS, f"time_unit = {_UNIT}\n")
    graph = extract(files).graph
    types = MessageTypes.of(files, package_name(files))
    links = {f"on{n}": link for n, link in enumerate(_links(topics, graph, types))}
    files[FILE] = Source(FILE, environment(links, _is_ros_2(files)))
    extracted = extract(files, environment=NODE)
    findings = (*given.findings, *extracted.findings)
    of_people = tuple(f for f in findings if f.source.path != FILE)
    dropped = {link.topic: _dropped(types, link) for link in links.values()}
    people = replace(extracted, findings=of_people)
    is_clocked = "/clock" in topics
    keeping, getting = (
        frozenset(topic for topic in topics if _keeps(kind, topic, graph))
        for kind in (PublisherFact, SubscriptionFact)
    )
    depth = _depth(graph)
    return Closed(people, files[SETTINGS], links, depth, dropped, keeping, getting, is_clocked)


def _is_ros_2(files: Mapping[str, Source]) -> bool:
    code = (s.text for s in files.values())
    return any("rclcpp" in text or "rclpy" in text for text in code)


def _links(topics: Sequence[str], graph: Graph, types: MessageTypes) -> Iterator[Link]:
    """The topics with each type that they may have by what the code asks for."""
    facts = [f for f in graph.facts if isinstance(f, PublisherFact | SubscriptionFact)]
    every = {f.type for f in facts if isinstance(f.type, str)}
    for topic in topics:
        same = {
            f.type
            for f in facts
            if isinstance(f.type, str) and isinstance(f.topic, str) and _is_named(f.topic, topic)
        }
        for type_ in sorted(same or every):
            fields = types.fields(type_)
            if fields is not None:
                kept = {path: of for path, of in fields.items() if of is not None}
                yield Link(topic, type_, tuple(kept), tuple(map(_zero, kept.values())))


def _keeps(kind: type[PublisherFact] | type[SubscriptionFact], topic: str, graph: Graph) -> bool:
    """Whether an end that may be the topic's may keep messages, or get such that were kept.

    In ROS 2 both ends have to ask for it; in ROS 1 the publisher does.
    """
    facts = (f for f in graph.facts if isinstance(f, kind))
    of_topic = (f for f in facts if not isinstance(f.topic, str) or _is_named(f.topic, topic))
    return any(_may_keep(fact) for fact in of_topic)


def _may_keep(fact: PublisherFact | SubscriptionFact) -> bool:
    if isinstance(fact, PublisherFact) and fact.latched is not False:
        return True
    if fact.policies is None:
        return isinstance(fact, SubscriptionFact)
    return fact.policies.durability != "volatile"


def _is_named(name: str, topic: str) -> bool:
    """Whether a name in the code may be a topic, in some namespace."""
    return name.rpartition("/")[2].lstrip("~") == topic.rpartition("/")[2]


def _zero(type_: Type) -> str:
    zeros = {"boolean": "False", "float": "0.0", "double": "0.0", TEXT.name: '""'}
    zero = zeros.get(type_.name, "0")
    return f"[{', '.join([zero] * type_.dimensions[0])}]" if type_.dimensions else zero


def _dropped(types: MessageTypes, link: Link) -> tuple[str, ...]:
    fields = types.fields(link.type) or {}
    return tuple(path for path, of in fields.items() if of is None)


def _depth(graph: Graph) -> int:
    depths = []
    for fact in graph.facts:
        if isinstance(fact, PublisherFact | SubscriptionFact):
            unbounded = fact.depth is None or fact.depth == 0
            depths.append(fact.depth if isinstance(fact.depth, int) else 0 if unbounded else 1)
    bounded = [depth for depth in depths if depth > 0]
    return min(bounded, default=0)


def environment(links: Mapping[str, Link], is_ros_2: bool) -> str:
    """The text of the node."""
    base = "(Node)" if is_ros_2 else ""
    lines = ["import rclpy", "from rclpy.node import Node"] if is_ros_2 else ["import rospy"]
    for package, name in sorted({_split(link.type) for link in links.values()}):
        lines.append(f"from {package}.msg import {name}")
    lines += ["", "", f"class {CLASS}{base}:", "    def __init__(self):"]
    lines += [f'        super().__init__("{NODE}")'] if is_ros_2 else ["        self.n = 0"]
    for server, link in links.items():
        name = _split(link.type)[1]
        both = zip(link.parameters, link.zeros, strict=True)
        lines += (f"        self.{server}_{p} = {zero}" for p, zero in both)
        if is_ros_2:
            lines += [
                f'        self.to_{server} = self.create_publisher({name}, "{link.topic}", 1)',
                f'        self.create_subscription({name}, "{link.topic}", self.{server}, 1)',
            ]
        else:
            lines += [
                f'        self.to_{server} = rospy.Publisher("{link.topic}", {name}, queue_size=1)',
                f'        rospy.Subscriber("{link.topic}", {name}, self.{server})',
            ]
    for server, link in links.items():
        lines += ["", f"    def {server}(self, msg):"]
        both = zip(link.parameters, link.fields, strict=True)
        lines += (f"        self.{server}_{p} = msg.{path}" for p, path in both)
        lines += [f"        self.to_{server}.publish(msg)"]
    start = (
        ["    rclpy.init()", f"    rclpy.spin({CLASS}())"]
        if is_ros_2
        else [f'    rospy.init_node("{NODE}")', f"    {CLASS}()", "    rospy.spin()"]
    )
    return "\n".join([*lines, "", "", 'if __name__ == "__main__":', *start, ""])


def _split(type_: str) -> tuple[str, str]:
    package, _, name = type_.partition("/")
    return package, name


def own_types(given: Chosen) -> OwnTypes:
    """The message types that a package declares."""
    own = {path: s for path, s in given.files.items() if not path.startswith(BESIDE)}
    found = ((PurePath(path), source) for path, source in own.items())
    texts = {path.stem: s.text for path, s in found if path.suffix == ".msg"}
    return OwnTypes(package_name(given.files), texts)
