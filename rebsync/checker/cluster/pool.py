"""The workers of a search; one that is lost is replaced by one that does its work again.

All that a worker does follows from its checkpoints, one for each level, and from what it was sent
since. Both are objects in Ray's store, which stay when the process of a worker ends: the new worker
reads the checkpoints, and does the calls of the level once more.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field
from typing import Any

from rebsync.checker.cluster.connecting import Crew
from rebsync.checker.cluster.shard import Task
from rebsync.records import dataclass

GLANCE = 0.1  # seconds between two looks at the bounds
PATIENCE = 5  # times that workers may be lost in one level


class ClusterLost(Exception):
    """The cluster cannot go on; the text says why."""


@dataclass(slots=True)
class _Member:
    """A worker: what it was called since its last checkpoint, and what it answers last."""

    actor: Any = None
    ready: Any = None
    checkpoints: list[Any] = field(default_factory=list)
    calls: list[tuple[str, int, tuple[Any, ...]]] = field(default_factory=list)
    answers: list[Any] = field(default_factory=list)


class Pool:
    """So many workers. `look` is called now and then while they work, and may raise."""

    def __init__(self, crew: Crew, task: Task, look: Callable[[], None]) -> None:
        self._crew, self._task, self._look = crew, task, look
        self._ray = crew.ray
        self._seal = task.seal
        self._members = [_Member() for _ in range(task.shares)]
        self._lost_in_level = 0
        self.lost = 0
        for number in range(task.shares):
            self._start(number)

    def _start(self, number: int) -> None:
        """Starts a worker where the checkpoints end, if there are any."""
        member = self._members[number]
        member.actor = self._crew.actor(number)
        known = self._task, self._seal, number
        member.ready = member.actor.prepare.remote(*known, *member.checkpoints)

    def call(self, name: str, arguments: Sequence[tuple[Any, ...]], parts: int) -> tuple[Any, ...]:
        """Calls all workers; gives their reports, and for each its other answers, as objects.

        Raises ClusterLost when the cluster cannot go on, and what `look` and workers raise.
        """
        for member, given in zip(self._members, arguments, strict=True):
            member.calls.append((name, parts, given))
            self._again(member)
        reports = [self._report(i) for i in range(len(self._members))]
        return reports, [member.answers[1:] for member in self._members]

    def checkpoint(self, objects: Sequence[Any]) -> None:
        """Ends a level: from here on workers are what these objects say, and those before them."""
        self._lost_in_level = 0
        for member, each in zip(self._members, objects, strict=True):
            member.checkpoints.append(each)
            member.calls.clear()

    def before(self, level: int, number: int) -> tuple[int, int]:
        """The parent of a state of a level, and the code of the step between."""
        checkpoints = (member.checkpoints[level] for member in self._members)
        asked = [self._crew.before.remote(each, number) for each in checkpoints]
        for answer in self._got(asked):
            if answer is not None:
                return int(answer[0]), int(answer[1])
        raise ClusterLost(f"no worker has state {number}")

    # --- answers, and workers that are lost

    def _again(self, member: _Member) -> None:
        """Does the last call of a worker."""
        name, parts, given = member.calls[-1]
        answers = getattr(member.actor, name).options(num_returns=1 + parts).remote(*given)
        member.answers = list(answers)

    def _report(self, number: int) -> Any:  # noqa: ANN401 - what the call answers
        while True:
            try:
                member = self._members[number]
                return self._got([member.ready, member.answers[0]])[1]
            except self._ray.exceptions.RayActorError as error:
                self._replace(number, error)

    def _replace(self, number: int, error: Exception) -> None:
        """Starts a worker in the place of one, and lets it do what that one did."""
        self.lost += 1
        self._lost_in_level += 1
        if self._lost_in_level > PATIENCE:
            raise ClusterLost(f"workers of the cluster were lost again and again: {_first(error)}")
        self._crew.dismiss(number)
        self._start(number)
        member = self._members[number]
        calls = tuple(member.calls)
        for end in range(1, len(calls) + 1):
            member.calls = list(calls[:end])
            self._again(member)

    def _got(self, objects: list[Any]) -> list[Any]:
        """What the objects are, as soon as they are there."""
        waiting = objects
        while waiting:
            waiting = self._ray.wait(waiting, num_returns=len(waiting), timeout=GLANCE)[1]
            self._look()
        errors = self._ray.exceptions
        try:
            return list(self._ray.get(objects))
        except errors.RayActorError:
            raise
        except errors.RayTaskError as error:  # of a worker's own, or of what it was to be given
            if not isinstance(error.cause, errors.RayError):
                raise error.cause from None
            raise ClusterLost(f"the cluster failed: {_first(error.cause)}") from None
        except errors.RayError as error:
            raise ClusterLost(f"the cluster failed: {_first(error)}") from None


def _first(error: Exception) -> str:
    return str(error).strip().partition("\n")[0]
