"""Rebecs that die, come back, hang, or are told something by others, on a real roscore."""

from __future__ import annotations

import re
from pathlib import Path

from tests.ros1.probes import Rebec, play
from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros1.workspace import Workspace

_QUICK = {"mailbox/heartbeat": 0.25}


def facts(recording: Recording, rebec: str) -> list[str]:
    """What a rebec reported of the others."""
    return [r.facts for r in recording.reports("startup") if r.rebec == rebec]


def statuses(recording: Recording, rebec: str) -> list[tuple[int, str]]:
    """The levels and messages of a rebec's diagnostics."""
    found = [s for m in recording.heard("/diagnostics") for s in m.fields["status"]]
    assert all(s["name"] == f"{s['hardware_id']}: mailbox" for s in found)
    return [(s["level"], s["message"]) for s in found if s["hardware_id"] == rebec]


def test_what_no_rebec_sent_is_stamped_when_it_comes(probe: Workspace, tmp_path: Path) -> None:
    rebecs = {
        "a": Rebec(
            constructor=("raw b low 5", "send self plain 0 after 3"), plain=("raw b plain 7",)
        ),
        "b": Rebec(plain=("now",), low=("now",)),
    }
    recording = play(probe, tmp_path, rebecs, Clock(until=9, quiet=4))
    # What the constructor says at once comes before time 0, if the other listens by then.
    order = [served for served in recording.order("b") if served != "low(5)@0"]
    # A step of the clock may reach one node before the other: it is then served a step late.
    assert order in (["plain(7)@3"], ["plain(7)@2"])
    assert recording.bodies("b")[-1].state["expiry"] == 2**31 - 1
    arrival = order[0][-1]
    late = [p for p in recording.problems() if f"late: b.plain (arrival {arrival}, 1.0" in p]
    assert recording.problems() == (tuple(late) if arrival == "2" else ())


def test_a_rebec_that_comes_back_keeps_the_common_time(probe: Workspace, tmp_path: Path) -> None:
    tick = ("send b low 1", "send self plain 0 after 1")
    rebecs = {
        "a": Rebec(constructor=("send self plain 0 after 1",), plain=tick),
        "b": Rebec(constructor=("send self high 0 after 4",), high=("kill",), respawn=True, wait=3),
    }
    clock = Clock(until=24, quiet=20, rate=2)
    recording = play(probe, tmp_path, rebecs, clock, {**_QUICK, "mailbox/capacity": 100})
    said = [r.facts for r in recording.reports("restarted") if r.rebec == "b"]
    found = [re.fullmatch(r"serves from (\d+) on, what came before is lost", s) for s in said]
    begins = [int(match[1]) for match in found if match is not None]
    assert len(begins) == len(said) > 0
    begin = begins[0]
    assert begin > 5
    after = [b for b in recording.bodies("b") if b.start > 4]
    assert after
    assert min(b.start for b in after) >= begin
    for body in after:
        assert body.start <= body.stamp < body.start + 0.7
    # Its constructor ran again: what it sent to itself counts from there.
    constructed = [s for s in recording.served if s.rebec == "b" and s.server == "constructor"]
    assert {(s.arrival, s.start, s.now) for s in constructed} <= {(t, t, t) for t in (0, *begins)}
    assert facts(recording, "a")[:3] == ["lost b", "back b", "restarted b"]
    assert (2, "lost b") in statuses(recording, "a")
    # The one that stayed serves on, in time.
    assert [b.start for b in recording.bodies("a")] == list(
        range(1, len(recording.bodies("a")) + 1)
    )


def test_a_body_that_hangs_is_reported_once(probe: Workspace, tmp_path: Path) -> None:
    rebecs = {
        "a": Rebec(constructor=("send self plain 0 after 1",), plain=("hang 9", "now")),
        "b": Rebec(constructor=("send self plain 0 after 1",), plain=("delay 8",)),
    }
    recording = play(probe, tmp_path, rebecs, Clock(until=13, rate=None), _QUICK)
    stalls = [(r.rebec, r.server, r.facts) for r in recording.reports("stall")]
    assert stalls == [("a", "plain", "runs for 5 s")]
    assert (2, "stall in plain") in statuses(recording, "a")
    assert {message for _, message in statuses(recording, "b")} <= {"waits for the start", "serves"}
    assert recording.order("a") == ["plain(0)@1"]  # it went on
    assert facts(recording, "b") == []  # it was there all the time
