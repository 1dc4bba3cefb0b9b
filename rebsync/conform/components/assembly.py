"""Makes components of a closed model and of what was recorded on its topics."""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import field
from itertools import chain
from math import inf

from rebsync import model as m
from rebsync.checker.program import Program
from rebsync.conform.components.bodies import ComponentBodies
from rebsync.conform.components.component import (
    CONNECTS,
    UNORDERED,
    Cells,
    Component,
    Input,
    Output,
    Timing,
)
from rebsync.conform.components.disturbance import conflicts
from rebsync.conform.components.environment import CLASS, Closed, Link
from rebsync.conform.components.heard import HeardRecordings
from rebsync.conform.components.interface import (
    Interface,
    Received,
    Unmodelled,
    interfaces,
    parameter_names,
    reader,
)
from rebsync.conform.components.spool import Spool
from rebsync.conform.conformance import Deviation
from rebsync.conform.recording import Heard, Truncated
from rebsync.records import dataclass
from rebsync.statements import UNREADABLE

_JUMP = 1.0  # s that stamps of a topic may go back


class NotCompared(Exception):
    """Why a rebec cannot be compared."""


@dataclass(slots=True)
class Assembly:
    """The components, and what is left out.

    `open` keeps the answer from being more than undetermined, `notes` do not. `doubts` are by
    rebecs why a refusal of them would say nothing.
    """

    components: list[Component] = field(default_factory=list)
    deviations: list[Deviation] = field(default_factory=list)
    open: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    doubts: dict[str, str] = field(default_factory=dict)
    recorded: int = 0
    begin: float = 0.0  # s, of the first message
    end: int = 0


@dataclass(frozen=True, slots=True)
class Scale:
    """A unit of the model, and by how much things may be late, in seconds."""

    unit: float
    slack: float


def assemble(
    closed: Closed, model: m.Model, program: Program, recordings: HeardRecordings, scale: Scale
) -> Assembly:
    """Components of all rebecs that can be compared. RebsyncError: a file cannot be read."""
    assembler = _Assembler(closed, model, program, scale, interfaces(model, closed.links))
    assembler.read(recordings)
    for interface in assembler.interfaces:
        assembler.add(interface)
    return assembler.found


