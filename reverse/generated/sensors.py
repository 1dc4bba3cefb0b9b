"""What sensors decide: a choice of the model that the code leaves to what a sensor saw."""

from __future__ import annotations

import re

from rebsync import model as m
from rebsync.names import original
from rebsync.reverse.findings import Findings, Unread
from rebsync.source import Source

# The number tells it from a sensor of a class above.
_MEMBER = r"\b_?(\w+?)_sensor_?(?:_\d+)?"
_NAMED = re.compile(rf"{_MEMBER}\Z")
_SEEN = re.compile(rf"{_MEMBER}\s*\.\s*seen\s*\(")
_WHY = "the sensor does not decide this any more"
_HINT = "hand over what it saw: `..._sensor.seen(...)`"


def sensor_of(member: str) -> str | None:
    """The server whose sensor a member is, by its name; None where it is no sensor's."""
    found = _NAMED.search(member)
    return original(found[1]) if found else None


def list_unseen(body: m.Block, within: str, source: Source, findings: Findings) -> None:
    """Lists what the body of a server with a sensor, `Class.server`, chooses without asking it."""
    server = original(within.rpartition(".")[2])
    for choice in m.walk(body):
        if isinstance(choice, m.Choice):
            asked = {original(name) for name in _SEEN.findall(source.slice(choice.span))}
            if server not in asked:
                findings.unreadable(source, Unread(choice.span, _WHY, _HINT), within)
