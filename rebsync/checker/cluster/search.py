"""The breadth-first search of a cluster, level by level."""

from __future__ import annotations

import time
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from itertools import accumulate
from typing import NoReturn

from rebsync.checker.build import libraries
from rebsync.checker.cluster import NoCluster
from rebsync.checker.cluster.connecting import connected
from rebsync.checker.cluster.pool import ClusterLost, Pool
from rebsync.checker.cluster.shard import NOTHING, PlacedEvent, Task
from rebsync.checker.cluster.worker import OrderReport, WorkerReport
from rebsync.checker.decoding import cut_of, risk_of_hashes
from rebsync.checker.endless import Cut, endless_reason
from rebsync.checker.exploration import (
    Covered,
    Event,
    Exploration,
    Limits,
    Progress,
    Report,
    Unavailable,
    bound_of_states,
    kinds_of,
)
from rebsync.checker.graph import Graph
from rebsync.checker.look import Look, Stopped, unwatched
from rebsync.checker.memory import NO_MEMORY, used_memory
from rebsync.checker.problem import Cluster
from rebsync.checker.program import Program
from rebsync.checker.reduction import PersistentSets
from rebsync.checker.search import FIRST
from rebsync.checker.steps import Semantics
from rebsync.records import dataclass

NO_GRAPH = "a cluster keeps no steps: whether time can stand still is found out without --cluster"


@dataclass(slots=True)
class Traffic:
    """What has gone between workers, in bytes and in texts of one worker for another."""

    states: int = 0
    orders: int = 0
    checkpoints: int = 0
    messages: int = 0

    def add(
        self,
        made: Iterable[WorkerReport],
        ordered: Iterable[WorkerReport | OrderReport],
        taken: Iterable[WorkerReport],
    ) -> None:
        """What went round in one level."""
        made, ordered = tuple(made), tuple(ordered)
        self.states += sum(each.sent for each in made)
        self.orders += sum(each.sent for each in ordered)
        self.checkpoints += sum(each.sent for each in taken)
        self.messages += sum(each.messages for each in (*made, *ordered))


