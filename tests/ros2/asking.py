"""What clients of services and actions ask in a run without a ROS 2, and what they were told."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Ask:
    """A request, a goal, or the wish to cancel all goals, so many seconds after the beginning."""

    at: float
    name: str
    values: Mapping[str, object] = field(default_factory=dict)
    cancels: bool = False


@dataclass(frozen=True, slots=True)
class Answer:
    """What a client was told, and when, in seconds of the model's clock."""

    name: str
    asked: Mapping[str, object]
    at: float
    state: str  # response; accepted, rejected, feedback, succeeded, aborted, not cancelled
    fields: Mapping[str, object]
