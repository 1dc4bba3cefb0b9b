"""The bounds of a verification, looked at while it thinks about what its search has found."""

from __future__ import annotations

import time
from dataclasses import field, replace

from rebsync.checker.exploration import Limits, Progress, Report
from rebsync.checker.look import Stopped
from rebsync.checker.memory import used_memory
from rebsync.records import dataclass

_SLICE = 0.05  # seconds between two looks at the bounds


@dataclass(slots=True)
class Watch:
    """Bounds and progress; calling it raises Stopped when a bound is reached.

    `started` is the moment by time.perf_counter from which seconds count. `progress` has the
    figures of the search that is over; what is being done now is its `task`.
    """

    limits: Limits
    report: Report | None
    started: float
    progress: Progress
    _due: float = field(default=0.0)

    def __call__(self) -> None:
        now = time.perf_counter()
        if now < self._due:
            return
        self._due = now + _SLICE
        seconds, memory = now - self.started, used_memory()
        if self.report:
            self.report(replace(self.progress, seconds=seconds, memory=memory))
        if over := self.limits.out_of_time(seconds):
            raise Stopped(over)
        self._check(memory)

    def begin(self, task: str, size: int = 0) -> None:
        """From now on the task is this one, which takes so many bytes at once.

        Raises Stopped when a bound is reached, or would be with them.
        """
        self.progress = replace(self.progress, task=task)
        self._check(used_memory() + size)
        self._due = 0.0
        self()

    def _check(self, memory: int) -> None:
        if over := self.limits.out_of_memory(memory):
            raise Stopped(over)
