"""The exit status of every command, in one place."""

from __future__ import annotations

from collections.abc import Iterable
from enum import IntEnum

from rebsync.diagnostics import Findings, Severity


class Status(IntEnum):
    """What a command found; INTERRUPTED and BROKEN_PIPE are the shell's own conventions."""

    CLEAN = 0
    FINDINGS = 1
    UNUSABLE = 2
    VIOLATED = 3
    UNDETERMINED = 4
    INTERRUPTED = 130
    BROKEN_PIPE = 141


# What the verdict of a model checker is.
STATUS_OF = {
    "satisfied": Status.CLEAN,
    "violated": Status.VIOLATED,
    "undetermined": Status.UNDETERMINED,
}
_FIRST = (Status.UNUSABLE, Status.VIOLATED, Status.UNDETERMINED, Status.FINDINGS)


def worst(statuses: Iterable[Status]) -> Status:
    """Of several outcomes the one that the exit status tells."""
    seen = set(statuses)
    return next((status for status in _FIRST if status in seen), Status.CLEAN)


def status_of(findings: Iterable[Findings]) -> Status:
    """FINDINGS for errors and warnings; notes alone leave it CLEAN."""
    for each in findings:
        if any(d.severity is not Severity.NOTE for d in each.diagnostics):
            return Status.FINDINGS
    return Status.CLEAN