@dataclass(slots=True)
class _Assembler:
    closed: Closed
    model: m.Model
    program: Program
    scale: Scale
    interfaces: tuple[Interface, ...]
    found: Assembly = field(default_factory=Assembly)
    begin: float = inf
    end: float = -inf
    _heard: dict[str, Spool[Heard]] = field(default_factory=dict)
    _publishers: dict[str, dict[str, None]] = field(default_factory=dict)
    _links: dict[str, tuple[str, Link]] = field(default_factory=dict)
    _latest: dict[str, float] = field(default_factory=dict)
    _jumps: set[str] = field(default_factory=set)

    # --- reading

    def read(self, recordings: HeardRecordings) -> None:
        """The messages on all topics of the rebecs. RebsyncError: a file cannot be read."""
        used = {each.link for i in self.interfaces for each in i.received}
        used |= {link for i in self.interfaces for link in i.published}
        for server in sorted(used):
            link = self.closed.links[server]
            if link.topic in self._links:
                self.found.open.append(f"{link.topic} has messages of several types")
            self._links[link.topic] = server, link
        wanted = {topic: link.fields for topic, (_, link) in self._links.items()}
        for topic, agree in recordings.recorded_twice(wanted).items():
            why = f"several files have messages on {topic} at the same time"
            for interface in self.interfaces:
                self.found.doubts[interface.rebec] = why
            if not agree:
                self.found.open.append(f"{why}, and not the same")
        for event in recordings.events(wanted):
            if isinstance(event, Truncated):
                self.found.open.append(f"it can be compared up to there: {event.why}")
                break
            if isinstance(event, Heard):
                self._hear(event)
        for topic in sorted(self._jumps):
            why = f"the clock jumps back in the messages on {topic}"
            self.found.open.append(why)
            self.found.doubts |= {interface.rebec: why for interface in self.interfaces}
        if self._heard:
            self.found.begin = self.begin
            self.found.end = round((self.end - self.begin) / self.scale.unit)
        for topic in sorted(self._links):
            lacking = self.closed.dropped.get(topic, ())
            if self._heard.get(topic) and lacking:
                names = ", ".join(lacking)
                self.found.notes.append(
                    f"not compared of {link.topic}, as no model has it: {names}"
                )

    def _hear(self, event: Heard) -> None:
        topic, stamp = event.topic, event.stamp
        if topic not in self._heard:
            self._heard[topic], self._publishers[topic] = Spool(), {}
        elif stamp < self._latest[topic] - _JUMP:
            self._jumps.add(topic)
        self._heard[topic].append(event)
        self._publishers[topic][event.publisher] = None
        self._latest[topic] = stamp
        self.begin = min(self.begin, stamp)
        self.end = max(self.end, stamp)

    # --- one rebec

    def add(self, interface: Interface) -> None:
        """The component of a rebec, or why there is none."""
        heard = [link for link in interface.published if self._heard.get(self._topic(link))]
        for link in interface.published:
            if link not in heard:
                topic = self._topic(link)
                note = f"nothing on {topic} was recorded: what {interface.rebec} publishes there"
                self.found.notes.append(f"{note} was not compared")
        try:
            component = self._component(interface, heard) if heard else None
        except (NotCompared, Unmodelled) as why:
            self.found.open.append(f"{interface.rebec} was not compared: {why}")
            return
        if component is None:
            self.found.notes.append(f"{interface.rebec} publishes nothing that was recorded")
        else:
            self.found.components.append(component)

    def _component(self, interface: Interface, heard: Sequence[str]) -> Component | None:
        class_ = self._class(interface)
        names = [info.name for info in self.program.rebecs]
        rebec, environment = names.index(interface.rebec), self._environment()
        self._check(interface, class_)
        outputs = [self._outputs(interface, link) for link in heard]
        if not any(outputs):
            return None
        first = min(all_[0].stamp for all_ in outputs if all_)
        servers = self._servers(rebec)
        inputs = (self._inputs(each, servers) for each in interface.received)
        timing = Timing(self.scale.unit, self.scale.slack, self.begin, self.end, first)
        numbers = self._servers(environment)
        pairs = conflicts(class_)
        both = zip(heard, outputs, strict=True)
        kept = tuple(inf if self._is_old(link, all_, first) else 0.0 for link, all_ in both)
        return Component(
            self.program,
            rebec,
            ComponentBodies(self.program, rebec, environment),
            timing,
            Spool(heapq.merge(*inputs, key=_stamp)),
            tuple(self._topic(link) for link in heard),
            tuple(outputs),
            {numbers[link]: k for k, link in enumerate(heard)},
            kept,
            frozenset((servers[a], servers[b]) for a, b in pairs if {a, b} <= servers.keys()),
            is_bounded=self.closed.depth > 0,
        )

    def _check(self, interface: Interface, class_: m.ReactiveClass) -> None:
        """NotCompared: its model lacks something, or the recording does."""
        lines = [n for n in m.walk(class_) if isinstance(n, m.Annotation) and n.name == UNREADABLE]
        if lines:
            raise NotCompared(f"{len(lines)} of its statements could not be read")
        if self.program.reads_clock:
            raise NotCompared("the code decides by the clock, which no recording has")
        sent = self._sent_inside(interface)
        missing = [server for server in interface.unfed if server in sent]
        if missing:
            names = ", ".join(missing)
            raise NotCompared(f"what other nodes send to its {names} was not recorded")
        if self.closed.is_clocked:
            why = "it may have gone by /clock, and stamps may be of another clock"
            self.found.doubts[interface.rebec] = why
        if interface.unfed:
            names = ", ".join(interface.unfed)
            self.found.notes.append(f"nothing for {names} of {interface.rebec} was recorded")
            self.found.doubts[interface.rebec] = f"it may have served {names}, not recorded"

    def _sent_inside(self, interface: Interface) -> set[str]:
        """The servers of a rebec to which others of the package send."""
        return {
            call.server
            for other in self.interfaces
            for call in other.sent
            if call.receiver == interface.rebec
        }

    def _class(self, interface: Interface) -> m.ReactiveClass:
        name = next(r.class_name for r in self.program.rebecs if r.name == interface.rebec)
        return next(
            c for c in self.model.classes if isinstance(c, m.ReactiveClass) and c.name == name
        )

    def _environment(self) -> int:
        return next(n for n, r in enumerate(self.program.rebecs) if r.class_name == CLASS)

    def _servers(self, rebec: int) -> dict[str, int]:
        dispatch = (n for n in self.program.rebecs[rebec].dispatch if n >= 0)
        return {self.program.servers[n].name: n for n in dispatch}

    def _topic(self, link: str) -> str:
        return self.closed.links[link].topic

    # --- messages

    def _outputs(self, interface: Interface, link: str) -> Spool[Output]:
        server, found = self._servers(self._environment())[link], Spool[Output]()
        places = self._places(link)
        cells_of = self._reader(server)
        for _, values, stamp, file, number, _ in self._own(interface, link):
            values = tuple([values[n] for n in places])
            found.append(Output(stamp, cells_of(values), values, file, number))
        self.found.recorded += len(found)
        return found

    def _own(self, interface: Interface, link: str) -> Iterator[Heard]:
        """The messages of a topic that a rebec has published. NotCompared: who has, is not said."""
        topic = self._topic(link)
        publishers = [i.rebec for i in self.interfaces if link in i.published]
        callers = self._publishers[topic]
        by_name = {c: c.rpartition("/")[2] for c in callers}
        mine = {c for c, name in by_name.items() if name == interface.rebec}
        if len(publishers) == 1 and not mine:
            mine = {next(iter(callers))}
        elif not mine:
            both = " and ".join(publishers)
            raise NotCompared(f"{both} publish on {topic}, and the recording does not say which")
        strangers = {c for c, name in by_name.items() if c not in mine and name not in publishers}
        for each in self._heard[topic]:
            if each.publisher in mine:
                yield each
            elif each.publisher in strangers:
                strangers.clear()
                self._strange(interface, topic, each)

    def _is_old(self, link: str, outputs: Sequence[Output], first: float) -> bool:
        """Whether the first message may be one that was kept until the recorder connected."""
        keeps = self._topic(link) in self.closed.keeping
        return keeps and bool(outputs) and outputs[0].stamp <= first + CONNECTS

    def _strange(self, interface: Interface, topic: str, heard: Heard) -> None:
        """Somebody else publishes on a topic of a rebec."""
        message = f"{heard.publisher} publishes on {topic}, as {interface.rebec} does"
        time = round((heard.stamp - self.begin) / self.scale.unit)
        self.found.deviations.append(
            Deviation(
                "second publisher",
                interface.rebec,
                time,
                f"{message}: the package has no such node",
                None,
                0,
                message_place=heard.place,
            )
        )

    def _inputs(self, received: Received, servers: dict[str, int]) -> Iterator[Input]:
        topic, server = self._topic(received.link), servers[received.server]
        heard = self._heard.get(topic, ())
        depth, slack = self.closed.depth, self.scale.slack
        of_link = self._places(received.link)
        places = [of_link[n] for n in received.places]
        inside = sum(received.link in i.published for i in self.interfaces)
        cells_of = self._reader(server)
        # Who publishes from outside may keep messages or not.
        keeps = topic in self.closed.keeping or not inside
        is_kept = keeps and topic in self.closed.getting
        lanes: dict[str, int] = {}
        for each, near in _near(_by_stamp(heard), slack):
            cells = cells_of([each.values[n] for n in places])
            is_first = each.publisher not in lanes
            if is_first:
                lanes[each.publisher] = self._lane(topic, len(lanes))
            lane = lanes[each.publisher] if each.publisher or inside == 1 else UNORDERED
            earliest = self._kept_since(each.stamp) if is_first and keeps else each.stamp - slack
            yield Input(each.stamp, server, cells, lane, 0 < depth < near, earliest, is_kept)

    def _kept_since(self, stamp: float) -> float:
        """When a message may have been published that the recorder got as it connected."""
        return stamp - CONNECTS if stamp > self.begin + CONNECTS else -inf

    def _lane(self, topic: str, number: int) -> int:
        return sorted(self._links).index(topic) * 1000 + number

    def _places(self, link: str) -> list[int]:
        """Where in a message the values are of the parameters of the environment's server."""
        names = self.closed.links[link].parameters
        return [names.index(name) for name in parameter_names(self.model, link)]

    def _reader(self, server: int) -> Callable[[Sequence[object]], Cells]:
        return reader(self.program, server, self.closed.extracted.texts)


def _stamp(event: Heard | Input) -> float:
    return event.stamp


def _by_stamp(heard: Iterable[Heard]) -> Iterator[Heard]:
    """The messages by their stamps, which go back a little at most."""
    waiting: list[tuple[float, int, Heard]] = []
    for number, each in enumerate(heard):
        heapq.heappush(waiting, (each.stamp, number, each))
        while waiting[0][0] < each.stamp - _JUMP:
            yield heapq.heappop(waiting)[2]
    while waiting:
        yield heapq.heappop(waiting)[2]


def _near(heard: Iterator[Heard], slack: float) -> Iterator[tuple[Heard, int]]:
    """Each message with how many there are within the slack of it."""
    waiting, stamps = deque[Heard](), deque[float]()
    for each in chain(heard, (None,)):
        while waiting and (each is None or each.stamp > waiting[0].stamp + slack):
            first = waiting.popleft()
            while stamps[0] < first.stamp - slack:
                stamps.popleft()
            yield first, len(stamps)
        if each is not None:
            waiting.append(each)
            stamps.append(each.stamp)
