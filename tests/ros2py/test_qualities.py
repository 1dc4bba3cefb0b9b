"""Qualities of service that parameters override, in one process."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.ros1.probes import Player, Rebec, play
from tests.ros1.run import Clock
from tests.ros1.test_mailbox import notes
from tests.ros2py.quality import InvalidQosOverridesError

_CLOCK = Clock(until=6)
_SYSTEM = {
    "a": Rebec(constructor=("send self plain 0 after 1",), plain=("send c plain 5",)),
    "b": Rebec(constructor=("send self low 0 after 3",), low=("sense",), hears="c/plain"),
    "c": Rebec(),
}


@pytest.mark.parametrize(("durability", "seen"), [("volatile", 5), ("transient_local", -1)])
def test_parameters_say_what_a_sensor_asks_for(
    probe: Player, tmp_path: Path, durability: str, seen: int
) -> None:
    parameters = {"qos_overrides./c/plain.subscription.durability": durability}
    # The server of c has the parameter as well, but does not let it say so.
    assert notes(play(probe, tmp_path, _SYSTEM, _CLOCK, parameters), "b")[0] == seen


@pytest.mark.parametrize(
    ("policy", "value"),
    [("depth", 10), ("reliability", "best_effort"), ("history", "system_default")],
)
@pytest.mark.parametrize("entity", ["publisher", "subscription"])
def test_no_message_of_the_model_may_be_lost(
    probe: Player, tmp_path: Path, policy: str, value: object, entity: str
) -> None:
    parameters = {f"qos_overrides./c/plain.{entity}.{policy}": value}
    rebecs = {"a": Rebec(), "c": Rebec()}
    with pytest.raises(InvalidQosOverridesError, match="carries messages of the model"):
        play(probe, tmp_path, rebecs, _CLOCK, parameters)


def test_more_may_be_kept(probe: Player, tmp_path: Path) -> None:
    names = [f"qos_overrides./c/plain.{entity}" for entity in ("publisher", "subscription")]
    parameters = {f"{name}.history": "keep_all" for name in names}
    recording = play(probe, tmp_path, _SYSTEM, _CLOCK, parameters)
    assert [b.server for b in recording.bodies("c")] == ["plain"]
