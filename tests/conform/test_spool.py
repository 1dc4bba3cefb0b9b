"""Messages of a long recording lie in a file: they are those of a list, and few are in memory."""

from __future__ import annotations

from pathlib import Path
from random import Random
from weakref import WeakSet

import pytest

from rebsync.cli.recorded_topics import TopicBounds
from rebsync.conform.components import spool
from rebsync.conform.components.spool import Spool
from tests.conform.test_topics import FAULTS, of, real


class Thing:
    """What can be counted while it is in memory."""


@pytest.mark.parametrize("count", [0, 1, 7, 8, 9, 16, 100])
def test_a_spool_is_as_a_list(count: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spool, "BLOCK", 8)
    expected = [(n, str(n)) for n in range(count)]
    found = Spool(expected)
    assert list(found) == expected
    assert len(found) == count
    random = Random(count)
    for _ in range(200 if count else 0):
        at, to = random.randrange(-count, count), random.randrange(-count, count)
        assert found[at] == expected[at]
        assert found[at:to] == expected[at:to]
    for outside in (count, -count - 1, 1000):
        with pytest.raises(IndexError):
            found[outside]


def test_few_blocks_are_in_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spool, "BLOCK", 8)
    things: WeakSet[Thing] = WeakSet()
    found = Spool[Thing]()
    for _ in range(1000):
        thing = Thing()
        things.add(thing)
        found.append(thing)
        assert len(things) <= 9
    things.update(found)
    assert len(things) <= 6 * 8


@pytest.mark.parametrize("fault", FAULTS)
def test_what_is_said_does_not_depend_on_blocks(
    fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    log = real()
    own = [n for n, message in enumerate(log) if message["topic"] == "/power"]
    logs = log, FAULTS[fault][0](log, own[len(own) // 3])
    measuring = TopicBounds(None, True, None, True)
    expected = [of("thermostat", each, tmp_path, measuring) for each in logs]
    monkeypatch.setattr(spool, "BLOCK", 4)
    assert [of("thermostat", each, tmp_path, measuring) for each in logs] == expected
