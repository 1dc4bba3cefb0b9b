"""A deterministic stand-in for rclpy in one process, and the runs of programs on it."""

# ruff: noqa: ANN401 -- messages and results are of any type

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any
from unittest.mock import patch

from tests.reverse.native.rclpy_messages import message_modules, module
from tests.reverse.native.rclpy_world import END, NANOSECONDS, Ended, Future, Group, Reader, World
from tests.reverse.native.ros1 import Input
from tests.reverse.native.rospy_play import imported

_PERIOD = NANOSECONDS  # between two inputs


def played(program: Path, inputs: Sequence[Input]) -> list[Input]:
    """What a program publishes: topics and values, in order."""
    world = World()
    modules = _modules(world)
    integer = modules["std_msgs.msg"].__dict__["Int32"]
    for number, (topic, value) in enumerate(inputs):
        made = partial(world.publish, topic, partial(integer, data=value))
        world.at((number + 1) * _PERIOD, None, None, made)
    text = compile(program.read_text(encoding="utf-8"), str(program), "exec")
    with imported(modules), patch("time.sleep", world.sleep), suppress(Ended):
        exec(text, {"__name__": "__main__"})
    return world.sent


# --- what nodes make ----------------------------------------------------------------------------


class Publisher:
    """Publishes copies of messages of its type."""

    def __init__(self, world: World, kind: type, topic: str) -> None:
        self._world, self._kind, self.topic_name = world, kind, topic

    def publish(self, message: Any) -> None:
        if not isinstance(message, self._kind):
            raise TypeError(f"{message!r} is no {self._kind.__name__}")
        if self._world.is_shut_down:
            raise RuntimeError("the context is not valid")
        kept = copy.copy(message)
        value = getattr(kept, "data", 0)
        size = len(value) if isinstance(value, str) else int(value)
        self._world.sent.append((self.topic_name, size))
        self._world.publish(self.topic_name, lambda: copy.copy(kept))

    def get_subscription_count(self) -> int:
        return 1


