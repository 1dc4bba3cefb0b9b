"""Plays generated packages of ROS 2 in Python in one process, and records what happens."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from importlib import import_module, invalidate_caches
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import cast
from unittest.mock import patch

from rebsync.forward.runtime_package import NAME
from tests.ros1.recording import Heard, Logged, Recording, Served
from tests.ros2.asking import Answer, Ask
from tests.ros2.launching import Launched as Described
from tests.ros2.launching import launched as described
from tests.ros2py.asking import client
from tests.ros2py.asking import modules as asking
from tests.ros2py.messages import Message, modules
from tests.ros2py.quality import modules as qualities
from tests.ros2py.world import Launched, Node, World

# From which state to which a change leads; empty: from any.
_TRANSITIONS = {
    "configure": ("unconfigured", "inactive"),
    "activate": ("inactive", "active"),
    "deactivate": ("active", "inactive"),
    "cleanup": ("inactive", "unconfigured"),
    "shutdown": ("", "finalized"),
}
_CLOCKS = SimpleNamespace(STEADY_TIME="steady")
_BODY = ("server", "arguments", "arrival", "start", "now")


def play(
    folder: Path,
    until: float,
    changes: Mapping[str, Sequence[tuple[float, str]]] | None = None,
    arguments: Mapping[str, str] | None = None,
    beside: Sequence[str] = (),
) -> Recording:
    """Start what the launch file of a package says, and run it to a time of the model.

    The `changes` of the life cycles of nodes come after so many seconds; the `arguments` are those
    of the launch file. What other launch files `beside` it start, comes first.
    """
    return play_asked(folder, until, (), changes, arguments=arguments, beside=beside)[0]


def play_asked(
    folder: Path,
    until: float,
    asks: Sequence[Ask],
    changes: Mapping[str, Sequence[tuple[float, str]]] | None = None,
    ends: Mapping[str, float] | None = None,
    arguments: Mapping[str, str] | None = None,
    beside: Sequence[str] = (),
) -> tuple[Recording, tuple[Answer, ...]]:
    """The same, with clients of services and actions; nodes that are interrupted have `ends`."""
    world, name = World(), folder.name
    answers: list[Answer] = []
    for ask in asks:
        world.act_at(ask.at, client(world, ask, answers))
    with installed(world, folder / name, folder / f"{name}_interfaces", folder.parent):
        found = [n for other in beside for n in described(folder / name, other)]
        found += described(folder / name, **(arguments or {}))
        mains = [_main(name, node, (changes or {}).get(node.name, ())) for node in found]
        with _interrupting(world, name, ends or {}):
            world.run(mains, until)
    return recorded(world), tuple(answers)


@contextmanager
def _interrupting(world: World, package: str, ends: Mapping[str, float]) -> Iterator[None]:
    """What programs do at SIGINT, they do at the time at which they end."""

    def interrupts(act: Callable[[], None]) -> None:
        launched = world.context.launched
        if launched.name not in ends:
            return

        def run() -> None:
            world.context.launched = launched
            act()

        thread = threading.Thread(target=run, daemon=True)
        world.act_at(ends[launched.name], thread.start)

    names = [f"{p}.{n}" for p in (package, NAME) for n in ("mailbox", "lifecycle")]
    with ExitStack() as stack:
        for module in filter(sys.modules.__contains__, names):
            stack.enter_context(patch(f"{module}.Interrupts", interrupts))
        yield


def recorded(world: World) -> Recording:
    """What happened in a world."""
    zero = world.zero
    heard = tuple(Heard(topic, stamp - zero, data) for topic, stamp, data in world.messages)
    log = tuple(Logged(node, level, stamp - zero, text) for node, level, stamp, text in world.log)
    output = "\n".join(line.text for line in log)
    served = tuple(_served(m) for m in heard if set(_BODY) <= set(m.fields))
    return Recording(served, heard, log, (), output)


def _served(message: Heard) -> Served:
    fields = message.fields
    state = {name: value for name, value in fields.items() if name not in _BODY}
    rebec = message.topic.strip("/").rsplit("/", 1)[0]
    server, arguments, arrival, start, now = (fields[name] for name in _BODY)
    return Served(rebec, server, arguments, arrival, start, now, message.stamp, state)


def _main(
    package: str, node: Described, changes: Sequence[tuple[float, str]]
) -> tuple[Launched, Callable[[], None]]:
    launched = Launched(node.name, node.parameters, dict(node.remappings), changes)
    main = import_module(f"{package}.{node.executable}").main
    return launched, cast("Callable[[], None]", main)


@contextmanager
def installed(
    world: World, source: Path, interfaces: Path, workspace: Path | None = None
) -> Iterator[None]:
    """The client library and all messages as modules, while the block runs.

    In a `workspace` the run-time part may be a package of its own.
    """
    before = set(sys.modules)
    shared = [] if workspace is None else [workspace / NAME, workspace / f"{NAME}_interfaces"]
    shared = [folder for folder in shared if folder.exists()]
    made = {**modules([interfaces, *shared[1:]]), **_rclpy(world)}
    World.stamp = made["builtin_interfaces.msg"].Time
    sys.modules.update(made)
    sources = [str(source), *map(str, shared[:1])]
    sys.path[:0] = sources
    invalidate_caches()
    try:
        yield
    finally:
        for path in sources:
            sys.path.remove(path)
        for added in set(sys.modules) - before:
            del sys.modules[added]


def _module(name: str, **content: object) -> tuple[str, ModuleType]:
    module = ModuleType(name)
    module.__dict__.update(content)
    module.__path__ = []
    return name, module


def _threshold(
    *, min_forward: object, min_backward: object, on_clock_change: bool = True
) -> SimpleNamespace:
    return SimpleNamespace(
        min_forward=min_forward, min_backward=min_backward, on_clock_change=on_clock_change
    )


def _rclpy(world: World) -> dict[str, ModuleType]:
    own = {"description": ("string", None), "read_only": ("bool", None)}
    descriptor = type("ParameterDescriptor", (Message,), {"_fields": own})
    answer = {"successful": ("bool", None), "reason": ("string", None)}
    result = type("SetParametersResult", (Message,), {"_fields": answer})

    class ExternalShutdownException(Exception):
        pass

    class NodeOfThread(Node):
        """The node of the thread that makes it: its name is what the launch file says."""

        def __init__(self, name: str) -> None:
            super().__init__(world, world.context.launched)
            world.add(self)

    class LifecycleNode(NodeOfThread):
        """The same with a life cycle, whose changes come when it was launched with them."""

        def __init__(self, name: str) -> None:
            super().__init__(name)
            self.state = "unconfigured"
            for seconds, change in self.launched.changes:
                self._set(seconds, change)

        def trigger_configure(self) -> None:
            self._trigger("configure")

        def trigger_activate(self) -> None:
            self._trigger("activate")

        def _set(self, seconds: float, change: str) -> None:
            def act() -> None:
                timer.cancel()
                self._trigger(change)

            timer = self.create_timer(seconds, act)

        def _trigger(self, change: str) -> None:
            before, after = _TRANSITIONS[change]
            if before not in ("", self.state):
                raise RuntimeError(f"no {change} of a node that is {self.state}")
            if getattr(self, f"on_{change}")(self.state) == "success":
                self.state = after

    lifecycle = {
        "LifecycleNode": LifecycleNode,
        "LifecycleState": str,
        "TransitionCallbackReturn": SimpleNamespace(SUCCESS="success", FAILURE="failure"),
    }

    spin = {"init": lambda: None, "spin": world.spin, "try_shutdown": world.shut_down}
    spin["ok"] = world.is_ok
    return dict(
        [
            _module("rclpy", **spin),
            _module("rclpy.executors", ExternalShutdownException=ExternalShutdownException),
            _module("rclpy.node", Node=NodeOfThread),
            _module("rclpy.lifecycle", **lifecycle),
            _module("rclpy.publisher", Publisher=object),
            _module("rclpy.subscription", Subscription=object),
            _module(
                "rclpy.clock", JumpThreshold=_threshold, Clock=SimpleNamespace, ClockType=_CLOCKS
            ),
            _module("rclpy.duration", Duration=SimpleNamespace),
            _module("rclpy.signals", uninstall_signal_handlers=lambda: None),
            *qualities(),
            *asking(),
            _module("rcl_interfaces"),
            _module(
                "rcl_interfaces.msg", ParameterDescriptor=descriptor, SetParametersResult=result
            ),
        ]
    )
