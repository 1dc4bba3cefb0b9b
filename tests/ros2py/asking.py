"""Clients of services and actions in the world of the tests, and what of rclpy answers them."""

from __future__ import annotations

import threading
from collections.abc import Callable, Coroutine, Generator
from enum import Enum
from inspect import iscoroutine
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any, Protocol

from tests.ros2.asking import Answer, Ask
from tests.ros2py.messages import Message, plain

if TYPE_CHECKING:
    from tests.ros2py.world import Node, World

_Fields = dict[str, object]


class Tasks(Protocol):
    """Who does one thing after the other."""

    def create_task(self, act: Callable[..., object], *arguments: object) -> None: ...


class Executor:
    """What runs the callbacks of a node, some of which wait for others."""

    def __init__(self, node: Node) -> None:
        self._node = node

    def create_task(self, act: Callable[..., object], *arguments: object) -> None:
        def run() -> None:
            act(*arguments)

        self._node.queue.put(run)

    def wake(self) -> None:
        """Nothing sleeps that a queue would not wake."""

    def run(self, made: object, then: Callable[[Any], object]) -> None:
        """Goes on with what a callback gave, which may be a coroutine, and with its result."""
        if not iscoroutine(made):
            then(made)
            return
        self._go_on(made, then)

    def _go_on(self, made: Coroutine[Future, None, Any], then: Callable[[Any], object]) -> None:
        try:
            awaited = made.send(None)
        except StopIteration as end:
            self.create_task(then, end.value)
            return
        awaited.then(lambda: self.create_task(self._go_on, made, then))


class Future:
    """What a callback of a node awaits."""

    def __init__(self, *, executor: Tasks) -> None:
        assert executor is not None, "nobody runs the node"
        self._lock = threading.Lock()
        self._done = False
        self._result: Any = None
        self._then: list[Callable[[], None]] = []

    def set_result(self, result: object) -> None:
        with self._lock:
            assert not self._done, "a future has one result"
            self._result, self._done = result, True
        for act in self._then:
            act()

    def then(self, act: Callable[[], None]) -> None:
        with self._lock:
            if not self._done:
                self._then.append(act)
                return
        act()

    def __await__(self) -> Generator[Future, None, Any]:
        while not self._done:
            yield self
        return self._result


def _executor(node: Node) -> Executor:
    assert node.executor is not None, "nobody runs the node"
    return node.executor


class Service:
    """A service of a node."""

    def __init__(self, node: Node, type_: Any, name: str, callback: Callable[..., Any]) -> None:  # noqa: ANN401
        self.node, self.type, self.name = node, type_, name
        self._callback = callback
        self.alive = True

    def ask(self, ask: Ask, answer: Callable[[str, _Fields], None]) -> None:
        """Calls the service, whose response is a state of its own."""

        def respond(response: Message) -> None:
            assert self.alive, f"{self.name} is destroyed and cannot respond"
            answer("response", plain(response))

        def call() -> None:
            if self.alive:
                made = self._callback(self.type.Request(**ask.values), self.type.Response())
                _executor(self.node).run(made, respond)

        self.node.queue.put(call)

    def destroy(self) -> None:
        self.alive = False


class GoalResponse(Enum):
    REJECT = 1
    ACCEPT = 2


class CancelResponse(Enum):
    REJECT = 1
    ACCEPT = 2


class Handle:
    """A goal that was accepted."""

    def __init__(self, request: Message, tell: Callable[[str, _Fields], None]) -> None:
        self.request = request
        self.state = "executing"
        self.is_cancel_requested = False
        self._tell = tell

    def publish_feedback(self, feedback: Message) -> None:
        assert self.state == "executing", self.state
        self._tell("feedback", plain(feedback))

    def succeed(self) -> None:
        self._end("succeeded")

    def abort(self) -> None:
        self._end("aborted")

    def canceled(self) -> None:
        assert self.is_cancel_requested
        self._end("canceled")

    def _end(self, state: str) -> None:
        assert self.state == "executing", f"{state} after {self.state}"
        self.state = state


class ActionServer:
    """An action of a node."""

    def __init__(
        self,
        node: Node,
        type_: Any,  # noqa: ANN401
        name: str,
        execute: Callable[[Handle], Any],
        *,
        goal_callback: Callable[[Message], GoalResponse],
        cancel_callback: Callable[[Handle], CancelResponse],
        callback_group: object,
    ) -> None:
        self.node = node
        self.type, self.name = type_, node.launched.resolved(name)
        self._execute, self._accept, self._cancel = execute, goal_callback, cancel_callback
        self.alive = True
        self._goals: list[Handle] = []
        node.world.offers.append(self)

    def ask(self, ask: Ask, answer: Callable[[str, _Fields], None]) -> None:
        """Sends a goal; an ask without values cancels what is executed."""

        def act() -> None:
            if ask.cancels:
                self._cancel_all(answer)
            else:
                self._send(ask, answer)

        self.node.queue.put(act)

    def _send(self, ask: Ask, answer: Callable[[str, _Fields], None]) -> None:
        if not self.alive:
            return
        goal = self.type.Goal(**ask.values)
        if self._accept(goal) is GoalResponse.REJECT:
            answer("rejected", {})
            return
        answer("accepted", {})
        handle = Handle(goal, answer)
        self._goals.append(handle)

        def end(result: Message) -> None:
            assert self.alive, f"{self.name} is destroyed and cannot say how goals end"
            assert handle.state != "executing", "a goal ended without a state"
            answer(handle.state, plain(result))

        _executor(self.node).run(self._execute(handle), end)

    def _cancel_all(self, answer: Callable[[str, _Fields], None]) -> None:
        for handle in [g for g in self._goals if g.state == "executing"]:
            accepted = self._cancel(handle) is CancelResponse.ACCEPT
            handle.is_cancel_requested = accepted
            answer("cancelling" if accepted else "not cancelled", {})

    def destroy(self) -> None:
        self.alive = False


Offer = Service | ActionServer


def client(world: World, ask: Ask, answers: list[Answer]) -> Callable[[], None]:
    """What asks at its time, and keeps what comes of it."""

    def answer(state: str, fields: _Fields) -> None:
        answers.append(
            Answer(ask.name, ask.values, round(world.seconds() - world.zero, 3), state, fields)
        )

    def act() -> None:
        offered = [o for o in world.offers if o.name == ask.name and o.alive]
        if offered:
            offered[-1].ask(ask, answer)
        else:
            answer("nobody", {})

    return act


def modules() -> list[tuple[str, ModuleType]]:
    """What of rclpy is for services and actions."""
    contents: dict[str, dict[str, object]] = {
        "rclpy.action": {
            "ActionServer": ActionServer,
            "CancelResponse": CancelResponse,
            "GoalResponse": GoalResponse,
        },
        "rclpy.callback_groups": {"ReentrantCallbackGroup": SimpleNamespace},
        "rclpy.service": {"Service": Service},
        "rclpy.task": {"Future": Future},
    }
    found = []
    for name, content in contents.items():
        module = ModuleType(name)
        vars(module).update(content)
        found.append((name, module))
    return found
