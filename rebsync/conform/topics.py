"""The topics of a model's nodes, and what makes events of the messages on them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from rebsync.conform.observable import Observable, nested
from rebsync.conform.recording import (
    Announced,
    Driven,
    Event,
    Place,
    Sent,
    Served,
    Ticked,
)
from rebsync.model import Type
from rebsync.package import MessageType
from rebsync.records import dataclass

_NEVER = 2**63 - 1
_NANO = 1e-9
_SERVED = ("server", "arguments", "arrival", "start", "now")

Message: TypeAlias = Mapping[str, Any]
Convert: TypeAlias = Callable[[Message, float, Place, str], Event]
Build: TypeAlias = Callable[[Sequence[Any], float, Place, str], Event]


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic of the model without its namespace, the type of its messages, and what they tell.

    Where there are many, `fields` are read, and `build` makes the event of their values.
    """

    name: str
    type: str
    convert: Convert
    is_state: bool = False
    fields: tuple[str, ...] = ()
    build: Build | None = None


@dataclass(frozen=True, slots=True)
class Topics:
    """All topics by name; `sent` are those between rebecs, read only where they are asked for."""

    known: Mapping[str, Topic]
    sent: Mapping[str, Topic]

    @classmethod
    def of(cls, observable: Observable) -> Topics:
        """The topics of the nodes of a model."""
        states = [_state(observable, rebec) for rebec in range(len(observable.nodes))]
        others = [Topic("startup", "Announcement", _announced), Topic("clock", "", _ticked)]
        return cls(
            {t.name: t for t in (*states, *others, *_drives(observable))},
            {t.name: t for t in _servers(observable)},
        )

    def find(self, topic: str, with_sent: bool = False) -> tuple[str, Topic] | None:
        """The namespace and the topic that a name on the wire stands for; None: it is no topic of
        the model."""
        words = topic.strip("/").split("/")
        for count in range(min(len(words), 6), 0, -1):
            name = "/".join(words[-count:])
            found = self.known.get(name) or (self.sent.get(name) if with_sent else None)
            if found is not None:
                return "/".join(words[:-count]), found
        return None


def _state(observable: Observable, rebec: int) -> Topic:
    names, decode = observable.decoder(rebec)
    fields = (*_SERVED, *names)

    def build(values: Sequence[Any], stamp: float, place: Place, publisher: str) -> Event:
        server, arguments, arrival, start, now = values[:5]
        return Served(
            rebec,
            str(server),
            str(arguments),
            int(arrival),
            int(start),
            int(now),
            decode(values[5:]),
            stamp,
            place,
            publisher,
        )

    def convert(message: Message, stamp: float, place: Place, publisher: str) -> Event:
        return build([message[name] for name in fields], stamp, place, publisher)

    topic, type_ = f"{observable.nodes[rebec]}/state", observable.states[rebec].name
    return Topic(topic, type_, convert, True, fields, build)


def _announced(message: Message, stamp: float, place: Place, publisher: str) -> Event:
    zero = int(message["zero"]) or int(message["stamp"])
    return Announced(str(message["rebec"]), zero * _NANO, stamp, place)


def _ticked(message: Message, stamp: float, place: Place, publisher: str) -> Event:
    clock = message["clock"]
    if not isinstance(clock, (int, float)):
        seconds = getattr(clock, "sec", None)
        clock = seconds + clock.nanosec * _NANO if seconds is not None else float("nan")
    return Ticked(float(clock), stamp, place)


def _drives(observable: Observable) -> Iterator[Topic]:
    """The velocities that robots are told."""
    for rebec, info in enumerate(observable.program.rebecs):
        names = _lineage(observable, info.class_name)
        if any(observable.package.node_class(name).moves for name in names):
            yield Topic(f"{observable.nodes[rebec]}/cmd_vel", "Twist", _driven(rebec))


def _driven(rebec: int) -> Convert:
    def convert(message: Message, stamp: float, place: Place, publisher: str) -> Event:
        linear, angular = message["linear"], message["angular"]
        x, y, turn = _member(linear, "x"), _member(linear, "y"), _member(angular, "z")
        return Driven(rebec, x, y, turn, stamp, place)

    return convert


def _member(value: Any, name: str) -> float:  # noqa: ANN401
    return float(value[name] if isinstance(value, Mapping) else getattr(value, name))


def _servers(observable: Observable) -> Iterator[Topic]:
    package, program = observable.package, observable.program
    for rebec, info in enumerate(program.rebecs):
        node = observable.nodes[rebec]
        for name in _lineage(observable, info.class_name):
            for served in package.node_class(name).subscriptions:
                prefix = f"control_bridge/{node}" if served.on_bridge else node
                convert = _sent(rebec, served.server, served.message)
                yield Topic(f"{prefix}/{served.topic}", served.message.name, convert)


def _lineage(observable: Observable, name: str) -> Iterator[str]:
    """A class and its ancestors, the class last."""
    for base in observable.package.node_class(name).bases:
        yield from _lineage(observable, base)
    yield name


def _sent(rebec: int, server: str, type_: MessageType) -> Convert:
    fields = [(f.name, f.type) for f in type_.fields]

    def convert(message: Message, stamp: float, place: Place, publisher: str) -> Event:
        timing = message["timing"]
        read = timing.__getitem__ if isinstance(timing, Mapping) else timing.__getattribute__
        deadline = int(read("deadline"))
        texts = (_text(message[name], type_) for name, type_ in fields)
        arrival = int(read("arrival")) if read("stamped") else None
        due = None if deadline == _NEVER or arrival is None else deadline
        return Sent(rebec, server, ", ".join(texts), arrival, due, stamp, place, publisher)

    return convert


def _text(value: Any, type_: Type) -> str:  # noqa: ANN401
    """A value as nodes write it."""
    if type_.dimensions:
        return nested([_text(v, Type(type_.name)) for v in value], type_.dimensions)
    match type_.name:
        case "boolean":
            return "true" if value else "false"
        case "float" | "double":
            return f"{float(value):g}"
        case _:
            return str(value)
