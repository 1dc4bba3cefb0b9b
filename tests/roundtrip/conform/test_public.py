"""Recordings that nobody here made (public/) are read to their ends, message by message."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rebsync.roundtrip.conform.bags import OwnTypes, events_2
from rebsync.roundtrip.conform.recording import Sent, Truncated

PUBLIC = Path(__file__).parent / "public"


class _Plain:
    """A topic of which the fields of messages are kept as they are."""

    def __init__(self, name: str, kept: list[dict[str, Any]]) -> None:
        self.name, self._kept = name, kept

    def convert(self, fields: Any, stamp: float, place: Any, node: str) -> Sent:  # noqa: ANN401
        self._kept.append({name: fields[name] for name in fields})
        return Sent(0, self.name, "", None, None, stamp, place, node)


class _All:
    """Takes all topics."""

    def __init__(self) -> None:
        self.kept: list[dict[str, Any]] = []

    def topic(self, name: str, path: str) -> _Plain:
        return _Plain(name, self.kept)


@pytest.mark.parametrize("ending", [".mcap", ".db3"])
def test_a_public_recording_is_read(ending: str) -> None:
    wanted: Any = _All()
    path = str(PUBLIC / f"talker{ending}")
    found = list(events_2(path, 0, wanted, OwnTypes("", {})))
    assert not any(isinstance(event, Truncated) for event in found)
    names = [event.server for event in found if isinstance(event, Sent)]
    assert {name: names.count(name) for name in names} == {"/topic": 10, "/rosout": 10}
    said = [each["data"] for each in wanted.kept if "data" in each]
    assert said == [f"Hello, world! {n}" for n in range(10)]
    stamps = [event.stamp for event in found]
    assert stamps == sorted(stamps)
