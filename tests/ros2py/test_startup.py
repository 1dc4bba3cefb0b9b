"""Start and end of systems of rclpy nodes, in one process."""

from __future__ import annotations

import threading
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any, cast

import pytest

from tests.ros1.probes import Player, Rebec, play
from tests.ros1.run import Clock
from tests.ros1.test_startup import (
    START,
    test_a_rebec_without_a_list_runs_alone,
    test_nothing_is_lost_however_late_nodes_start,
    test_stopping_in_a_long_delay_is_quick_and_sends_nothing,
    test_time_0_is_when_the_last_is_ready,
)
from tests.ros2py.playing import installed
from tests.ros2py.world import Launched, Node, World

# What is waited for in real time, restarts and namespaces need a real ROS.
__all__ = [
    "test_a_foreign_subscription_that_never_matches_is_not_waited_for",
    "test_a_rebec_without_a_list_runs_alone",
    "test_nobody_begins_before_all_know_of_one_another",
    "test_nothing_is_lost_however_late_nodes_start",
    "test_stopping_in_a_long_delay_is_quick_and_sends_nothing",
    "test_time_0_is_when_the_last_is_ready",
]


def test_a_program_that_is_interrupted_while_it_starts_ends_without_complaint(
    probe: Player,
) -> None:
    def interrupted() -> None:
        raise KeyboardInterrupt

    def broken() -> None:
        raise RuntimeError("of the user's code")

    folder = cast(Any, probe).folder
    with installed(World(), folder, folder / "probe_interfaces"):
        stoppable = import_module("probe.startup").stoppable
        stoppable(interrupted)()
        with pytest.raises(RuntimeError):
            stoppable(broken)()


def test_a_foreign_subscription_that_never_matches_is_not_waited_for(
    probe: Player, tmp_path: Path
) -> None:
    """The probe is a dataclass with the topics that a foreign node listens to."""
    listened = replace(cast(Any, probe), foreign=("/b/plain",))
    rebecs = {"a": Rebec(constructor=START, plain=("send b plain 1",)), "b": Rebec()}
    recording = play(listened, tmp_path, rebecs, Clock(until=9, quiet=2))
    assert recording.order("b") == ["plain(1)@0"]
    assert recording.reports() == ()


def test_nobody_begins_before_all_know_of_one_another(probe: Player, tmp_path: Path) -> None:
    """Who knows of all the others waits for one that does not yet: it could not serve."""
    slow = replace(cast(Any, probe), deaf=(("c", 1.0),))
    tick = Rebec(constructor=START, plain=("send c low 0", "send self plain 0 after 1"))
    rebecs = {"a": tick, "b": tick, "c": Rebec(capacity=4)}
    options = {"mailbox/time_unit": 0.1}
    recording = play(slow, tmp_path, rebecs, Clock(until=3, quiet=2), options)
    announced = [m for m in recording.heard("/startup") if m.fields["zero"]]
    first = {name: min(m.stamp for m in announced if m.fields["rebec"] == name) for name in rebecs}
    assert first["c"] - first["a"] == pytest.approx(1, abs=0.1)
    assert min(b.stamp for b in recording.served) >= first["c"]
    # Time 0 is not long ago then: nobody has to catch up.
    assert recording.reports() == ()
    assert recording.order("a")[:2] == ["plain(0)@0", "plain(0)@1"]
    assert all(b.stamp - b.now * 0.1 < 0.09 for b in recording.bodies("a"))


class _Held:
    """A publisher that holds its first message back while a later one may overtake it."""

    def __init__(self) -> None:
        self.sent: list[int] = []
        self.first, self.second = threading.Event(), threading.Event()

    def publish(self, message: Any) -> None:  # noqa: ANN401
        if self.first.is_set():
            self.second.set()
        else:
            self.first.set()
            self.second.wait(0.5)
        self.sent.append(message.zero)


def test_a_sign_of_life_does_not_arrive_after_a_later_one(probe: Player) -> None:
    """It would tell that time 0 is not known yet, and the others would wait again."""
    folder, world = cast(Any, probe).folder, World()
    with installed(world, folder, folder / "probe_interfaces"):
        node = Node(world, Launched("a"))
        startup = import_module("probe.startup").Startup(node)
        startup._announcement = held = _Held()
        startup._stamp = 1
        watchdog = threading.Thread(target=startup.beat)
        watchdog.start()
        held.first.wait()
        startup._zero = 7
        startup.beat()
        watchdog.join()
    assert held.sent == [0, 7]
