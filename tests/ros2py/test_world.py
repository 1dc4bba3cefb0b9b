"""The stand-in for ROS 2 in one process: when its clock may move on."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable, Iterator
from functools import partial

import pytest

from tests.ros2py.world import NANOSECONDS, Launched, Node, World

_LATE = 0.2  # s of the real clock


@pytest.fixture
def starter() -> Iterator[Callable[[Callable[[], object]], None]]:
    """What runs a call a little later in a thread that has been there before."""
    calls: queue.Queue[Callable[[], object] | None] = queue.Queue()

    def run() -> None:
        while (call := calls.get()) is not None:
            threading.Event().wait(_LATE)
            call()

    thread = threading.Thread(target=run)
    thread.start()
    yield calls.put
    calls.put(None)
    thread.join()


def test_no_time_goes_by_while_a_thread_starts(
    starter: Callable[[Callable[[], object]], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a busy machine a thread that was told to start does not run at once."""
    name = next(n for n in ("_start_joinable_thread", "_start_new_thread") if hasattr(threading, n))
    start = getattr(threading, name)
    world = World()
    moments: list[int] = []

    def main() -> None:
        node = Node(world, world.context.launched)
        world.add(node)
        node.create_timer(0.01, lambda: None)
        node.create_timer(0.5, make)
        world.spin(node)

    def make() -> None:
        if moments:
            return
        before = world.time
        with monkeypatch.context() as patch:
            patch.setattr(
                threading, name, lambda *args, **named: starter(partial(start, *args, **named))
            )
            threading.Thread(target=lambda: None).start()
        moments.append(world.time - before)

    world.run([(Launched("a"), main)], 1.0)
    assert moments == [0]
    assert world.time >= NANOSECONDS


def test_no_thread_of_a_node_is_left_over() -> None:
    world = World()
    goes_on, ended = threading.Event(), threading.Event()

    def work() -> None:
        goes_on.wait()
        time.sleep(_LATE)
        ended.set()

    def main() -> None:
        node = Node(world, world.context.launched)
        world.add(node)
        threading.Thread(target=work, daemon=True).start()
        world.spin(node)
        goes_on.set()

    world.run([(Launched("a"), main)], 0.1)
    assert ended.is_set()
