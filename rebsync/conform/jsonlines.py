"""Logs of JSON, one message a line: `{"topic": ..., "stamp": seconds, "data": {...}, "node": ...}`.

`node`, the publisher, may be left out. What has another topic, or none, is passed over.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rebsync.conform.recording import Event, Place, Truncated
from rebsync.conform.topic_filter import TopicChoice
from rebsync.diagnostics import RebsyncError
from rebsync.files import os_mistake
from rebsync.long_numbers import MOST_DIGITS

LONGEST = 2**24  # characters of a line


def events(path: str, file: int, wanted: TopicChoice) -> Iterator[Event]:
    """The events of a log, as its lines go. RebsyncError: it cannot be read as one."""
    latest = -math.inf
    try:
        with Path(path).open(encoding="utf-8") as lines:
            number = 0
            while line := lines.readline(LONGEST):
                number += 1
                place = Place(file, number)
                if number > 1 and not line.endswith("\n") and not _is_json(line):
                    why = f"{path} cannot be read after line {number - 1}: it ends within a line"
                    yield Truncated(why, latest, place)
                elif not line.isspace():
                    event = _event(line, place, path, wanted)
                    if event is not None:
                        latest = max(latest, event.stamp)
                        yield event
    except OSError as error:
        raise os_mistake(path, error) from None
    except UnicodeDecodeError as error:
        raise _wrong(path, 0, f"it is not UTF-8 text: {error.reason}") from None


def _is_json(line: str) -> bool:
    try:
        json.loads(line)
    except (ValueError, RecursionError):
        return False
    return True


def _event(line: str, place: Place, path: str, wanted: TopicChoice) -> Event | None:
    message = _parsed(line, path, place.number)
    name = message.get("topic")
    topic = wanted.topic(name, path) if isinstance(name, str) and name else None
    if topic is None:
        return None
    stamp, data, node = message.get("stamp"), message.get("data"), message.get("node", "")
    if not isinstance(stamp, (int, float)) or isinstance(stamp, bool) or not math.isfinite(stamp):
        raise _wrong(path, place.number, "`stamp` is no number of seconds")
    if not isinstance(data, dict):
        raise _wrong(path, place.number, "`data` is no object with the fields of the message")
    try:
        return topic.convert(data, float(stamp), place, str(node))
    except KeyError as error:
        what = f"a message on {name} has no field {error}"
    except (TypeError, ValueError, AttributeError) as error:
        what = f"a field of a message on {name} has another type: {error}"
    raise RebsyncError.of(
        path, "RS983", f"line {place.number}: {what}", "is it a recording of this model?"
    )


def _parsed(line: str, path: str, number: int) -> dict[str, Any]:
    try:
        value = json.loads(line)
    except json.JSONDecodeError as error:
        raise _wrong(path, number, f"this is no JSON: {error.msg}") from None
    except RecursionError:
        raise _wrong(path, number, "this nests deeper than rebsync reads") from None
    except ValueError:
        raise _wrong(path, number, f"a number has more than {MOST_DIGITS} digits") from None
    if not isinstance(value, dict):
        raise _wrong(path, number, "this is no JSON object")
    return value


def _wrong(path: str, line: int, what: str) -> RebsyncError:
    place = f"line {line}: " if line else ""
    hint = 'a log has one message a line: {"topic": ..., "stamp": ..., "data": {...}}'
    return RebsyncError.of(path, "RS982", f"{place}{what}", hint)
