"""What a stand-in for rclpy serves: events at times of a simulated clock, in one thread.

An executor serves what its nodes have ready, one after the other. While a callback of a
MultiThreadedExecutor sleeps, it serves what the callback groups allow; others serve nothing then.
"""

# ruff: noqa: ANN401 -- messages and results are of any type

from __future__ import annotations

import inspect
from collections import deque
from collections.abc import Callable, Coroutine, Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import Any

NANOSECONDS = 10**9
END = 40 * NANOSECONDS


class Ended(BaseException):
    """Raised in what still runs when the run is over."""


@dataclass(eq=False)
class Group:
    """Callbacks of which one runs at a time, or any number."""

    reentrant: bool = False
    busy: bool = False


@dataclass(eq=False)
class Event:
    """What is ready at a time for the executor that has a node; None stands for all of them."""

    due: int
    node: object | None
    group: Group | None
    work: Callable[[], Any]


class World:
    """One run: its time, what is ready, and what was published."""

    def __init__(self) -> None:
        self.now = 0
        self.events: list[Event] = []
        self.readers: dict[str, list[Reader]] = {}
        self.services: dict[str, Callable[[Any, Future], None]] = {}
        self.sent: list[tuple[str, int]] = []
        self.spun: list[object] = []
        self.is_parallel = False
        self.is_shut_down = False
        self.coroutines: list[tuple[Coroutine[Any, Any, Any], Future, Group | None]] = []

    def ok(self) -> bool:
        return not self.is_shut_down and self.now < END

    def at(
        self, due: int, node: object | None, group: Group | None, work: Callable[[], Any]
    ) -> None:
        self.events.append(Event(due, node, group, work))

    def step(self, until: int) -> bool:
        """Serves what is due first, what comes from outside before; whether there was something."""
        ready = [e for e in self.events if e.due <= until and self._is_served(e)]
        if not ready:
            return False
        event = min(ready, key=lambda e: e.due)
        self.events.remove(event)
        self.now = max(self.now, event.due)
        self._call(event)
        self._resume()
        return event.node is not None or self.step(until)

    def _is_served(self, event: Event) -> bool:
        if event.node is None:
            return True
        return event.node in self.spun and not (event.group and event.group.busy)

    def _call(self, event: Event) -> None:
        group = event.group if event.group and not event.group.reentrant else None
        if group:
            group.busy = True
        result = event.work()
        if inspect.iscoroutine(result):
            self.coroutines.append((result, Future(self), group))
        elif group:
            group.busy = False

    def _resume(self) -> None:
        """Lets coroutines go on until all of them wait."""
        while any(self._goes_on(*entry) for entry in list(self.coroutines)):
            pass

    def _goes_on(
        self, coroutine: Coroutine[Any, Any, Any], future: Future, group: Group | None
    ) -> bool:
        """Lets a coroutine go on until it waits again; whether it has ended."""
        try:
            coroutine.send(None)
        except StopIteration as end:
            self.coroutines.remove((coroutine, future, group))
            future.set_result(end.value)
            if group:
                group.busy = False
            return True
        return False

    def sleep(self, seconds: float) -> None:
        """What others do while a callback sleeps; raises Ended when the run is over."""
        woken = self.now + max(round(seconds * NANOSECONDS), 0)
        spun, self.spun = self.spun, self.spun if self.is_parallel else []
        while self.step(woken):
            pass
        self.spun = spun
        self.now = max(self.now, woken)
        if self.now >= END:
            raise Ended

    def serve(
        self, nodes: list[object], until: int, done: Callable[[], bool], parallel: bool = False
    ) -> None:
        """Serves nodes until something is so, or up to a time."""
        before = self.spun, self.is_parallel
        self.spun, self.is_parallel = list(nodes), parallel
        while not self.is_shut_down and not done():
            if not self.step(min(until, END)):
                self.now = max(self.now, min(until, END))
                break
        self.spun, self.is_parallel = before

    def publish(self, topic: str, make: Callable[[], Any]) -> None:
        for reader in self.readers.get(topic, ()):
            reader.waiting.append(make())
            self.at(self.now, reader.node, reader.group, reader.take)


@dataclass(eq=False)
class Reader:
    """A subscription: what came last waits, no more than its depth."""

    node: object
    group: Group
    callback: Callable[[Any], Any]
    depth: int
    waiting: deque[Any] = field(init=False)

    def __post_init__(self) -> None:
        self.waiting = deque(maxlen=max(self.depth, 1))

    def take(self) -> Any:
        return self.callback(self.waiting.popleft()) if self.waiting else None


class Future:
    """What will be known; its callbacks are served as others are."""

    def __init__(self, world: World) -> None:
        self._world, self._done, self._result = world, False, None
        self._callbacks: list[Callable[[Future], Any]] = []

    def done(self) -> bool:
        return self._done

    def cancelled(self) -> bool:
        return False

    def exception(self) -> None:
        return None

    def result(self) -> Any:
        return self._result

    def set_result(self, result: Any) -> None:
        self._result, self._done = result, True
        for callback in self._callbacks:
            self._world.at(self._world.now, None, None, partial(callback, self))

    def add_done_callback(self, callback: Callable[[Future], Any]) -> None:
        if self._done:
            self._world.at(self._world.now, None, None, lambda: callback(self))
        else:
            self._callbacks.append(callback)

    def __await__(self) -> Iterator[None]:
        while not self._done:
            yield
        return self._result
