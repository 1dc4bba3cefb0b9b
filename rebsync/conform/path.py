"""The run of the model that fits, state by state, as far as it is known while a search goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeAlias

from rebsync.conform.graph import Node
from rebsync.conform.possible import Config

MOST = 500_000  # steps that may be open at a time

Visit: TypeAlias = Callable[[int, Node], None]
"""Is called with each state of the run, in order, and the time at which it is reached."""

_At: TypeAlias = tuple[int, Config]


class Path:
    """Remembers which possible state came from which, until only one is left: its past is the run.

    `is_lost`: there were too many for too long, and the run is not known from some step on.
    """

    def __init__(self, visit: Visit) -> None:
        self.visit = visit
        self._from: dict[_At, _At | None] = {}
        self._visited: _At | None = None
        self.is_lost = False

    def begin(self, time: int, configs: Iterable[Config]) -> None:
        """The possible states at the start."""
        for config in configs:
            self._from[time, config] = None

    def link(self, time: int, after: Iterable[Config], before: int, config: Config) -> None:
        """Steps from a possible state at a time to others."""
        for each in after:
            self._from.setdefault((time, each), (before, config))
        if len(self._from) > MOST:
            self._from.clear()
            self.is_lost = True

    def settle(self, time: int, config: Config) -> None:
        """Only this state is possible: visits all before it that were not visited yet, and it."""
        at: _At | None = (time, config)
        if self.is_lost or at not in self._from:
            return
        way: list[_At] = []
        while at is not None and at != self._visited:
            way.append(at)
            at = self._from[at]
        for when, each in reversed(way):
            self.visit(when, each.node)
        self._visited = (time, config)
        self._from = {self._visited: None}
