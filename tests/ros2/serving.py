"""What clients of services and actions are told, in whatever language, without a ROS 2."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Protocol

import pytest

from tests.ros1.recording import Recording
from tests.ros2.asking import Answer, Ask

MODEL = Path(__file__).parents[1] / "ros1" / "models" / "services.rebeca"
_GO, _LATER, _NEVER = "/robot/port/go", "/robot/later", "/robot/never"
_TRAVEL, _CONTROL = "/robot/travel", "/control_bridge/control/ask"
_NOTHING = {"answered": False, "place": 0, "fast": False}


class Serve(Protocol):
    """Runs the package, with a life cycle where there are changes of it, and asks."""

    def __call__(
        self,
        asks: Sequence[Ask],
        until: float,
        changes: Mapping[str, Sequence[tuple[float, str]]] | None = None,
        ends: Mapping[str, float] | None = None,
    ) -> tuple[Recording, tuple[Answer, ...]]: ...


def _told(answers: Sequence[Answer], name: str) -> list[tuple[str, object]]:
    """The states of what was asked there, with what was asked."""
    return [(a.state, a.asked.get("to")) for a in answers if a.name == name]


def _clean(recording: Recording) -> None:
    assert not [line for line in recording.log if "null: " in line.text], recording.output
    assert "Traceback" not in recording.output


def test_replies_are_responses(serve: Serve) -> None:
    asks = [
        Ask(4, _CONTROL),
        *(Ask(5, _LATER, {"n": n}) for n in (3, 4)),
        Ask(12, _GO, {"to": 5, "fast": True}),
        *(Ask(20, _NEVER, {"n": n}) for n in (9, -9)),
    ]
    recording, answers = serve(asks, 40)
    assert {a.state for a in answers} == {"response"}
    assert [dict(a.fields) for a in answers if a.name == _CONTROL] == [
        {"answered": True, "seen": 0}
    ]
    (go,) = [a for a in answers if a.name == _GO]
    assert dict(go.fields) == {"answered": True, "place": 5, "fast": True}
    assert go.at == pytest.approx(13, abs=0.2)
    # One variable keeps one client: the first of two that ask at once gets no answer.
    later = [a for a in answers if a.name == _LATER]
    assert [(a.asked["n"], a.fields["answered"]) for a in later] == [(4, True), (3, False)]
    assert later[0].at == pytest.approx(7, abs=0.2)
    assert later[1].at == pytest.approx(15, abs=0.3)  # the time-out
    never = {a.asked["n"]: a for a in answers if a.name == _NEVER}
    assert dict(never[-9].fields) == {"answered": True, "place": -9, "fast": True}
    assert never[-9].at == pytest.approx(20, abs=0.2)
    assert dict(never[9].fields) == _NOTHING
    assert never[9].at == pytest.approx(30, abs=0.3)
    _clean(recording)


def test_who_finds_no_room_is_told_at_once(serve: Serve) -> None:
    asks = [Ask(10, _GO, {"to": to, "fast": True}) for to in range(8)]
    recording, answers = serve(asks, 30)
    late = [a for a in answers if a.fields["answered"]]
    assert [a.asked["to"] for a in late] == list(range(6))
    refused = [a for a in answers if not a.fields["answered"]]
    assert [a.asked["to"] for a in refused] == [6, 7]
    assert all(a.at < 10.3 for a in refused)
    assert len(recording.reports("overflow")) == 2
    _clean(recording)


def test_goals_are_messages(serve: Serve) -> None:
    asks = [
        Ask(5, _TRAVEL, {"to": 5}),
        *(Ask(10, _TRAVEL, {"to": to}) for to in range(10, 20)),
        Ask(10.5, _TRAVEL, cancels=True),
    ]
    recording, answers = serve(asks, 30)
    first = [a for a in answers if a.asked.get("to") == 5]
    assert [(a.state, dict(a.fields)) for a in first] == [
        ("accepted", {}),
        ("feedback", {"place": 1}),
        ("succeeded", {"place": 5, "fast": True}),
    ]
    assert first[2].at == pytest.approx(6, abs=0.2)
    # One is served, five wait: there is no room for more.
    told = _told(answers, _TRAVEL)
    accepted = [to for state, to in told if state == "accepted" and to != 5]
    assert accepted == list(range(10, 16))
    assert [to for state, to in told if state == "rejected"] == list(range(16, 20))
    ends = [(a.state, a.at) for a in answers if a.asked.get("to") in accepted]
    assert [at for state, at in ends if state == "succeeded"] == pytest.approx(
        [11, 12, 13, 14, 15, 16], abs=0.2
    )
    assert [s for s, _ in told if s.endswith("cancelled")] == ["not cancelled"] * 6
    _clean(recording)


def test_what_is_open_when_a_node_ends_is_answered(serve: Serve) -> None:
    asks = [
        Ask(5, _TRAVEL, {"to": -1}),  # never
        Ask(7, _NEVER, {"n": 9}),
        Ask(7.5, _TRAVEL, {"to": 8}),  # it is being served
        Ask(7.6, _TRAVEL, {"to": 9}),  # it waits
    ]
    recording, answers = serve(asks, 12, ends={"robot": 7.9})
    ends = [(a.state, a.asked["to"]) for a in answers if a.name == _TRAVEL]
    assert sorted(e for e in ends if e[0] == "aborted") == [("aborted", to) for to in (-1, 8, 9)]
    (never,) = (a for a in answers if a.name == _NEVER)
    assert dict(never.fields) == _NOTHING
    assert all(a.at < 8.1 for a in answers)
    (told,) = (line.text for line in recording.log if line.text.startswith("service: "))
    assert told.endswith(" before the end of the node)")
    _clean(recording)


def test_what_is_asked_of_an_inactive_rebec_waits(serve: Serve) -> None:
    asks = [
        Ask(5, _TRAVEL, {"to": 5}),  # in the middle of it the node is deactivated
        Ask(6, _TRAVEL, {"to": 6}),
        Ask(7, _GO, {"to": 7, "fast": True}),
        *(Ask(8, _TRAVEL, {"to": to}) for to in (8, 9, 10, 11)),
        Ask(20, _NEVER, {"n": -1}),
    ]
    pauses = [(5.5, "deactivate"), (9.5, "activate"), (19, "deactivate"), (35, "activate")]
    recording, answers = serve(asks, 45, {"robot": pauses})
    told = [(a.state, a.asked.get("to"), a.at) for a in answers if a.name == _TRAVEL]
    assert [to for s, to, _ in told if s == "accepted"] == [5, 6, 8, 9, 10]
    assert [(to, at < 8.2) for s, to, at in told if s == "rejected"] == [(11, True)]
    assert not [s for s, _, at in told if 5.6 < at < 9.3 and s not in ("accepted", "rejected")]
    ends = [(to, at) for s, to, at in told if s == "succeeded"]
    assert [to for to, _ in ends] == [5, 6, 8, 9, 10]
    assert ends[0][1] > 9.3
    (go,) = (a for a in answers if a.name == _GO)
    assert go.fields["answered"] is True
    assert go.at > 10
    # A request waits no longer than its time-out, be the node active or not.
    (never,) = (a for a in answers if a.name == _NEVER)
    assert dict(never.fields) == _NOTHING
    assert never.at == pytest.approx(30, abs=0.3)
    _clean(recording)


def test_what_is_open_at_cleanup_is_answered(serve: Serve) -> None:
    asks = [
        Ask(5, _TRAVEL, {"to": -1}),
        Ask(6, _NEVER, {"n": 9}),
        Ask(9, _TRAVEL, {"to": 9}),
        Ask(14, _TRAVEL, {"to": 14}),
    ]
    names = ("deactivate", "cleanup", "configure", "activate")
    recording, answers = serve(asks, 25, {"robot": list(zip((7, 8, 10, 11), names, strict=True))})
    states = [(a.state, a.asked.get("to")) for a in answers if a.state != "feedback"]
    assert states == [
        ("accepted", -1),
        *sorted([("aborted", -1), ("response", None)], key=states.index),
        ("nobody", 9),
        ("accepted", 14),
        ("succeeded", 14),
    ]
    (never,) = (a for a in answers if a.name == _NEVER)
    assert dict(never.fields) == _NOTHING
    assert never.at == pytest.approx(8, abs=0.2)
    _clean(recording)
