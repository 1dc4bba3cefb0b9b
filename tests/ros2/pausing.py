"""What a robot with a life cycle does while it is inactive, and again, in whatever language."""

from __future__ import annotations

from itertools import pairwise

import pytest

from tests.ros1.recording import Recording

MODEL = """
@Robot reactiveclass Robot(10) {
  knownrebecs { Ticker ticker; }
  statevars { int n; }
  Robot() { self.go() after(1); }
  msgsrv go() { @Move(X+1, Y); delay(4); n = n + 1; ticker.moved(n); self.go() after(2); }
  msgsrv hint(int by) { n = n + by; }
}
reactiveclass Ticker(5) {
  knownrebecs { Robot robot; }
  statevars { int heard; }
  Ticker() { self.tick() after(2); }
  msgsrv tick() { robot.hint(10) deadline(3); self.tick() after(2); }
  msgsrv moved(int n) { heard = n; }
}
main { Robot r(t):(); Ticker t(r):(); }
"""

# The robot is inactive when time 0 comes, in the first second, and until after 2.
BY_HAND = {"autostart": "false"}
BEFORE_TIME_0 = {
    "r": list(
        zip((0.1, 0.2, 0.3, 3.3), ("configure", "activate", "deactivate", "activate"), strict=True)
    ),
    "t": [(0.1, "configure"), (1.0, "activate")],
}


def test_an_inactive_robot_stands_and_then_drives_what_is_left(paused: Recording) -> None:
    velocities = paused.velocities("r")
    stop = next(v for v in velocities if v.stamp > 2 and v.x == 0)
    assert stop.stamp == pytest.approx(3.5, abs=0.2)
    assert {v.x for v in velocities if stop.stamp <= v.stamp < 8.2} == {0}
    again = [v for v in velocities if 8.4 < v.stamp < 10.9]
    assert max(v.x for v in again) <= 0.2501  # no faster than planned
    travelled = sum(
        v.x * (after.stamp - v.stamp) for v, after in pairwise(velocities) if v.stamp < 11.5
    )
    assert travelled == pytest.approx(1, abs=0.02)


def test_the_body_goes_on_as_much_later(paused: Recording) -> None:
    first = next(b for b in paused.bodies("r") if b.server == "go")
    assert (first.start, first.now) == (1, 11)
    (report,) = paused.reports("inactive")
    assert (report.rebec, report.server) == ("r", "lifecycle")
    assert report.facts == "from 3 to 9, waiting 4"


def test_messages_wait_and_what_is_too_late_is_told(paused: Recording) -> None:
    """Five hints came while the first body ran, the last two in time."""
    missed = [r.facts for r in paused.reports("deadline") if r.rebec == "r"]
    assert missed == [f"arrival {t}, deadline {t + 3}, now 11" for t in (2, 4, 6)]
    hints = [(b.arrival, b.start) for b in paused.bodies("r") if b.server == "hint"]
    assert hints[:2] == [(8, 11), (10, 11)]


def test_the_other_one_goes_on(paused: Recording) -> None:
    ticks = [b.start for b in paused.bodies("t") if b.server == "tick"]
    assert ticks == list(range(2, 2 * len(ticks) + 1, 2))
    assert len(ticks) > 8


def check_what_waits_since_before_time_0(recording: Recording) -> None:
    """A rebec that was inactive when time 0 came has lost nothing: its messages wait."""
    assert not recording.reports("restarted")
    assert [r.facts for r in recording.reports("inactive")] == ["from 0 to 3, waiting 2"]
    served = [(b.server, b.arrival, b.start) for b in recording.bodies("r")]
    assert served[:2] == [("hint", 2, 3), ("go", 4, 4)]
