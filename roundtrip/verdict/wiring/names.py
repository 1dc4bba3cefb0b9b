"""Which publishers reach which subscriptions: names of topics, resolved as ROS does.

Who is joined with whom is what counts. How a topic is called between nodes of a package does not.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from rebsync.records import dataclass
from rebsync.reverse.scaffold.fact import NOT_GIVEN, PLAYED, PROGRAM, TYPE, Fact, Facts

_INSTANCES = ("parameter", "", "mailbox/instances")
_LISTED = re.compile(r"(\w+):\[([^\]]*)\]")
_STRING = re.compile(r'"([^"]*)"')
_QUOTED = re.compile(r"'([^']*)'")
_NAME = re.compile(r"(?:~/?|/)?\w+(?:/\w+)*\Z")
_SENDING = frozenset({"publisher", PLAYED})
RUNTIME_TOPICS = frozenset({"/clock", "/startup"})
TOPICS = frozenset({"publisher", "subscription", "sensor"})


class _Unknown(Exception):
    """A name that the texts do not tell."""


@dataclass(frozen=True, slots=True)
class _End:
    """A publisher or subscription of a node; `rebec` is whom it is for, of a publisher to many.

    The name is that of a member, or of the server that a subscription is for.
    """

    node: str
    kind: str
    name: str
    message: str = ""
    rebec: str = ""

    @property
    def plain(self) -> _End:
        """The same whatever the member is called."""
        return self if self.kind == "subscription" else replace(self, name="")


@dataclass(frozen=True, slots=True)
class JoinedTopics:
    """`names` are those of all ends, before and after remapping.

    `pairs` are publishers with the subscriptions that they reach; `alone` are the topics of ends
    that reach nothing in the package.
    """

    names: frozenset[str]
    pairs: frozenset[tuple[_End, _End]]
    alone: frozenset[tuple[_End, str]]

    def is_as(self, other: JoinedTopics) -> bool:
        """Whether the same ends are joined, and the names of the others are the same."""
        return (self.pairs, self.alone) == (other.pairs, other.alone)

    def loses(self, other: JoinedTopics) -> str | None:
        """What of messages between nodes that arrive here does not there, if anything."""
        for one, to in sorted(self._messages() - other._messages(), key=str):
            return f"what {one.node} sends to {to.name} of {to.node} does not get there"
        return None

    def gains(self, other: JoinedTopics) -> str | None:
        """What of messages between nodes arrives there only, if anything."""
        for one, to in sorted(other._messages() - self._messages(), key=str):
            return f"what {one.node} sends as {one.message} also gets to {to.name} of {to.node}"
        return None

    def delivers_as(self, other: JoinedTopics) -> bool:
        """Whether the same messages between nodes get to the same servers."""
        return self._messages() == other._messages()

    def _messages(self) -> set[tuple[_End, _End]]:
        return {(one.plain, to) for one, to in self.pairs if one.kind == "publisher"}


def joined(facts: Facts, free: frozenset[_End] = frozenset()) -> JoinedTopics | None:
    """Who is joined with whom; None where the texts do not tell all names.

    What is `free` does not count.
    """
    nodes = [owner for kind, owner, _ in facts if kind == TYPE]
    if not nodes or not any(kind == PROGRAM for kind, _, _ in facts):
        return None
    try:
        ends = [e for node in nodes for e in _Node(facts, node).ends() if e[0] not in free]
    except _Unknown:
        return None
    found = {
        (one, other)
        for one, _, topic in ends
        for other, _, same in ends
        if topic == same and one.kind in _SENDING and other.kind not in _SENDING
    }
    paired = {end for pair in found for end in pair}
    alone = frozenset((end, topic) for end, _, topic in ends if end not in paired)
    names = frozenset(name for _, *both in ends for name in both)
    return JoinedTopics(names, frozenset(found), alone)


def replaced(base: Facts, today: Facts) -> tuple[Facts, frozenset[_End]]:
    """The facts of last time but for stand-ins that are no longer started, and their sensors.

    These are free: a real sensor is somewhere else, under whatever name.
    """
    playing = {owner for kind, owner, _ in base if kind == PLAYED}
    started = {owner: facts for (kind, owner, _), facts in base.items() if kind == TYPE}
    gone = {n for n, facts in started.items() if {f.value for f in facts} <= playing}
    gone -= {owner for kind, owner, _ in today if kind == TYPE}
    whole = joined(base)
    if not gone or whole is None:
        return base, frozenset()
    free = frozenset(to for one, to in whole.pairs if one.kind == PLAYED and one.node in gone)
    return {k: v for k, v in base.items() if k[1] not in gone}, free


def is_about(joined: JoinedTopics | None, facts: Facts, remap: Fact) -> bool:
    """Whether a remap is of a topic, or to a topic, by which nodes of the package are joined."""
    if joined is None or not remap.owner:
        return joined is None or _common(remap) in joined.names
    node = _Node(facts, remap.owner)
    try:
        return any(node.resolved(name) in joined.names for name in (remap.name, remap.value))
    except _Unknown:
        return True


def is_of_runtime(facts: Facts, remap: Fact) -> bool:
    """Whether a remap is of a topic, or to a topic, by which the run-time parts of nodes agree."""
    if not remap.owner:
        return _common(remap) in RUNTIME_TOPICS or f"/{remap.value.lstrip('/')}" in RUNTIME_TOPICS
    node = _Node(facts, remap.owner)
    try:
        old, new = node.resolved(remap.name), node.resolved(remap.value)
        own = {node.resolved("startup"), *RUNTIME_TOPICS}
    except _Unknown:
        return True
    return old != new and not own.isdisjoint((old, new))


def leads_in(joined: JoinedTopics, facts: Facts, remap: Fact) -> bool:
    """Whether a remap gives a topic of something else the name of one of the package."""
    node = _Node(facts, remap.owner)
    try:
        old, new = node.resolved(remap.name), node.resolved(remap.value)
    except _Unknown:
        return True
    return old not in joined.names and new in joined.names


def _common(remap: Fact) -> str:
    return f"/{remap.name.lstrip('/')}"


@dataclass(frozen=True, slots=True, eq=False)
class _Node:
    """A node that the launch file starts, with the names that are in it."""

    facts: Facts
    node: str

    def ends(self) -> Iterator[tuple[_End, str, str]]:
        """The ends of a node, each with its topic before and after remapping."""
        remaps = {self.resolved(old): self.resolved(new) for old, new in self._remaps()}
        for end, name in self._written():
            full = self.resolved(name)
            yield end, full, remaps.get(full, full)

    def resolved(self, name: str) -> str:
        """A name as ROS resolves it in this node."""
        if not _NAME.match(name):
            raise _Unknown
        if name[0] == "/":
            return name
        space = self._value(("node", self.node, "ns")).strip("/")
        prefix = "" if space in (NOT_GIVEN, "") else f"/{space}"
        own = name.removeprefix("~").removeprefix("/")
        return f"{prefix}/{self.node}/{own}" if name[0] == "~" else f"{prefix}/{name}"

    def _remaps(self) -> Iterator[tuple[str, str]]:
        for (kind, node, old), found in self.facts.items():
            if kind == "remap" and node in (self.node, ""):
                yield from ((old, fact.value) for fact in found)

    def _value(self, key: tuple[str, str, str]) -> str:
        """The value of the only fact of a key."""
        values = {fact.value for fact in self.facts.get(key, ())}
        if len(values) != 1:
            raise _Unknown
        return values.pop()

    # --- ends -----------------------------------------------------------------------------------

    def _written(self) -> Iterator[tuple[_End, str]]:
        """The ends with their names in the code, private ones with `~`."""
        program = self._module(self._value((TYPE, self.node, "")))
        if (PROGRAM, program, "") not in self.facts and not self._plays(program):
            return  # a node of others
        if played := self._plays(program):
            yield from ((_End(self.node, PLAYED, name), f"~{name}") for name in played)
            return
        class_ = self._value((PROGRAM, program, ""))
        for (kind, owner, name), found in self.facts.items():
            if owner == class_ and kind in TOPICS:
                for fact in found:
                    yield from self._of(fact, _End(self.node, kind, name))

    def _module(self, program: str) -> str:
        """The module of a program that `setup.py` installs by another name."""
        installed = self.facts.get(("installed program", "", program), [])
        return next((f.value.partition(":")[0] for f in installed if ":" in f.value), program)

    def _plays(self, program: str) -> list[str]:
        return [name for kind, owner, name in self.facts if (kind, owner) == (PLAYED, program)]

    def _of(self, fact: Fact, end: _End) -> Iterator[tuple[_End, str]]:
        match fact.kind, _STRING.findall(fact.value):
            case "sensor", [topic]:
                yield end, _private(topic)
            case "subscription", [topic] if fact.value.startswith("subscribeOnBridge"):
                yield end, f"control_bridge/{self.node}/{topic}"
            case "subscription", [topic] if fact.value.startswith("subscribe "):
                yield end, _private(topic)
            case "publisher", [topic] if fact.value.startswith("advertise<"):
                yield replace(end, message=_message(fact)), _private(topic)
            case "publisher", [of, server] if fact.value.startswith("advertiseAll<"):
                for rebec in self._instances(of):
                    to = replace(end, message=_message(fact), rebec=rebec)
                    yield to, f"~{of}/{rebec}/{server}"
            case _:
                raise _Unknown

    def _instances(self, class_: str) -> list[str]:
        own = "parameter", self.node, f"{_INSTANCES[2]}/{class_}"
        if own in self.facts:
            return _QUOTED.findall(self._value(own))
        if _INSTANCES not in self.facts and any(_is_list(key) for key in self.facts):
            return []
        for name, rebecs in _LISTED.findall(self._value(_INSTANCES)):
            if name == class_:
                return [rebec for rebec in rebecs.split(",") if rebec]
        return []


def _is_list(key: tuple[str, str, str]) -> bool:
    """Whether it is that of a list of rebecs that a node of ROS 2 is given."""
    return key[0] == "parameter" and key[2].startswith(_INSTANCES[2])


def _message(publisher: Fact) -> str:
    """The type of what it publishes, without its package."""
    return publisher.value.partition("<")[2].partition(">")[0].rpartition("::")[2].strip()


def _private(name: str) -> str:
    """A name as a private node handle takes it."""
    return name if name.startswith("/") else f"~{name}"
