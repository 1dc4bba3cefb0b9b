"""Trace inclusion for one trace: a breadth-first search for a run of the model that fits it.

The set of possible states is carried along, moment by moment of the model's time. At each moment
the rebecs act in every order that their observations allow: an observation fixes which message is
served, when, and the state after it; what it leaves open (senders, choices that show later) stays
open. Where orders commute one of them is enough (`persistent`), unless a bag was full.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

from rebsync.checker.endless import EndlessBody
from rebsync.checker.steps import Failure
from rebsync.conform.graph import NOTHING, Fitting, Move, StateGraph
from rebsync.conform.path import Path
from rebsync.conform.persistent import PersistentSets
from rebsync.conform.possible import Config, Dead, Observer, Reason
from rebsync.conform.recording import Served
from rebsync.conform.stream import Positions, Stream
from rebsync.records import dataclass

WIDEST = 20_000  # possible states at one moment


@dataclass(frozen=True, slots=True)
class SearchResult:
    """How a search ended.

    `verdict`: a run that fits all ("fits"); none ("refused", with the possible states that came
    furthest); or not known ("cut", with the reason). `compared` are observations of steps that
    some run has.
    """

    verdict: Literal["fits", "refused", "cut"]
    compared: int
    time: int
    dead: tuple[Dead, ...] = ()
    reason: str = ""
    widest: int = 1


def _nothing(_: list[Served]) -> None:
    return


class Search:
    """One search. `tail` is how long before the end of the recording a body may end unobserved.

    Of the rebecs in `hidden` nothing is recorded: they may do all that the model allows. With more
    than `limit` possible states at one moment the search is cut.
    """

    def __init__(
        self,
        graph: StateGraph,
        stream: Stream,
        tail: int = 0,
        passed: Observer = _nothing,
        path: Path | None = None,
        hidden: frozenset[int] = frozenset(),
        limit: int = WIDEST,
    ) -> None:
        self.graph = graph
        self.limit = limit
        self.hidden = hidden
        self.stream = stream
        self.tail = tail
        self.passed = passed
        self.path = path
        self.widest = 0
        self._persistent = PersistentSets(graph, stream)
        self._waiting: dict[int, set[Config]] = {}
        self._dead: list[Dead] = []
        self._depth = -1
        self._overflow = False

    def run(self, starts: Iterable[Config], time: int = 0) -> SearchResult:
        """Searches from some possible states at a time on."""
        configs = list(starts)
        self._waiting = {}
        if self.path is not None:
            self.path.begin(time, configs)
        while True:
            self.widest = max(self.widest, len(configs))
            before = self._depth, list(self._dead), {t: set(c) for t, c in self._waiting.items()}
            try:
                found = self._moment(configs, time, self._persistent.exist)
                if self._overflow and self._persistent.exist and not found:
                    # An order that another one stands for may be the one in which there is room.
                    self._depth, self._dead, self._waiting = before
                    found = self._moment(configs, time, False)
            except EndlessBody as endless:
                return self._cut(time, f"a body of {self._body(endless.pc)} does not end")
            if found:
                return SearchResult("fits", self._depth, time, widest=self.widest)
            if self.widest > self.limit:
                return self._cut(time, f"more than {self.limit} states of the model are possible")
            if not self._waiting:
                if self.path is not None and self._dead:
                    self.path.settle(self._dead[0].time, self._dead[0].config)
                return SearchResult(
                    "refused", self._depth, time, tuple(self._dead), widest=self.widest
                )
            time = min(self._waiting)
            configs = list(self._waiting.pop(time))
            self._drop(configs, time)

    def _cut(self, time: int, reason: str) -> SearchResult:
        return SearchResult("cut", max(self._depth, 0), time, (), reason, self.widest)

    def _body(self, pc: int) -> str:
        return self.graph.program.body_at(pc).name

    def _drop(self, configs: list[Config], time: int) -> None:
        every = [*configs, *(c for later in self._waiting.values() for c in later)]
        if len(every) == 1 and configs:
            least: Positions = every[0].positions
            if self.path is not None:
                self.path.settle(time, every[0])
        else:
            least = tuple(map(min, zip(*(c.positions for c in every), strict=True)))
        if gone := self.stream.drop_before(least):
            self.passed(gone)

    # --- one moment

    def _moment(self, configs: list[Config], time: int, reduces: bool) -> bool:
        """All that can happen at one time; whether some run has all that was observed."""
        work, seen = list(configs), set(configs)
        self._overflow = False
        while work:
            config = work.pop()
            if self._is_complete(config):
                self._depth = self.stream.read
                if self.path is not None:
                    self.path.settle(time, config)
                return True
            after = self._successors(config, time, reduces)
            if self.path is not None:
                self.path.link(time, after, time, config)
            if len(after) == 1 and not work:
                work = after  # the usual case, without looking at what was seen
                if after[0] in seen:
                    return False
                seen.add(after[0])
                continue
            for each in after:
                if each not in seen:
                    seen.add(each)
                    work.append(each)
            if len(seen) > self.limit:
                self.widest = len(seen)
                return False
        return False

    def _is_complete(self, config: Config) -> bool:
        """Whether all that was recorded is in the run."""
        count = sum(config.positions)
        return count >= self.stream.read and not self.stream.has_more(count)

    def _successors(self, config: Config, time: int, reduces: bool) -> list[Config]:
        node = config.node
        if not node.able:
            self._pass_time(config, time)
            return []
        found: list[Config] = []
        failures: list[Failure] = []
        silent = -1
        for rebec in node.able:
            hidden = rebec in self.hidden
            served = None if hidden else self.stream.get(rebec, config.positions[rebec])
            fitting = self._fitting(config, rebec, served, time)
            failures += fitting.failures
            self._overflow |= any(f.kind == "overflow" for f in fitting.failures)
            after, lacks = self._after(config, rebec, served, fitting, time)
            silent = rebec if lacks else silent
            if reduces and after and served is not None:
                at, moves = config.positions, fitting.moves
                if self._persistent.has(node, at, served, moves, time):
                    return after
            found += after
        if not found:
            reason: Reason = "silent" if silent >= 0 else "step"
            self._die(Dead(config, time, reason, silent, tuple(failures)))
        return found

    def _fitting(self, config: Config, rebec: int, served: Served | None, time: int) -> Fitting:
        """The steps of a rebec that fit, but for the time at which a body ends."""
        node = config.node
        if served is None or any(r == rebec for r, _ in config.begun):
            return self.graph.all_of(node, rebec)
        if node.state[rebec].point is None and served.start != time:
            return NOTHING
        key = (rebec, served.server, served.arguments, served.arrival - served.start, served.cells)
        return self.graph.fitting(node, key, served)

    def _after(
        self, config: Config, rebec: int, served: Served | None, fitting: Fitting, time: int
    ) -> tuple[list[Config], bool]:
        """Where the steps lead, and whether one ends a body that was not observed."""
        after, lacks = [], False
        for move in fitting.moves:
            begun = config.begun
            if served is None and config.node.state[rebec].point is None:
                begun = (*begun, (rebec, time))
            if not move.ended:
                if served is None or served.now >= time:
                    after.append(Config(move.node, config.positions, begun))
                continue
            started = next((t for r, t in begun if r == rebec), None)
            rest = tuple((r, t) for r, t in begun if r != rebec) if begun else ()
            if served is None:
                if self._may_be_unobserved(rebec, time):
                    after.append(Config(move.node, config.positions, rest))
                else:
                    lacks = True
                continue
            if served.now != time or (
                started is not None and not self._is_of(served, move, started, time)
            ):
                continue
            positions = config.positions
            positions = (*positions[:rebec], positions[rebec] + 1, *positions[rebec + 1 :])
            after.append(Config(move.node, positions, rest))
        return after, lacks

    def _is_of(self, served: Served, move: Move, started: int, time: int) -> bool:
        """Whether a body that was begun without its observation is the one that was observed."""
        same = self.graph.serves(move.message, served, time)
        cells = move.node.state[served.rebec].variables
        is_state = self.graph.observable.is_same(served.rebec, served.cells, cells)
        return same and served.start == started and is_state

    def _may_be_unobserved(self, rebec: int, time: int) -> bool:
        """Whether the recording has nothing of a rebec, or ended before the state after a body."""
        if rebec in self.hidden:
            return True
        return self.stream.ended and time >= self.stream.horizon - self.tail

    def _pass_time(self, config: Config, time: int) -> None:
        later = self.graph.later(config.node)
        if later is None:
            self._end(config, time)
            return
        node, elapsed = later
        until = time + elapsed
        for rebec, position in enumerate(config.positions):
            served = self.stream.at_hand(rebec, position)
            if served is not None and served.start < until and not config.node.state[rebec].point:
                self._die(Dead(config, time, "time", rebec))
                return
        waiting = self._waiting.setdefault(until, set())
        passed = Config(node, config.positions, config.begun)
        waiting.add(passed)
        if self.path is not None:
            self.path.link(until, [passed], time, config)

    def _end(self, config: Config, time: int) -> None:
        """Nothing can happen any more: what is read from now on is more than the model has."""
        for rebec, position in enumerate(config.positions):
            if self.stream.get(rebec, position) is not None:
                self._die(Dead(config, time, "end", rebec))
                return

    def _die(self, dead: Dead) -> None:
        """Remembers the possible states that came furthest."""
        depth = sum(dead.config.positions)
        if depth > self._depth:
            self._depth = depth
            self._dead = []
        if depth == self._depth and len(self._dead) < 100:
            self._dead.append(dead)
