"""The mailbox on a real roscore: order, times, capacity, violations."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.ros1.probes import Rebec, play
from tests.ros1.recording import Recording
from tests.ros1.run import Clock
from tests.ros1.workspace import Workspace

START = ("send self plain 0",)
SHORT = Clock(until=20, quiet=3)


def notes(recording: Recording, rebec: str) -> list[int]:
    """What a rebec's scripts noted."""
    return list(recording.final(rebec)["notes"])


def test_order_is_arrival_then_priority_then_receipt(probe: Workspace, tmp_path: Path) -> None:
    sends = (
        *("send b plain 1 after 5", "send b plain 2 after 3", "send b low 3 after 3"),
        *("send b high 4 after 3", "send b plain 5 after 3", "send b low 6 after 3"),
        "send b high 7 after 4",
    )
    rebecs = {"a": Rebec(constructor=START, plain=sends), "b": Rebec()}
    recording = play(probe, tmp_path, rebecs)
    assert recording.order("b") == [
        *("high(4)@3", "low(3)@3", "low(6)@3", "plain(2)@3", "plain(5)@3", "high(7)@4"),
        "plain(1)@5",
    ]
    for body in recording.bodies("b"):
        assert body.start <= body.stamp < body.start + 0.5
    assert recording.problems() == ()


def test_what_is_sent_at_once_is_ordered_as_if_it_came_at_once(
    probe: Workspace, tmp_path: Path
) -> None:
    sends = ("send b plain 1", "send b low 2", "send b high 3", "delay 1") * 3
    rebecs = {"a": Rebec(constructor=START, plain=sends), "b": Rebec()}
    recording = play(probe, tmp_path, rebecs, SHORT, {"mailbox/settle": 0.3})
    assert recording.order("b") == [
        f"{call}@{time}" for time in range(3) for call in ("high(3)", "low(2)", "plain(1)")
    ]


def test_the_next_message_is_chosen_when_the_rebec_is_free(
    probe: Workspace, tmp_path: Path
) -> None:
    rebecs = {
        "a": Rebec(constructor=START, plain=("delay 1", "send b low 1", "delay 1", "send b low 2")),
        "b": Rebec(constructor=START, plain=("delay 5",)),
        "c": Rebec(constructor=START, plain=("delay 2", "send b high 3", "send b plain 4")),
    }
    recording = play(probe, tmp_path, rebecs)
    order = ["plain(0)@0", "low(1)@5", "high(3)@5", "low(2)@5", "plain(4)@5"]
    assert recording.order("b") == [*order[:4], "plain(4)@5"]
    assert [b.now for b in recording.bodies("b")] == [5, 5, 5, 5, 10]
    assert [b.state["waiting"] for b in recording.bodies("b")] == [0, 4, 3, 3, 3]


def test_a_delay_keeps_the_rebec_busy(probe: Workspace, tmp_path: Path) -> None:
    sends = ("send b plain 1", "send b high 2 after 1")
    rebecs = {
        "a": Rebec(constructor=START, plain=sends),
        "b": Rebec(plain=("delay 2", "now", "delay 0", "delay 3", "now"), high=("now",)),
    }
    recording = play(probe, tmp_path, rebecs)
    assert recording.order("b") == ["plain(1)@0", "high(2)@5"]
    assert notes(recording, "b") == [2, 5, 5]
    assert recording.bodies("b")[0].stamp >= 5


def test_a_message_after_its_deadline_is_dropped_and_reported(
    probe: Workspace, tmp_path: Path
) -> None:
    sends = (
        *("delay 1", "send b high 1 deadline 3", "send b high 2 deadline 4"),
        *("send b high 3 after 1 deadline 1", "send b low 4 after 6 deadline 5"),
        "send b low 5 after 7 deadline 7",
    )
    rebecs = {
        "a": Rebec(constructor=START, plain=sends),
        "b": Rebec(constructor=START, plain=("delay 5",)),
    }
    recording = play(probe, tmp_path, rebecs)
    assert recording.order("b") == ["plain(0)@0", "high(2)@5", "low(5)@8"]
    assert [b.state["expiry"] for b in recording.bodies("b")] == [2**31 - 1, 5, 8]
    assert [(r.server, r.facts) for r in recording.reports("deadline")] == [
        ("high", "arrival 1, deadline 4, now 5"),
        ("high", "arrival 2, deadline 2, now 5"),
        ("low", "arrival 7, deadline 6, now 7"),
    ]
    assert len(recording.problems()) == 3


