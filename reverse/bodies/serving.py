"""What a name stands for through which messages are served."""

from __future__ import annotations

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Serves:
    """A subscription or service: its messages are served as long as the code keeps it."""
