"""Recordings that nobody here made (public/) are read to their ends, message by message."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rebsync.conform.bags import OwnTypes, events_2
from rebsync.conform.recording import Place, Sent, Truncated
from rebsync.conform.topics import Topic

PUBLIC = Path(__file__).parent / "public"


class _All:
    """Takes all topics, and keeps the fields of messages as they are."""

    def __init__(self) -> None:
        self.kept: list[dict[str, Any]] = []

    def topic(self, name: str, path: str) -> Topic:
        def convert(fields: Any, stamp: float, place: Place, node: str) -> Sent:  # noqa: ANN401
            self.kept.append({name: fields[name] for name in fields})
            return Sent(0, name, "", None, None, stamp, place, node)

        return Topic(name, "", convert)


@pytest.mark.parametrize("ending", [".mcap", ".db3"])
def test_a_public_recording_is_read(ending: str) -> None:
    wanted = _All()
    path = str(PUBLIC / f"talker{ending}")
    found = list(events_2(path, 0, wanted, OwnTypes("", {})))
    assert not any(isinstance(event, Truncated) for event in found)
    names = [event.server for event in found if isinstance(event, Sent)]
    assert {name: names.count(name) for name in names} == {"/topic": 10, "/rosout": 10}
    said = [each["data"] for each in wanted.kept if "data" in each]
    assert said == [f"Hello, world! {n}" for n in range(10)]
    stamps = [event.stamp for event in found]
    assert stamps == sorted(stamps)