def test_the_newest_beyond_the_capacity_is_dropped_and_reported(
    probe: Workspace, tmp_path: Path
) -> None:
    sends = (
        *("delay 1", "send b plain 1", "send b plain 2 after 8", "send b plain 3"),
        *("delay 5", "send b plain 4", "send b plain 5"),
    )
    busy = ("delay 4",)
    rebecs = {
        "a": Rebec(constructor=START, plain=sends),
        "b": Rebec(constructor=START, plain=busy, capacity=3),
    }
    recording = play(probe, tmp_path, rebecs)
    # At 1: one in service, one waiting, one that arrives at 9. At 6: the same again.
    assert recording.order("b") == ["plain(0)@0", "plain(1)@4", "plain(4)@8", "plain(2)@12"]
    assert [r.facts for r in recording.reports("overflow")] == [
        "capacity 3, arrival 1",
        "capacity 3, arrival 6",
    ]


def test_a_rebec_that_sends_to_itself_still_holds_its_place(
    probe: Workspace, tmp_path: Path
) -> None:
    rebecs = {"a": Rebec(constructor=START, plain=("send self plain 1 after 1",), capacity=1)}
    recording = play(probe, tmp_path, rebecs, SHORT)
    assert recording.order("a") == ["plain(0)@0"]
    assert [r.kind for r in recording.reports()] == ["overflow"]


def test_a_robot_stands_that_no_longer_sends_to_itself(probe: Workspace, tmp_path: Path) -> None:
    """What was dropped would have sent the next one: nobody else begins that again."""
    rebecs = {
        "a": Rebec(
            constructor=START,
            plain=("move 1 0", "delay 2", "send self plain 0 after 1"),
            low=("move 1 0", "delay 1"),
            capacity=3,
        ),
        "b": Rebec(
            constructor=("send self plain 0 after 4", "send self low 0 after 13"),
            plain=("send a low 1", "send a low 2", "send a low 3"),
            low=("send a low 4",),
        ),
    }
    clock = Clock(until=30, quiet=12, rate=10)
    recording = play(probe, tmp_path, rebecs, clock, {"mailbox/heartbeat": 0.25})
    served = ["plain(0)@0", "plain(0)@3", "low(1)@5", "low(2)@6", "low(4)@13"]
    assert recording.order("a") == served
    assert [r.facts for r in recording.reports("overflow")] == [
        "capacity 3, arrival 4",
        "capacity 3, arrival 6, sent to itself, which ends here",
    ]
    velocities = recording.velocities("a")
    assert any(v.x != 0 for v in velocities)
    assert {v.x for v in velocities if v.stamp > 4.9} == {0}
    told = [s for m in recording.heard("/diagnostics") for s in m.fields["status"]]
    *_, last = [s for s in told if s["hardware_id"] == "a"]
    assert last["level"] in (2, b"\x02")  # rclpy has bytes of one
    assert last["message"] == "ended plain"


def test_the_sender_is_known_and_answered(probe: Workspace, tmp_path: Path) -> None:
    ask = Rebec(constructor=START, plain=("send b low 1",))
    rebecs = {"a": ask, "b": Rebec(low=("is_script", "send sender high 7")), "c": ask}
    recording = play(probe, tmp_path, rebecs)
    assert sorted(b.state["sender"] for b in recording.bodies("b")) == ["a", "c"]
    for name in ("a", "c"):
        assert recording.order(name) == ["plain(0)@0", "high(7)@0"]
        assert recording.final(name)["sender"] == "b"
    assert recording.bodies("a")[0].state["sender"] == "a"
    assert notes(recording, "b") == [1, 1]


def test_a_constructor_sends_to_itself_and_moves_on_in_time(
    probe: Workspace, tmp_path: Path
) -> None:
    rebecs = {
        "a": Rebec(constructor=START, plain=("send b plain 1",)),
        "b": Rebec(constructor=("delay 3", "send self high 2 after 1", "send a low 3")),
    }
    recording = play(probe, tmp_path, rebecs)
    assert recording.order("b") == ["plain(1)@3", "high(2)@4"]
    assert recording.order("a") == ["plain(0)@0", "low(3)@3"]
    assert [b.stamp >= 3 for b in recording.bodies("b")] == [True, True]