class Timer:
    """A timer: it may be cancelled and started again."""

    def __init__(
        self, world: World, node: object, group: Group, period: float, callback: Callable[[], Any]
    ) -> None:
        self._world, self._node, self._group = world, node, group
        self._period, self._callback = max(round(period * NANOSECONDS), 1), callback
        self._number, self._cancelled = 0, False
        self.reset()

    def cancel(self) -> None:
        self._cancelled = True

    def is_canceled(self) -> bool:
        return self._cancelled

    def reset(self) -> None:
        self._cancelled = False
        self._arm(self._world.now + self._period)

    def _arm(self, due: int) -> None:
        self._number += 1
        number = self._number

        def fire() -> Any:
            if self._cancelled or number != self._number:
                return None
            late = max(self._world.now - due, 0)
            self._arm(due + (late // self._period + 1) * self._period)
            return self._callback()

        self._world.at(due, self._node, self._group, fire)


class Client:
    """A client of a service: it is answered when both nodes are served."""

    def __init__(self, world: World, node: object, group: Group, name: str) -> None:
        self._world, self._node, self._group, self._name = world, node, group, name

    def wait_for_service(self, timeout_sec: float | None = None) -> bool:
        return self.service_is_ready()

    def service_is_ready(self) -> bool:
        return self._name in self._world.services

    def call_async(self, request: Any) -> Future:
        world, future, answered = self._world, Future(self._world), Future(self._world)
        if self._name in world.services:
            world.services[self._name](request, answered)
            answered.add_done_callback(
                lambda f: world.at(
                    world.now, self._node, self._group, lambda: future.set_result(f.result())
                )
            )
        return future


def _depth(qos: object) -> int:
    return qos if isinstance(qos, int) else getattr(qos, "depth", 10)


def _parameter(name: str, kind: object = None, value: object = None) -> SimpleNamespace:
    return SimpleNamespace(
        name=name,
        value=value,
        type_=kind,
        get_parameter_value=lambda: SimpleNamespace(
            integer_value=value, double_value=value, bool_value=value, string_value=value
        ),
    )


class _Parameters:
    """The parameters of a node, and who is asked before they are set."""

    def __init__(self) -> None:
        self._parameters: dict[str, Any] = {}
        self._on_set: list[Callable[[Any], Any]] = []

    def declare_parameter(self, name: str, value: object = None, _: object = None) -> object:
        self._parameters[name] = _parameter(name, None, value)
        return self._parameters[name]

    def declare_parameters(self, namespace: str, parameters: Sequence[Any]) -> list[object]:
        begin = f"{namespace}." if namespace else ""
        return [self.declare_parameter(begin + p[0], *p[1:]) for p in parameters]

    def has_parameter(self, name: str) -> bool:
        return name in self._parameters

    def get_parameter(self, name: str) -> Any:
        return self._parameters[name]

    def get_parameter_or(self, name: str, alternative_value: Any = None) -> Any:
        return self._parameters.get(name, alternative_value)

    def set_parameters(self, parameters: Sequence[Any]) -> list[Any]:
        results = [c(list(parameters)) for c in self._on_set]
        if all(r.successful for r in results):
            self._parameters.update({p.name: p for p in parameters})
        return results

    def add_on_set_parameters_callback(self, callback: Callable[[Any], Any]) -> None:
        self._on_set.insert(0, callback)


def _node_class(world: World) -> type:
    class Node(_Parameters):
        def __init__(self, node_name: str, **_: object) -> None:
            super().__init__()
            self._group_of_node = Group()
            self._node_name = node_name

        @property
        def default_callback_group(self) -> Group:
            return self._group_of_node

        def get_name(self) -> str:
            return self._node_name

        def create_publisher(self, msg_type: type, topic: str, qos_profile: object) -> Publisher:
            return Publisher(world, msg_type, topic)

        def create_subscription(
            self,
            msg_type: type,
            topic: str,
            callback: Callable[[Any], Any],
            qos_profile: object,
            *,
            callback_group: Group | None = None,
        ) -> Reader:
            group = callback_group or self._group_of_node
            reader = Reader(self, group, callback, _depth(qos_profile))
            world.readers.setdefault(topic, []).append(reader)
            return reader

        def destroy_subscription(self, reader: Reader) -> None:
            for readers in world.readers.values():
                if reader in readers:
                    readers.remove(reader)

        def create_timer(
            self,
            timer_period_sec: float,
            callback: Callable[[], Any],
            callback_group: Group | None = None,
            clock: object = None,
        ) -> Timer:
            group = callback_group or self._group_of_node
            return Timer(world, self, group, timer_period_sec, callback)

        def destroy_timer(self, timer: Timer) -> None:
            timer.cancel()

        def create_service(
            self, srv_type: Any, srv_name: str, callback: Callable[[Any, Any], Any], **_: object
        ) -> object:
            def serve(request: Any, answered: Future) -> None:
                async def answer() -> None:
                    response = callback(request, srv_type.Response())
                    answered.set_result(await response if _waits(response) else response)

                world.at(world.now, self, self._group_of_node, answer)

            world.services[srv_name] = serve
            return SimpleNamespace()

        def create_client(
            self, srv_type: Any, srv_name: str, *, callback_group: Group | None = None
        ) -> Client:
            return Client(world, self, callback_group or self._group_of_node, srv_name)

        def create_rate(self, frequency: float) -> SimpleNamespace:
            return SimpleNamespace(sleep=lambda: world.sleep(1 / frequency))

        def get_clock(self) -> SimpleNamespace:
            return _clock(world)

        def get_logger(self) -> SimpleNamespace:
            levels = ("debug", "info", "warn", "warning", "error", "fatal")
            return SimpleNamespace(**{level: lambda *a, **k: None for level in levels})

        def destroy_node(self) -> None:
            pass

    return Node


def _waits(value: object) -> bool:
    return hasattr(value, "__await__")


# --- times and executors ------------------------------------------------------------------------


class Duration:
    """A span of time."""

    def __init__(self, *, seconds: float = 0, nanoseconds: int = 0) -> None:
        self.nanoseconds = int(seconds * NANOSECONDS) + nanoseconds

    def __lt__(self, other: Duration) -> bool:
        return self.nanoseconds < other.nanoseconds

    def __gt__(self, other: Duration) -> bool:
        return self.nanoseconds > other.nanoseconds

    def __ge__(self, other: Duration) -> bool:
        return self.nanoseconds >= other.nanoseconds


class Time(Duration):
    """A moment of the clock."""

    def __sub__(self, other: Time) -> Duration:
        return Duration(nanoseconds=self.nanoseconds - other.nanoseconds)

    def seconds_nanoseconds(self) -> tuple[int, int]:
        return divmod(self.nanoseconds, NANOSECONDS)


def _clock(world: World) -> SimpleNamespace:
    return SimpleNamespace(
        now=lambda: Time(nanoseconds=world.now),
        sleep_for=lambda span: world.sleep(span.nanoseconds / NANOSECONDS),
    )


def _executor(world: World, parallel: bool) -> type:
    class Executor:
        def __init__(self, num_threads: int | None = None) -> None:
            self._nodes: list[object] = []

        def add_node(self, node: object) -> None:
            self._nodes.append(node)

        def remove_node(self, node: object) -> None:
            self._nodes.remove(node)

        def shutdown(self) -> None:
            world.is_shut_down = True

        def spin(self) -> None:
            world.serve(self._nodes, END, lambda: False, parallel)

        def spin_once(self, timeout_sec: float | None = None) -> None:
            served = iter((False,))
            until = _until(world, timeout_sec)
            world.serve(self._nodes, until, lambda: next(served, True), parallel)

        def spin_until_future_complete(
            self, future: Future, timeout_sec: float | None = None
        ) -> None:
            world.serve(self._nodes, _until(world, timeout_sec), future.done, parallel)

    return Executor


def _until(world: World, seconds: float | None) -> int:
    if seconds is None or seconds < 0:
        return END
    return world.now + round(seconds * NANOSECONDS)


def _group_class(reentrant: bool) -> type:
    class CallbackGroup(Group):
        def __init__(self) -> None:
            super().__init__(reentrant)

    return CallbackGroup


def _modules(world: World) -> dict[str, ModuleType]:
    node, single, parallel = _node_class(world), _executor(world, False), _executor(world, True)

    def global_executor(nodes: object) -> Any:
        made = single()
        made.add_node(nodes)
        return made

    def stop(*_: object, **__: object) -> None:
        world.is_shut_down = True

    library: dict[str, Any] = {
        "init": lambda *a, **k: None,
        "ok": world.ok,
        "shutdown": stop,
        "try_shutdown": stop,
        "create_node": node,
        "spin": lambda n, executor=None: global_executor(n).spin(),
        "spin_once": lambda n, timeout_sec=None: global_executor(n).spin_once(timeout_sec),
        "spin_until_future_complete": lambda n, future, timeout_sec=None: global_executor(
            n
        ).spin_until_future_complete(future, timeout_sec),
    }
    kinds = SimpleNamespace(INTEGER=2, DOUBLE=3, BOOL=1, STRING=4)
    parameter = type("Parameter", (), {"Type": kinds, "__new__": lambda c, *a, **k: _parameter(*a)})
    ended = type("ExternalShutdownException", (Exception,), {})
    rclpy = dict(
        [
            module("rclpy", **library),
            module("rclpy.node", Node=node),
            module(
                "rclpy.executors",
                SingleThreadedExecutor=single,
                MultiThreadedExecutor=parallel,
                ExternalShutdownException=ended,
            ),
            module(
                "rclpy.callback_groups",
                ReentrantCallbackGroup=_group_class(True),
                MutuallyExclusiveCallbackGroup=_group_class(False),
            ),
            module("rclpy.qos", QoSProfile=SimpleNamespace),
            module("rclpy.parameter", Parameter=parameter),
            module("rclpy.duration", Duration=Duration),
            module("rclpy.time", Time=Time),
            module("rclpy.task", Future=partial(Future, world)),
        ]
    )
    for name, made in rclpy.items():
        if name != "rclpy":
            setattr(rclpy["rclpy"], name.rpartition(".")[2], made)
    return {**rclpy, **message_modules()}
