"""What messages on topics took, as lines of text and as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rebsync.calibration.report import numbers_of, statistics_json, table
from rebsync.calibration.times import Statistics
from rebsync.conform.conformance import TopicInterval

_HEADS = ("node", "callback", "kind", "topic", "count", "least", "median", "99 %", "greatest")
_TEXTS = range(4)


def interval_lines(intervals: Sequence[TopicInterval]) -> Iterator[str]:
    """The table of what was measured."""
    yield "times in seconds, by the stamps of the recording"
    yield from table([_HEADS, *(_row(each) for each in intervals)], _TEXTS)


def _row(each: TopicInterval) -> tuple[str, ...]:
    shown = Statistics.of(each.seconds)
    assert shown is not None  # an interval that was not measured is none
    numbers = (f"{value:.3f}" for value in numbers_of(shown))
    return (each.rebec, each.server, each.kind, each.topic, str(shown.count), *numbers)


def intervals_json(intervals: Sequence[TopicInterval]) -> dict[str, Any]:
    """The same for other programs."""
    return {
        "topics": [
            {
                "rebec": each.rebec,
                "server": each.server,
                "kind": each.kind,
                "topic": each.topic,
                "measured": statistics_json(Statistics.of(each.seconds)),
            }
            for each in intervals
        ]
    }