def test_a_violation_is_reported_and_serving_goes_on(probe: Workspace, tmp_path: Path) -> None:
    go = ("send self plain 0", "send self low 0 after 1", "send self high 0 after 2")
    rebecs = {
        "a": Rebec(
            constructor=(*go, "index 2"),
            plain=("divide 7 2", "divide 1 0", "now"),
            low=("index 1", "index 2", "now"),
            high=("now",),
        ),
        "b": Rebec(
            constructor=go,
            plain=("send a plain 9 after -1", "now"),
            low=("delay -2", "now"),
            high=("now",),
        ),
        "c": Rebec(
            constructor=go,
            plain=("send nobody plain 0", "now"),
            low=("throw", "now"),
            high=("assert 0", "now", "assert 1"),
        ),
    }
    recording = play(probe, tmp_path, rebecs)
    # rospy tells those that come late of a report before the start, roscpp does not.
    reports = [r for r in recording.reports() if r.server != "constructor"]
    found = sorted((r.rebec, r.kind, r.server) for r in reports)
    assert found == [
        *(("a", "division", "plain"), ("a", "index", "low")),
        *(("b", "time", "low"), ("b", "time", "plain")),
        *(("c", "assertion", "high"), ("c", "exception", "low"), ("c", "null", "plain")),
    ]
    assert "index: a.constructor" in recording.output
    assert [notes(recording, name) for name in "abc"] == [[3, 2], [2], [2]]


def test_choices_come_from_the_seed_and_the_name(probe: Workspace, tmp_path: Path) -> None:
    script = Rebec(constructor=START, plain=("choose",) * 60)
    rebecs = {"a": script, "b": script}
    drawn = []
    for index, seed in enumerate((1, 1, 2)):
        directory = tmp_path / str(index)
        directory.mkdir()
        recording = play(probe, directory, rebecs, SHORT, {"mailbox/seed": seed})
        drawn.append((notes(recording, "a"), notes(recording, "b")))
    first, again, other = drawn
    assert set(first[0]) == set(range(1, 8))
    assert first == again
    assert first[0] != first[1]
    assert first[0] != other[0]


def test_a_sensor_keeps_the_latest_message(probe: Workspace, tmp_path: Path) -> None:
    sends = ("delay 2", "send c plain 5", "delay 2", "send c plain 9")
    rebecs = {
        "a": Rebec(constructor=START, plain=sends),
        "b": Rebec(
            constructor=tuple(f"send self low 0 after {t}" for t in (1, 3, 5)),
            low=("sense",),
            hears="c/plain",
        ),
        "c": Rebec(),
    }
    recording = play(probe, tmp_path, rebecs)
    seen = notes(recording, "b")
    assert seen[0::2] == [-1, 5, 9]
    assert seen[1] in (4, 5) and seen[3] == 5 and seen[5] in (4, 5)
    assert [r.facts for r in recording.reports("choice")] == ["9 is outside the choices"]
    # The first look may come before the first sample: that is no fault.
    assert not any("sensor: nothing" in line for line in recording.problems())


def test_a_sensor_that_hears_nothing_is_reported_once(probe: Workspace, tmp_path: Path) -> None:
    looks = tuple(f"send self low 0 after {t}" for t in (1, 2, 3, 4))
    rebecs = {"a": Rebec(constructor=looks, low=("sense", "sense"), hears="ghost/plain")}
    recording = play(probe, tmp_path, rebecs, Clock(until=6))
    said = [line for line in recording.log if line.text == "sensor: nothing on /ghost/plain"]
    assert len(said) == 1
    assert said[0].stamp > 1.5


def test_lateness_beyond_the_slack_is_reported(probe: Workspace, tmp_path: Path) -> None:
    rebecs = {"a": Rebec(constructor=START, plain=("delay 1", "send self plain 0"))}
    clock = Clock(until=6)
    recording = play(probe, tmp_path, rebecs, clock, {"mailbox/slack": -0.5})
    assert len(recording.bodies("a")) > 3
    # Once a minute is enough.
    assert [(r.kind, r.server) for r in recording.reports()] == [("late", "plain")]


