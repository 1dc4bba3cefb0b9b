"""Start and end of a system of rebecs on a real roscore."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.ros1.probes import Rebec, play
from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros1.workspace import Workspace

START = ("send self plain 0",)


def calls(recording: Recording, rebec: str) -> list[str]:
    """What a rebec served, in no order."""
    return sorted(f"{b.server}({b.arguments})" for b in recording.bodies(rebec))


def test_nothing_is_lost_however_late_nodes_start(probe: Workspace, tmp_path: Path) -> None:
    def rebec(peers: str, wait: float) -> Rebec:
        sends = [f"send {peer} low {n}" for peer in peers for n in range(20)]
        return Rebec(constructor=("send self plain 0", *sends), capacity=100, wait=wait)

    rebecs = {"a": rebec("bc", 1.5), "b": rebec("ac", 0), "c": rebec("ab", 3)}
    recording = play(probe, tmp_path, rebecs, Clock(until=20, quiet=3))
    expected = sorted(["plain(0)"] + [f"low({n})" for n in range(20)] * 2)
    for name in rebecs:
        assert calls(recording, name) == expected
        assert {b.start for b in recording.bodies(name)} == {0}
    assert recording.problems() == ()


def test_time_0_is_when_the_last_is_ready(probe: Workspace, tmp_path: Path) -> None:
    rebec = Rebec(constructor=("send self plain 0 after 1",), parameters={"peers": []})
    rebecs = {"a": replace(rebec, wait=2.0), "b": rebec}
    recording = play(probe, tmp_path, rebecs, Clock(until=3, rate=None))
    assert [1 <= recording.bodies(name)[0].stamp < 1.5 for name in rebecs] == [True, True]
    assert recording.problems() == ()


def test_a_missing_node_is_named(probe: Workspace, tmp_path: Path) -> None:
    rebecs = {
        "a": Rebec(constructor=("send self plain 0", "send ghost plain 1")),
        "spy": Rebec(hears="ghost/plain"),
    }
    clock = Clock(until=20, quiet=5, startup=3)
    options = {"mailbox/startup_timeout": 0.5, "mailbox/rebecs": ["a", "ghost"]}
    recording = play(probe, tmp_path, rebecs, clock, options, absent=("ghost",))
    facts = [r.facts for r in recording.reports("startup") if r.rebec == "a"]
    # The spy has subscribed to /ghost/plain, but it is no rebec that takes part.
    topics = [
        f"/{name}/{server}" for name in ("ghost", "spy") for server in ("high", "low", "plain")
    ]
    assert set(facts) == {f"no subscriber on {' '.join(topics)}"}
    assert len(facts) > 1
    assert recording.served == ()


def test_a_node_that_is_only_waited_for_is_named(probe: Workspace, tmp_path: Path) -> None:
    options = {"mailbox/startup_timeout": 0.5, "mailbox/rebecs": ["a", "ghost"]}
    clock = Clock(until=20, quiet=5, startup=3)
    recording = play(probe, tmp_path, {"a": Rebec(constructor=START)}, clock, options)
    facts = {r.facts for r in recording.reports("startup")}
    assert facts - {"waits for /clock"} == {"waits for ghost"}
    assert recording.served == ()


def test_a_rebec_without_a_list_runs_alone(probe: Workspace, tmp_path: Path) -> None:
    recording = play(
        *(probe, tmp_path, {"a": Rebec(constructor=START)}, Clock(until=9, quiet=2)),
        {"mailbox/rebecs": []},
    )
    assert recording.order("a") == ["plain(0)@0"]


def test_a_namespace_keeps_the_system_together(probe: Workspace, tmp_path: Path) -> None:
    rebecs = {"a": Rebec(constructor=START, plain=("send b plain 1",)), "b": Rebec()}
    recording = play(probe, tmp_path, rebecs, Clock(until=9, quiet=2), namespace="field")
    assert recording.order("field/b") == ["plain(1)@0"]
    assert recording.heard("/field/startup") != ()


def test_a_rebec_that_starts_again_is_named(probe: Workspace, tmp_path: Path) -> None:
    rebecs = {
        "a": Rebec(constructor=("send self plain 0 after 20",)),
        "b": Rebec(constructor=("send self plain 0 after 2",), plain=("quit",), respawn=True),
    }
    recording = play(probe, tmp_path, rebecs, Clock(until=12, quiet=12, rate=4))
    restarts = [r.facts for r in recording.reports("startup") if r.rebec == "a"]
    assert restarts[:1] == ["restarted b"]


@pytest.mark.parametrize("rate", [15.0, None], ids=["simulated clock", "real clock"])
def test_stopping_in_a_long_delay_is_quick_and_sends_nothing(
    probe: Workspace, tmp_path: Path, rate: float | None
) -> None:
    rebecs = {
        "a": Rebec(constructor=START, plain=("delay 1000", "send b plain 1", "delay 1000")),
        "b": Rebec(constructor=("send self low 0 after 500",), low=("send a low 1",)),
    }
    recording = play(probe, tmp_path, rebecs, Clock(until=3, rate=rate))
    assert recording.bodies("a") == recording.bodies("b") == ()
    late = {m.topic for m in recording.late if not m.topic.endswith("/cmd_vel")}
    # The zero velocity at the end goes out, and a heartbeat may be on its way.
    assert late <= {"/rosout", "/startup", "/diagnostics"}
    assert "escalating" not in recording.output
    assert recording.problems() == ()
