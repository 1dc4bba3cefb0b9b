"""A deterministic stand-in for rospy in one process: simulated time, callbacks in turns.

As in rospy each topic's callbacks run in a thread of their own, one after the other, and a callback
that sleeps lets the others go on. Here only one of them runs at a time, and what is due first goes
first, so that a run is the same every time.
"""

from __future__ import annotations

import heapq
import sys
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from tests.reverse.native.ros1 import Input

_PERIOD = 1.0  # s, between two inputs
_END = 40.0  # s, when a run is over


class Ended(BaseException):
    """Raised in what still sleeps when the run is over."""


class Play:
    """One run of a program: its inputs, one a second, and what it publishes."""

    def __init__(self, inputs: Sequence[Input]) -> None:
        self.sent: list[Input] = []
        self._now = 0.0
        self._number = 0
        self._due: list[tuple[float, int, Callable[[], None]]] = []
        self._turn = threading.Semaphore(0)
        self._callbacks: dict[str, list[Callable[[Any], None]]] = {}
        self._busy: dict[int, deque[Callable[[], None]]] = {}
        self._ended = False
        for number, (topic, value) in enumerate(inputs):
            self._at((number + 1) * _PERIOD, partial(self._deliver, topic, value))

    # --- what time brings -----------------------------------------------------------------------

    def _at(self, time: float, action: Callable[[], None]) -> None:
        self._number += 1
        heapq.heappush(self._due, (time, self._number, action))

    def _deliver(self, topic: str, value: int) -> None:
        for number, callback in enumerate(self._callbacks.get(topic, ())):
            message = SimpleNamespace(data=value)
            self._queue(hash((topic, number)), partial(callback, message))

    def _queue(self, key: int, action: Callable[[], None]) -> None:
        """One thread for each subscription and timer: what it is busy with goes on first."""
        waiting = self._busy.setdefault(key, deque())
        waiting.append(action)
        if len(waiting) == 1:
            self._thread(lambda: self._serve(waiting))

    def _serve(self, waiting: deque[Callable[[], None]]) -> None:
        while waiting:
            waiting[0]()
            waiting.popleft()

    def _thread(self, action: Callable[[], None]) -> None:
        """Runs what has its own thread until it ends or sleeps."""

        def run() -> None:
            try:
                action()
            except Ended:
                pass
            finally:
                self._turn.release()

        threading.Thread(target=run, daemon=True).start()
        self._turn.acquire()

    def sleep(self, seconds: float) -> None:
        """Lets others go on; raises Ended when the run is over."""
        woken = threading.Semaphore(0)

        def wake() -> None:
            woken.release()
            self._turn.acquire()

        self._at(self._now + seconds, wake)
        self._turn.release()
        woken.acquire()
        if self._ended:
            raise Ended

    def run(self, program: Callable[[], None]) -> None:
        """The program until its end, and what happens until the run is over."""
        self._at(0.0, lambda: self._thread(program))
        while self._due and self._due[0][0] <= _END:
            self._now, _, action = heapq.heappop(self._due)
            action()
        self._ended = True

    # --- rospy ----------------------------------------------------------------------------------

    def module(self) -> ModuleType:
        """What programs import as `rospy`."""
        rospy = ModuleType("rospy")
        quiet = ("init_node", "loginfo", "logwarn", "logerr", "logdebug", "on_shutdown")
        given: dict[str, Any] = {name: lambda *a, **k: None for name in quiet}
        given |= {
            "Publisher": self._publisher,
            "Subscriber": self._subscriber,
            "Timer": self._timer,
            "Rate": self._rate,
            "Duration": float,
            "sleep": self.sleep,
            "spin": lambda: self.sleep(10 * _END),
            "is_shutdown": lambda: self._ended,
            "get_param": lambda name, default=None: default,
            "ROSInterruptException": Ended,
        }
        rospy.__dict__.update(given)
        return rospy

    def _publisher(self, topic: str, *_: object, **__: object) -> SimpleNamespace:
        def publish(message: SimpleNamespace | int) -> None:
            value = message if isinstance(message, int) else message.data
            self.sent.append((topic, int(value)))

        return SimpleNamespace(publish=publish)

    def _subscriber(
        self,
        topic: str,
        _: object,
        callback: Callable[..., None],
        callback_args: object = None,
        **__: object,
    ) -> None:
        given = () if callback_args is None else (callback_args,)
        self._callbacks.setdefault(topic, []).append(lambda m: callback(m, *given))

    def _timer(
        self, period: float, callback: Callable[[Any], None], oneshot: bool = False
    ) -> object:
        stopped: list[bool] = []

        def fire(key: int = self._number) -> None:
            if stopped:
                return
            self._queue(key, lambda: callback(None))
            if not oneshot:
                self._at(self._now + period, fire)

        self._at(self._now + period, fire)
        return SimpleNamespace(shutdown=lambda: stopped.append(True))

    def _rate(self, hertz: float) -> SimpleNamespace:
        return SimpleNamespace(sleep=lambda: self.sleep(1.0 / hertz))


def played(program: Path, inputs: Sequence[Input]) -> list[Input]:
    """What a program publishes: topics and values, in order."""
    play = Play(inputs)
    text = compile(program.read_text(encoding="utf-8"), str(program), "exec")
    messages = ModuleType("std_msgs.msg")
    messages.__dict__["Int32"] = lambda data=0: SimpleNamespace(data=data)
    modules = {"rospy": play.module(), "std_msgs": ModuleType("std_msgs"), "std_msgs.msg": messages}
    with imported(modules):
        play.run(lambda: exec(text, {"__name__": "__main__"}))
    return play.sent


@contextmanager
def imported(modules: dict[str, ModuleType]) -> Iterator[None]:
    before = {name: sys.modules.get(name) for name in modules}
    sys.modules.update(modules)
    try:
        yield
    finally:
        for name, module in before.items():
            if module is None:
                del sys.modules[name]
            else:
                sys.modules[name] = module