def test_what_comes_from_outside_is_not_late_between_two_times(
    probe: Workspace, tmp_path: Path
) -> None:
    """Its arrival is rounded down: what counts is how long it has waited."""
    rebecs = {
        "a": Rebec(constructor=("send self plain 0 after 1",), plain=("send b plain 1",)),
        "b": Rebec(plain=("raw c high 7",)),
        "c": Rebec(),
    }
    # b waits for something more urgent, and is late.
    recording = play(probe, tmp_path, rebecs, Clock(until=4, quiet=3), {"mailbox/settle": 0.7})
    (served,) = recording.bodies("c")
    assert (served.server, served.start) == ("high", 1)
    assert served.stamp > 1.6
    assert [(r.kind, r.rebec) for r in recording.reports()] == [("late", "b")]


def test_a_time_unit_stretches_the_model(probe: Workspace, tmp_path: Path) -> None:
    rebecs = {"a": Rebec(constructor=START, plain=("delay 10", "send self low 1 after 10"))}
    recording = play(probe, tmp_path, rebecs, SHORT, {"mailbox/time_unit": 0.1})
    first, second = recording.bodies("a")
    assert (first.now, second.start) == (10, 20)
    assert 1 <= first.stamp < 1.5 and 2 <= second.stamp < 2.5


def test_no_state_is_published_where_nobody_wants_it(probe: Workspace, tmp_path: Path) -> None:
    rebecs = {
        "a": Rebec(constructor=START, plain=("delay 1", "send b plain 1")),
        "b": Rebec(plain=("send a high 2 after 1",)),
    }
    recording = play(probe, tmp_path, rebecs, SHORT, {"mailbox/publish_state": False})
    assert recording.served == ()
    sent = [m.fields for m in recording.messages if "timing" in m.fields]
    assert [fields["timing"]["arrival"] for fields in sent] == [1, 2]
    assert recording.problems() == ()


def test_the_real_clock_serves_as_well(probe: Workspace, tmp_path: Path) -> None:
    rebecs = {
        "a": Rebec(constructor=START, plain=("delay 1", "send b plain 1", "send b high 2 after 1")),
        "b": Rebec(constructor=("send self low 3 after 1",), low=("delay 1",)),
    }
    recording = play(probe, tmp_path, rebecs, Clock(until=4, rate=None))
    assert sorted(recording.order("b")) == ["high(2)@2", "low(3)@1", "plain(1)@2"]
    for body in recording.bodies("b"):
        assert body.now <= body.stamp < body.now + 0.5
    assert recording.problems() == ()


@pytest.fixture(scope="module")
def values(probe: Workspace) -> dict[str, str]:
    """The expressions that values_check computes."""
    command = [probe.executable("probe", "values_check")]
    environment = probe.environment()
    out = subprocess.run(
        command, check=True, capture_output=True, text=True, env=environment
    ).stdout
    return dict(line.split(" = ", 1) for line in out.splitlines())


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("7 / -2", "-3"),
        ("7 % -2", "1"),
        ("-7 % 2", "-1"),
        ("min / -1", "-2147483648"),
        ("min % -1", "0"),
        ("byte -128 / -1", "128"),
        ("short 9 % 4", "1"),
        ("7.0 / 2", "3.5"),
        ("7.5 % 2", "1.5"),
        ("1.0 / 0", "inf"),
        ("byte 200", "-56"),
        ("short 40000", "-25536"),
        ("byte -128 /= -1", "-128"),
        ("short 1000 %= 300", "100"),
        ("flatten", "[true, false, false, true]"),
        ("unflatten", "[[true, false], [false, true]]"),
        ("1 / 0", "division 1 / 0"),
        ("1 % 0", "division 1 % 0"),
        ("after(-1)", "time after -1"),
        ("after(2).deadline(5) at 3", "5, 8"),
        ("no deadline", "true"),
        ("text", "1, true, -3, 0.1, [true, false], [[1, 2]], r"),
    ],
)
def test_values(values: dict[str, str], expression: str, value: str) -> None:
    assert values[expression] == value
