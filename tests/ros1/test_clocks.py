"""Rebecs on machines whose clocks are apart, on a real roscore: each with a clock of its own."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.ros1.probes import Rebec, play
from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros1.workspace import Workspace

_CLOCK = Clock(until=24, quiet=20, rate=3)
_OPTIONS = {"mailbox/heartbeat": 0.25, "mailbox/slack": 0.3}
_MOMENTS = range(2, 13)


def _system(offset: float) -> dict[str, Rebec]:
    """Two rebecs send to a third one, at even and at odd times; the clock of one is off."""

    def sends(times: range, value: int) -> tuple[str, ...]:
        pauses = ("delay 2",) * len(times)
        return tuple(line for p in pauses for line in (f"send b plain {value}", p))

    even, odd = sends(_MOMENTS[::2], 0), sends(_MOMENTS[1::2], 1)
    return {
        "a": Rebec(constructor=("send self plain 0 after 2",), plain=even, offset=offset),
        "c": Rebec(constructor=("send self plain 0 after 3",), plain=odd),
        "b": Rebec(),
    }


def _offset(recording: Recording, rebec: str) -> float:
    """What a rebec's diagnostics said last of the clocks of the others."""
    found = [s for m in recording.heard("/diagnostics") for s in m.fields["status"]]
    values = [s["values"] for s in found if s["hardware_id"] == rebec]
    return float({v["key"]: v["value"] for v in values[-1]}["clock offset"])


def _lateness(recording: Recording) -> float:
    """How late the third rebec took what the one with the other clock sent."""
    zero_bodies = [b for b in recording.bodies("b") if b.arguments == "0"]
    return max(b.stamp - b.arrival for b in zero_bodies)


@pytest.mark.parametrize("offset", [-0.6, 0.6])
def test_clocks_that_are_less_apart_than_moments_keep_the_order(
    probe: Workspace, tmp_path: Path, offset: float
) -> None:
    recording = play(probe, tmp_path, _system(offset), _CLOCK, _OPTIONS)
    assert [b.arrival for b in recording.bodies("b")] == list(_MOMENTS)
    assert _offset(recording, "b") == pytest.approx(0.6, abs=0.15)
    late = {r.rebec for r in recording.reports("late")}
    print("offset", offset, "late", sorted(late), "by", _lateness(recording))
    # What comes from a clock that is behind comes late; what comes early waits.
    assert ("b" in late) == (offset < 0)


def test_clocks_that_are_further_apart_than_moments_are_told(
    probe: Workspace, tmp_path: Path
) -> None:
    recording = play(probe, tmp_path, _system(-1.6), _CLOCK, _OPTIONS)
    order = [b.arrival for b in recording.bodies("b")]
    assert sorted(order) == list(_MOMENTS)
    assert order != sorted(order)
    status = [s for m in recording.heard("/diagnostics") for s in m.fields["status"]]
    assert "clocks differ" in {s["message"] for s in status if s["hardware_id"] == "c"}
    assert "b" in {r.rebec for r in recording.reports("late")}
