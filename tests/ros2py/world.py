"""A ROS 2 in one process: topics, parameters, remaps, timers on a simulated clock.

Nodes run in threads of their own, as their `main` says; `World.run` moves the clock on to the next
timer when all of them wait.
"""

from __future__ import annotations

import copy
import gc
import queue
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import FrameType, SimpleNamespace
from unittest.mock import patch

from tests.ros2py.asking import Executor, Offer, Service
from tests.ros2py.messages import Message, plain
from tests.ros2py.quality import QoSOverridingOptions, QoSProfile, override

NANOSECONDS = 10**9
_FIRST = 100 * NANOSECONDS
_START = NANOSECONDS // 10  # in which nodes agree on time 0
_MOMENT = 0.0002  # s between looks at what threads do
_ENDED = 20.0  # s for all nodes to stop


_WAIT = threading.Condition.wait
_MONOTONIC = time.monotonic


def _waits(frame: FrameType) -> bool:
    """Whether a thread waits for something that nobody has told it yet."""
    if frame.f_code is not _WAIT.__code__:
        return False
    return frame.f_locals.get("waiter") in frame.f_locals["self"]._waiters


def _frames() -> dict[int, FrameType]:
    """What each thread does. CPython holds a lock meanwhile that threads take which start.

    A collection of garbage lets them run, and they wait for ever.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        return sys._current_frames()
    finally:
        if collects:
            gc.enable()


@dataclass(frozen=True)
class Others:
    """Threads that belong to no node: their numbers, and those that `threading` knows."""

    numbers: frozenset[int]
    threads: frozenset[threading.Thread]

    def started(self) -> list[threading.Thread]:
        """All threads that were started since."""
        return [t for t in threading.enumerate() if t not in self.threads]

    def all_else_wait(self) -> bool:
        """Whether all other threads wait, and none is about to start.

        Who starts a thread waits for it, and it has no frame before it runs: nobody would be seen
        to do anything.
        """
        frames = _frames()  # of one moment, before all that follows
        started = [thread.ident for thread in self.started()]
        own = [frame for number, frame in frames.items() if number not in self.numbers]
        return all(number in frames for number in started) and all(map(_waits, own))


@dataclass
class Launched:
    """A node as the launch file has it; `~` in names stands for its own name."""

    name: str
    parameters: Mapping[str, object] = field(default_factory=dict)
    remaps: Mapping[str, str] = field(default_factory=dict)
    changes: Sequence[tuple[float, str]] = ()  # of its life cycle, after seconds

    def resolved(self, topic: str) -> str:
        """The absolute name of a topic of the node."""
        name = self.remaps.get(topic, topic)
        if name.startswith("~/"):
            return f"/{self.name}/{name[2:]}"
        return name if name.startswith("/") else f"/{name}"


@dataclass
class Timer:
    """A periodic timer of a node."""

    node: Node
    period: int
    due: int
    callback: Callable[[], None]
    alive: bool = True

    def cancel(self) -> None:
        self.alive = False


@dataclass(eq=False)
class Sleeper:
    """A thread that waits for no longer than to a time."""

    condition: threading.Condition
    due: int


class Clock:
    """The clock of a node; that of a simulation tells of each of its steps."""

    def __init__(self, world: World) -> None:
        self.world = world

    @property
    def ros_time_is_active(self) -> bool:
        return self.world.step is not None

    def now(self) -> Time:
        return Time(self.world.time)

    def create_jump_callback(
        self, threshold: SimpleNamespace, *, post_callback: Callable[[object], None]
    ) -> object:
        smallest = threshold.min_forward.nanoseconds, threshold.min_backward.nanoseconds
        if smallest != (1, -1) or not threshold.on_clock_change:
            raise ValueError("every jump is told")
        self.world.jumps.append(post_callback)
        return post_callback


@dataclass
class Subscription:
    """A subscription, and what it asks for."""

    node: Node
    topic_name: str
    callback: Callable[[Message], None]
    quality: QoSProfile


class Publisher:
    """A publisher; `kept` are the messages for those that come later."""

    def __init__(self, node: Node, topic: str, quality: QoSProfile) -> None:
        self.node, self.topic_name, self.quality = node, topic, quality
        self.kept: list[Message] = []

    def publish(self, message: Message) -> None:
        self.node.world.deliver(self, copy.deepcopy(message))

    def get_subscription_count(self) -> int:
        return sum(map(self.matches, self.node.world.subscribers(self.topic_name)))

    def matches(self, subscription: Subscription) -> bool:
        """Whether a subscription asks for no more than there is: it hears nothing otherwise."""
        return self.quality.offers(subscription.quality)


class Node:
    """A node: what `main` asks for under a name of its own is what the launch file says."""

    def __init__(self, world: World, launched: Launched) -> None:
        self.world, self.launched = world, launched
        self.queue: queue.Queue[Callable[[], None] | None] = queue.Queue()
        self.parameters: dict[str, object] = {}
        self.timers: list[Timer] = []
        self.spinning: int | None = None  # the thread that calls what is ready

    def get_name(self) -> str:
        return self.launched.name

    def get_fully_qualified_name(self) -> str:
        return f"/{self.launched.name}"

    def create_publisher(
        self,
        type_: type[Message],
        topic: str,
        qos: QoSProfile | int,
        *,
        qos_overriding_options: QoSOverridingOptions | None = None,
    ) -> Publisher:
        name = self.launched.resolved(topic)
        quality = override(f"{name}.publisher", qos, qos_overriding_options, self._found)
        publisher = Publisher(self, name, quality)
        with self.world.lock:
            self.world.publishers.append(publisher)
        return publisher

    def create_subscription(
        self,
        type_: type[Message],
        topic: str,
        callback: Callable[[Message], None],
        qos: QoSProfile | int,
        *,
        qos_overriding_options: QoSOverridingOptions | None = None,
    ) -> Subscription:
        name = self.launched.resolved(topic)
        quality = override(f"{name}.subscription", qos, qos_overriding_options, self._found)
        subscription = Subscription(self, name, callback, quality)
        self.world.subscribe(subscription)
        return subscription

    def destroy_publisher(self, publisher: Publisher) -> None:
        with self.world.lock:
            self.world.publishers.remove(publisher)

    def destroy_subscription(self, subscription: Subscription) -> None:
        self._change("destroyed")
        with self.world.lock:
            self.world.subscriptions.remove(subscription)

    def create_timer(
        self, period: float, callback: Callable[[], None], clock: object = None
    ) -> Timer:
        self._change("made")
        nanoseconds = max(round(period * NANOSECONDS), 1)
        with self.world.lock:
            timer = Timer(self, nanoseconds, self.world.time + nanoseconds, callback)
            self.timers.append(timer)
            self.world.happened += 1
        return timer

    def once(self, seconds: float, act: Callable[[], None]) -> None:
        """Has the thread of the node do something in some seconds."""

        def ring() -> None:
            timer.cancel()
            act()

        due = self.world.time + round(seconds * NANOSECONDS)
        timer = Timer(self, NANOSECONDS, due, ring)
        self.timers.append(timer)

    def destroy_timer(self, timer: Timer) -> None:
        self._change("destroyed")
        with self.world.lock:
            timer.alive = False
            if timer in self.timers:
                self.timers.remove(timer)

    # The executor of a real node dies of it when it is about to look at the timer.
    def _change(self, what: str) -> None:
        if self.spinning not in (None, threading.get_ident()):
            self.world.failures.append(RuntimeError(f"a timer is {what} by another thread"))

    def create_service(
        self, type_: object, name: str, callback: Callable[..., object], *, callback_group: object
    ) -> Service:
        service = Service(self, type_, self.launched.resolved(name), callback)
        self.world.offers.append(service)
        return service

    def destroy_service(self, service: Service) -> None:
        self._change("destroyed")
        service.destroy()

    @property
    def executor(self) -> Executor | None:
        return Executor(self) if self.spinning is not None else None

    def has_parameter(self, name: str) -> bool:
        return name in self.parameters

    def declare_parameter(
        self, name: str, fallback: object, descriptor: object = None
    ) -> SimpleNamespace:
        if name in self.parameters:
            raise RuntimeError(f"{name} is declared already")
        value = self.launched.parameters.get(name, fallback)
        if type(value) is not type(fallback):
            raise TypeError(f"{name}: {value!r} is not of the type of {fallback!r}")
        self.parameters[name] = value
        return SimpleNamespace(value=value)

    def get_parameter(self, name: str) -> SimpleNamespace:
        return SimpleNamespace(value=self.parameters[name])

    def _found(self, name: str, fallback: object) -> object:
        if name not in self.parameters:
            self.declare_parameter(name, fallback)
        return self.parameters[name]

    def get_clock(self) -> Clock:
        return Clock(self.world)

    def get_logger(self) -> SimpleNamespace:
        def write(level: int) -> Callable[..., None]:
            return lambda text, **_: self.world.write(self.get_name(), level, text)

        return SimpleNamespace(info=write(2), warning=write(4), error=write(8))

    def get_subscriptions_info_by_topic(self, topic: str) -> list[SimpleNamespace]:
        found = self.world.subscribers(topic)
        return [SimpleNamespace(node_name=s.node.get_name(), qos_profile=s.quality) for s in found]


@dataclass(frozen=True)
class Time:
    """A moment of the clock."""

    nanoseconds: int

    def to_msg(self) -> Message:
        sec, nanosec = divmod(self.nanoseconds, NANOSECONDS)
        return World.stamp(sec=sec, nanosec=nanosec)

    @staticmethod
    def from_msg(message: object) -> Time:
        sec, nanosec = getattr(message, "sec", 0), getattr(message, "nanosec", 0)
        return Time(sec * NANOSECONDS + nanosec)


def _join(threads: Sequence[threading.Thread]) -> None:
    for thread in threads:
        thread.join(_ENDED)
        if thread.is_alive():
            raise RuntimeError("a node does not stop")


class World:
    """All nodes, topics and timers, and what was published and logged, each with its time.

    Time is that of all clocks of the nodes. With a `step`, in nanoseconds, their ROS clock is that
    of a simulation.
    """

    stamp: Callable[..., Message] = Message

    def __init__(self, step: int | None = None) -> None:
        self.step = step
        self.sleepers: list[Sleeper] = []
        self.jumps: list[Callable[[object], None]] = []
        self.lock = threading.RLock()
        self.time = _FIRST
        self.happened = 0
        self.nodes: dict[int, Node] = {}
        self.publishers: list[Publisher] = []
        self.subscriptions: list[Subscription] = []
        self.offers: list[Offer] = []
        self.asks: list[tuple[int, Callable[[], None]]] = []
        self.shut: set[str] = set()  # nodes whose ROS has shut down
        self.messages: list[tuple[str, float, dict[str, object]]] = []
        self.log: list[tuple[str, int, float, str]] = []
        self.failures: list[BaseException] = []
        self.deaf: dict[str, float] = {}  # nodes that hear announcements some seconds late
        self.stopping = False
        self.context = threading.local()

    def seconds(self) -> float:
        """The time since the first moment."""
        return (self.time - _FIRST) / NANOSECONDS

    def act_at(self, seconds: float, act: Callable[[], None]) -> None:
        """Has something happen that no node does."""
        self.asks.append((_FIRST + round(seconds * NANOSECONDS), act))

    def is_ok(self) -> bool:
        """Whether ROS has not shut down in the node of the thread that asks."""
        launched = getattr(self.context, "launched", None)
        return not (self.stopping or (launched is not None and launched.name in self.shut))

    def shut_down(self) -> None:
        """Ends the node of the thread that asks, if it has one."""
        launched = getattr(self.context, "launched", None)
        if launched is None:
            return
        self.shut.add(launched.name)
        for node in self.nodes.values():
            if node.launched.name == launched.name:
                node.queue.put(None)

    # --- what nodes do --------------------------------------------------------------------------

    def add(self, node: Node) -> None:
        """The node of the thread that asks."""
        with self.lock:
            self.nodes[threading.get_ident()] = node

    @property
    def zero(self) -> float:
        """Time 0 of the model, in seconds after the first moment, once a node has told it."""
        told = [d["zero"] for topic, _, d in self.messages if topic.endswith("/startup")]
        zero = max((z for z in told if isinstance(z, int)), default=0)
        return (zero - _FIRST) / NANOSECONDS if zero else 0.0

    def subscribers(self, topic: str) -> list[Subscription]:
        with self.lock:
            return [s for s in self.subscriptions if s.topic_name == topic]

    def subscribe(self, subscription: Subscription) -> None:
        with self.lock:
            self.subscriptions.append(subscription)
            for publisher in self.publishers:
                if publisher.topic_name != subscription.topic_name:
                    continue
                if subscription.quality.keeps and publisher.matches(subscription):
                    for message in publisher.kept:
                        self._send(subscription, message)

    def deliver(self, publisher: Publisher, message: Message) -> None:
        with self.lock:
            self.happened += 1
            now = (self.time - _FIRST) / NANOSECONDS
            self.messages.append((publisher.topic_name, now, plain(message)))
            if publisher.quality.keeps:
                publisher.kept = [*publisher.kept, message][-publisher.quality.depth :]
            for subscription in self.subscribers(publisher.topic_name):
                if publisher.matches(subscription):
                    self._send(subscription, message)

    def _send(self, subscription: Subscription, message: Message) -> None:
        node, received = subscription.node, copy.deepcopy(message)

        def take() -> None:
            subscription.callback(received)

        late = self.deaf.get(node.get_name(), 0.0)
        if late and subscription.topic_name == "/startup":
            node.once(late, take)
        else:
            node.queue.put(take)

    def write(self, node: str, level: int, text: str) -> None:
        with self.lock:
            self.log.append((node, level, (self.time - _FIRST) / NANOSECONDS, text))

    def spin(self, node: Node) -> None:
        node.spinning = threading.get_ident()
        while (callback := node.queue.get()) is not None:
            callback()
            self.happened += 1

    # --- the run --------------------------------------------------------------------------------

    def run(
        self,
        mains: Sequence[tuple[Launched, Callable[[], None]]],
        until: float,
        quiet: float = 1e6,
    ) -> None:
        """Start nodes, run the clock for some seconds or until all is quiet, and stop them."""
        others = Others(frozenset(_frames()), frozenset(threading.enumerate()))
        with self._timed(others):
            self._run(mains, until, quiet, others)

    @contextmanager
    def _timed(self, others: Others) -> Iterator[None]:
        """The time of this world in place of the machine's, for threads of nodes."""

        def wait(condition: threading.Condition, timeout: float | None = None) -> bool:
            if timeout is None or threading.get_ident() in others.numbers:
                return _WAIT(condition, timeout)
            with self.lock:
                due = self.time + max(round(timeout * NANOSECONDS), 0)
                sleeper = Sleeper(condition, due)
                self.sleepers.append(sleeper)
                self.happened += 1
            if due > self.time:
                _WAIT(condition)
            with self.lock:
                self.sleepers.remove(sleeper)
                return self.time < due

        def monotonic() -> float:
            return (
                _MONOTONIC() if threading.get_ident() in others.numbers else self.time / NANOSECONDS
            )

        waits = patch.object(threading.Condition, "wait", wait)
        with waits, patch.object(time, "monotonic", monotonic):
            yield

    def _run(
        self,
        mains: Sequence[tuple[Launched, Callable[[], None]]],
        until: float,
        quiet: float,
        others: Others,
    ) -> None:
        threads = [threading.Thread(target=self._main, args=main, daemon=True) for main in mains]
        for thread in threads:
            thread.start()
        end = _FIRST + _START + round(until * NANOSECONDS)
        self._settle(others)
        while not self.failures and self._advance(end) and not self._is_quiet(quiet):
            self._settle(others)
        with self.lock:
            self.stopping = True
            nodes = list(self.nodes.values())
        for node in nodes:
            node.queue.put(None)
        _join(threads)
        if self.failures:
            raise self.failures[0]
        # Those that are left over would have their numbers taken by threads of the next world.
        _join(others.started())

    def _is_quiet(self, quiet: float) -> bool:
        """Whether nothing was served for some seconds."""
        with self.lock:
            served = (stamp for topic, stamp, _ in self.messages if topic.endswith("/state"))
            return (self.time - _FIRST) / NANOSECONDS - max(served, default=0.0) >= quiet

    def _main(self, launched: Launched, main: Callable[[], None]) -> None:
        self.context.launched = launched
        try:
            main()
        except BaseException as error:
            self.failures.append(error)

    def _settle(self, others: Others) -> None:
        """Wait until all threads of nodes do."""
        while not self.failures:
            if others.all_else_wait():
                return
            time.sleep(_MOMENT)

    def _advance(self, end: int) -> bool:
        """Move the clock to the next timer; whether there is one before the end."""
        with self.lock:
            timers = [t for n in self.nodes.values() for t in n.timers if t.alive]
            moments = [t.due for t in timers] + [s.due for s in self.sleepers]
            moments += [due for due, _ in self.asks]
            due = min(moments, default=end)
            if self.step is not None:
                due = min(due, self.time + self.step)
            self.time = min(max(due, self.time), end)
            sleepers = [s for s in self.sleepers if s.due <= self.time]
            for timer in timers:
                if timer.due <= self.time:
                    timer.due += timer.period
                    timer.node.queue.put(lambda t=timer: t.callback() if t.alive else None)  # type: ignore[misc]
            ready = [act for due_, act in self.asks if due_ <= self.time]
            self.asks = [(due_, act) for due_, act in self.asks if due_ > self.time]
        for act in ready:
            act()
        for sleeper in sleepers:
            with sleeper.condition:
                sleeper.condition.notify_all()
        for jump in self.jumps if self.step is not None else ():
            jump(None)
        return due < end