class ClusterSearch:
    """A search by the workers of a cluster. `invariants` are as those of other searches.

    Its figures are those of whole levels: a bound ends it between two of them, and nothing is told
    of the one that went on.

    Raises NoCluster when there is none, or it cannot build what searches.
    """

    def __init__(
        self,
        program: Program,
        semantics: Semantics,
        invariants: tuple[int, ...],
        persistent: PersistentSets,
        cluster: Cluster,
        hash_compaction: bool = False,
    ) -> None:
        self.program = program
        self.semantics: Semantics = semantics
        self._known = invariants, persistent, hash_compaction
        self._crew, self.workers = connected(cluster)
        self.traffic = Traffic()
        self._pool: Pool | None = None
        self._firsts: list[int] = []  # numbers of the states that come first in each level
        self._states = self._transitions = self._dropped = 0
        self._events: dict[object, Event] = {}  # by cause
        self._covered = Covered(frozenset(), frozenset(), (0,) * len(program.rebecs))
        self._memory = 0
        self._cut: Cut | None = None
        self._look: Look = unwatched

    # --- searching

    def run(self, limits: Limits, report: Report | None = None) -> Exploration:
        """Searches until everything is seen or a bound is reached; it does not go on from there."""
        started = time.perf_counter()
        task = self._task(limits)
        try:
            libraries(task.units())  # on this machine for the workers, too
        except Unavailable as unavailable:
            raise NoCluster(str(unavailable)) from None
        built = time.perf_counter()
        self._look = self._bounds(limits, report, built)
        reason: str | None
        try:
            self._pool = Pool(self._crew, task, lambda: self._look())
            reason = self._search(self._pool, limits)
        except KeyboardInterrupt:
            reason = "it was interrupted"
        except (Stopped, ClusterLost) as stopped:
            reason = str(stopped)
        except MemoryError:
            reason = NO_MEMORY
        except Unavailable as unavailable:
            raise NoCluster(str(unavailable)) from None
        finally:
            self._look = unwatched
        if reason is None and self._dropped:
            reason = f"the bound of {limits.until} units of time was reached"
        return Exploration(
            self._states,
            self._transitions,
            max(0, len(self._firsts) - 1),
            tuple(self._events.values()),
            self._covered,
            self.semantics,
            "cluster",
            time.perf_counter() - built,
            built - started,
            self._memory + used_memory(),
            reason,
            self._notes(),
            self._cut,
        )

    def _task(self, limits: Limits) -> Task:
        invariants, persistent, compaction = self._known
        bounds = limits.until, limits.instructions
        known = self.program, self.semantics, invariants, persistent
        return Task(*known, *bounds, compaction, self.workers)

    def _notes(self) -> tuple[str, ...]:
        lost = self._pool.lost if self._pool else 0
        risk = (risk_of_hashes(self.program, self._states),) if self._known[2] else ()
        return (*risk, f"workers that were lost, and replaced: {lost}") if lost else risk

    def _bounds(self, limits: Limits, report: Report | None, started: float) -> Look:
        """Tells how far the search is, and raises Stopped at a bound."""

        def look() -> None:
            seconds = time.perf_counter() - started
            if report:
                waiting = self._states - self._firsts[-1] if self._firsts else 0
                known = self._states, self._transitions, max(0, len(self._firsts) - 1), waiting
                violations = kinds_of(self._events, limits.faults)
                report(Progress(*known, seconds, self._memory, violations=violations))
            if over := limits.out_of_time(seconds) or limits.out_of_memory(self._memory):
                raise Stopped(over)

        return look

    def _search(self, pool: Pool, limits: Limits) -> str | None:
        """Enters levels until there is no other: why it ends, None if all was seen."""
        phase, first, parents = "begin", 0, 1
        while True:
            reached = self._enter(pool, phase, first, parents, limits)
            if self._cut:
                return endless_reason(self.program, self._cut)
            if limits.first and any(map(limits.faults.includes, self._events)):
                return FIRST
            if not reached:
                return None
            if limits.states is not None and self._states >= limits.states:
                return bound_of_states(limits.states)
            phase, first, parents = "expand", self._firsts[-1], reached

    def _enter(self, pool: Pool, phase: str, first: int, parents: int, limits: Limits) -> int:
        """Enters a level, from `parents` states with numbers from `first` on: how many it has."""
        workers = self.workers
        made, batches = pool.call(phase, [()] * workers, workers)
        end = self._unfinished(made, limits)
        if self._cut and phase == "begin":  # no initial state is complete
            return 0
        texts = zip(*batches, strict=True)
        new, ways = pool.call("receive", [(end, first, parents, *t) for t in texts], workers)
        ordered, places = pool.call("rank", list(zip(*ways, strict=True)), workers)
        *firsts, states = accumulate((each.ways for each in ordered), initial=self._states)
        texts = zip(*places, strict=True)
        taken, checkpoints = pool.call("accept", [(firsts, *t) for t in texts], 1)
        pool.checkpoint([objects[0] for objects in checkpoints])
        reached: int = sum(each.phase.states for each in taken)
        assert reached == states - self._states, "all new states have their numbers"
        self._entered(reached, end, made, taken)
        self.traffic.add(made, (*new, *ordered), taken)
        return reached

    def _unfinished(self, made: Sequence[WorkerReport], limits: Limits) -> int:
        """The first state in which a body was given up, which ends the search; else NOTHING."""
        found = [each.phase.unfinished for each in made if each.phase.unfinished]
        if not found:
            return NOTHING
        number, cause, pc, outer = min(found)
        self._cut = cut_of(cause, pc, outer, limits.instructions)
        return number

    def _entered(
        self, reached: int, end: int, made: Sequence[WorkerReport], taken: Sequence[WorkerReport]
    ) -> None:
        """Keeps what a level has come to, in the order of a search by one machine."""
        if reached:
            self._firsts.append(self._states)
        self._states += reached
        self._transitions += sum(each.phase.transitions for each in made)
        self._dropped += sum(each.phase.dropped for each in made)
        self._memory = sum(each.memory for each in taken)
        found = [f for each in (*made, *taken) for f in each.phase.findings if f.parent < end]
        for finding in sorted(found, key=_order):
            self._events.setdefault(finding.event.cause, finding.event)
        for each in taken:
            self._covered = _together(self._covered, each.covered)

    # --- afterwards

    def path(self, state: int) -> tuple[int, ...]:
        """A shortest way to a state: the code of the initial state, then one for each step."""
        codes: list[int] = []
        level = bisect_right(self._firsts, state) - 1
        assert self._pool
        for each in range(level, -1, -1):
            state, code = self._pool.before(each, state)
            codes.append(code)
        return tuple(reversed(codes))

    def graph(self, look: Look = unwatched) -> NoReturn:
        """Raises Stopped: it has no steps."""
        raise Stopped(NO_GRAPH)

    def marks(self, graph: Graph) -> NoReturn:
        """Raises Stopped: there is no graph."""
        raise Stopped(NO_GRAPH)


def _order(finding: PlacedEvent) -> tuple[int, int, int]:
    return finding.parent, finding.code, finding.place


def _together(one: Covered, other: Covered) -> Covered:
    largest = tuple(map(max, one.largest, other.largest))
    return Covered(one.servers | other.servers, one.branches | other.branches, largest)
