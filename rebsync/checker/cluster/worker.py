"""What Ray calls of a worker: the phases of a level, with states and their order as bytes.

Each phase answers a report, and behind it one text of bytes for each worker, as said.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from typing import NamedTuple

from rebsync.checker.cluster.shard import PhaseReport, Shard, Task
from rebsync.checker.exploration import Covered, Unavailable
from rebsync.checker.memory import used_memory


class WorkerReport(NamedTuple):
    """What a phase has come to, what ran in this worker so far, and its memory.

    `sent` are the bytes for other workers, or for the checkpoint, `messages` how many texts.
    """

    phase: PhaseReport
    covered: Covered
    memory: int
    sent: int
    messages: int


class OrderReport(NamedTuple):
    """How many ways were put in order; the bytes and texts are as in other reports."""

    ways: int
    sent: int
    messages: int


class Worker:
    """One of the workers of a search, of one after the other."""

    def prepare(self, task: Task, seal: str, number: int, *checkpoints: bytes) -> None:
        """Builds what searches, and takes the place of a lost worker at the end of a level, if any.

        Raises Unavailable when it cannot be built, or is not what the others have.
        """
        if task.seal != seal:
            raise Unavailable("the machines of the cluster have different versions of rebsync")
        self._number, self._shares = number, task.shares
        self._shard = Shard(task)
        self._shard.restore(checkpoints)

    def begin(self) -> tuple[object, ...]:
        """Makes the initial states, for each worker its own; all but the first make none."""
        if self._number:
            return self._answer(self._shard.receive((), 0), [b""] * self._shares)
        return self._sent(self._shard.begin())

    def expand(self) -> tuple[object, ...]:
        """Makes the steps of the states that wait: for each worker the states that it owns."""
        return self._sent(self._shard.expand())

    def _sent(self, phase: PhaseReport) -> tuple[object, ...]:
        return self._answer(phase, [self._shard.batch(owner) for owner in range(self._shares)])

    def receive(self, end: int, first: int, parents: int, *batches: bytes) -> tuple[object, ...]:
        """Takes in states: for each worker the ways to new ones from its range of the parents."""
        phase = self._shard.receive([each for each in batches if each], end)
        ways = [self._shard.ways(first, parents, part) for part in range(self._shares)]
        return self._answer(phase, ways)

    def rank(self, *ways: bytes) -> tuple[object, ...]:
        """Puts a range of ways in order: for each worker the places of its own."""
        places = self._shard.rank(ways)
        return OrderReport(sum(map(len, places)) // 4, *self._sizes(places)), *places

    def accept(self, firsts: Sequence[int], *places: bytes) -> tuple[object, ...]:
        """Ends a level: new states get their numbers. The text is the checkpoint."""
        for first, each in zip(firsts, places, strict=True):
            self._shard.number(first, each)
        phase, checkpoint = self._shard.accept(), self._shard.checkpoint()
        report = WorkerReport(phase, self._shard.covered(), used_memory(), len(checkpoint), 1)
        return report, checkpoint

    def _answer(self, phase: PhaseReport, texts: list[bytes]) -> tuple[object, ...]:
        report = WorkerReport(phase, self._shard.covered(), used_memory(), *self._sizes(texts))
        return report, *texts

    def _sizes(self, texts: list[bytes]) -> tuple[int, int]:
        """The bytes for others, and how many texts have any."""
        sizes = [len(text) for to, text in enumerate(texts) if to != self._number and text]
        return sum(sizes), len(sizes)


def before(checkpoint: bytes, number: int) -> tuple[int, int] | None:
    """The parent of a state, and the code of the step between; None if a checkpoint lacks it.

    It has how many states there are, what else it has, and their numbers, ascending, their parents
    and their codes; what comes behind is for C alone.
    """
    whole = memoryview(checkpoint)
    states = int(whole[:8].cast("Q")[0])
    numbers = whole[16 : 16 + 8 * states].cast("Q")
    at = bisect_left(numbers, number)
    if at == states or numbers[at] != number:
        return None
    parents = whole[16 + 8 * states : 16 + 16 * states].cast("Q")
    codes = whole[16 + 16 * states : 16 + 20 * states].cast("I")
    return int(parents[at]), int(codes[at])
