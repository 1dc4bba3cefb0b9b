"""What each rebec has served, in its order, read ahead from a recording as far as is needed."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence

from rebsync.conform.recording import Event, Served, Truncated

AHEAD = 20_000  # observations that are read ahead for one of a rebec that is silent

Positions = tuple[int, ...]


class Stream:
    """The observations of each rebec, by numbers; those that nobody asks for again are dropped.

    What is no observation goes to `others` when it is read; so does each observation.
    """

    def __init__(
        self, events: Iterator[Event], rebecs: int, others: Callable[[Event], None]
    ) -> None:
        self._events = events
        self._others = others
        self._queues: list[deque[Served]] = [deque() for _ in range(rebecs)]
        self._dropped = [0] * rebecs
        self._waiting = 0
        self.read = 0
        self.ended = False
        self.horizon = -1  # the greatest model time that was observed
        self.truncated: Truncated | None = None

    def get(self, rebec: int, position: int) -> Served | None:
        """An observation of a rebec by its number; None when none is near, or the end was reached.

        Which of the two says `ended`.
        """
        queue = self._queues[rebec]
        index = position - self._dropped[rebec]
        while index >= len(queue):
            if self.ended or self._waiting >= AHEAD:
                return None
            self._pull()
        return queue[index]

    def at_hand(self, rebec: int, position: int) -> Served | None:
        """The same without reading on."""
        queue, index = self._queues[rebec], position - self._dropped[rebec]
        return queue[index] if 0 <= index < len(queue) else None

    def has_more(self, count: int) -> bool:
        """Whether there are more observations than so many; reads on until that is known."""
        while self.read <= count and not self.ended:
            self._pull()
        return self.read > count

    def first(self, rebec: int) -> int:
        """The number of the first observation of a rebec that is at hand."""
        return self._dropped[rebec]

    def _pull(self) -> None:
        event = next(self._events, None)
        if event is None:
            self.ended = True
            return
        self._see(event)
        if isinstance(event, Served):
            self.read += 1
            self._waiting += 1
            self._queues[event.rebec].append(event)
            self.horizon = max(self.horizon, event.now)

    def _see(self, event: Event) -> None:
        self._others(event)
        if isinstance(event, Truncated):
            self.truncated = event

    def read_to_end(self) -> None:
        """Reads all that is left, keeping only what is at hand (for statistics of the rest)."""
        while (event := next(self._events, None)) is not None:
            self._see(event)
            if isinstance(event, Served):
                self.read += 1
                self.horizon = max(self.horizon, event.now)
        self.ended = True

    def drop_before(self, positions: Sequence[int]) -> list[Served]:
        """Lets go of the observations before these numbers, and gives them."""
        gone: list[Served] = []
        for rebec, position in enumerate(positions):
            queue = self._queues[rebec]
            for _ in range(position - self._dropped[rebec]):
                gone.append(queue.popleft())
            self._dropped[rebec] = max(position, self._dropped[rebec])
        self._waiting -= len(gone)
        return gone
