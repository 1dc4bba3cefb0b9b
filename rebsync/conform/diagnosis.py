"""What the first step is that no run of the model has, of what kind, and what would be allowed.

The possible states that came furthest are asked what they could have done; changes of what was
recorded that a known fault makes (a message lost, repeated, swapped) are tried for an explanation.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rebsync.checker.state import Message
from rebsync.checker.steps import Failure
from rebsync.conform.conformance import Allowed, Deviation, Difference, Kind
from rebsync.conform.graph import StateGraph
from rebsync.conform.possible import Dead
from rebsync.conform.recording import Served
from rebsync.conform.search import SearchResult
from rebsync.conform.stream import Stream
from rebsync.records import dataclass
from rebsync.source import Source

_FEW = 5  # allowed steps that are listed


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """A refusal, to be explained; `before` has the last observation of each rebec that fitted.

    `recent` are the last that fitted of all.
    """

    graph: StateGraph
    stream: Stream
    source: Source
    before: dict[int, Served]
    recent: Iterable[Served] = ()

    def of(self, found: SearchResult) -> Deviation:
        """The first step that no run has."""
        candidates = list(self._candidates(found.dead))
        return min(candidates, key=lambda c: c[0])[1]

    def _candidates(
        self, dead: tuple[Dead, ...]
    ) -> Iterator[tuple[tuple[int, int, float], Deviation]]:
        """A deviation for each rebec to blame; the best first: failures of the model, known faults,
        then what was recorded first."""
        for each in dead:
            blamed = (each.rebec,) if each.rebec >= 0 else each.config.node.able
            for failure in each.failures:
                yield (0, 0, 0.0), self._failure(each, failure)
            found = []
            for rebec in blamed:
                served = self.stream.get(rebec, each.config.positions[rebec])
                found.append((self._deviation(each, rebec, served), served))
            has_cause = any(deviation.kind in _CAUSES for deviation, _ in found)
            for deviation, served in found:
                if has_cause and self._may_follow(deviation, served):
                    continue
                rank = _RANK.index(deviation.kind)
                stamp = served.stamp if served is not None else float("inf")
                yield (1, rank if rank < _CERTAIN else _CERTAIN, stamp), deviation

    def _may_follow(self, deviation: Deviation, served: Served | None) -> bool:
        """Whether it may follow from what another rebec did at this moment.

        A message that does not wait may be one that the other one was to send; so may a message
        that equals the one before, but for a time at which its rebec cannot serve any more.
        """
        if served is None or deviation.kind not in ("repeated", "unexpected"):
            return False
        before = self.before.get(served.rebec)
        is_past = before is not None and served.start < before.now
        return not is_past and served.server != "constructor"

    def _failure(self, dead: Dead, failure: Failure) -> Deviation:
        graph = self.graph
        body = graph.program.body_at(failure.pc).name
        rebec = failure.rebec if failure.rebec >= 0 else dead.config.node.able[0]
        text = _FAILURES[failure.kind].format(rebec=self._name(rebec), body=body)
        line = self.source.position(graph.program.spans[failure.pc].start).line
        served = self.stream.get(rebec, dead.config.positions[rebec])
        message = f"{text}: the model breaks a rule here, and says nothing of what follows"
        return Deviation("model failure", self._name(rebec), dead.time, message, served, line)

    # --- one rebec

    def _deviation(self, dead: Dead, rebec: int, served: Served | None) -> Deviation:
        allowed = self._allowed(dead, rebec)
        name = self._name(rebec)
        line = allowed[0].line if allowed else 0
        if served is None:
            what = f"{allowed[0].server}({allowed[0].arguments})" if allowed else "a message"
            message = f"{name} has to serve {what} at {dead.time}, and nothing of it is recorded"
            return Deviation("silent", name, dead.time, message, None, line, allowed)
        kind, why, differences = self._kind(dead, rebec, served, allowed)
        line = line or self._line(rebec, served.server)
        shown = f"{name} {shown_step(served)}"
        return Deviation(
            kind, name, dead.time, f"{shown}: {why}", served, line, allowed, differences
        )

    def _kind(
        self, dead: Dead, rebec: int, served: Served, allowed: tuple[Allowed, ...]
    ) -> tuple[Kind, str, tuple[Difference, ...]]:
        before = self.before.get(rebec)
        if (
            before is not None
            and before.publisher
            and served.publisher not in ("", before.publisher)
        ):
            why = f"{served.publisher} publishes it, and {before.publisher} did before"
            return "second publisher", why, ()
        if any(_repeats(served, each) for each in self.recent):
            return "repeated", "the same state message was recorded before", ()
        if before is not None and served.server == "constructor":
            return "restarted", "the node was started again, which no rebec of a model is", ()
        if before is not None and served.start < before.now:
            return (
                "second publisher",
                f"it had got to {before.now} before; another node or run?",
                (),
            )
        same = [a for a in allowed if _is_message(a, served)]
        point = dead.config.node.state[rebec].point
        if (same and served.start == dead.time) or (point is not None and served.start < dead.time):
            return self._of_body(dead, rebec, served)
        return self._of_message(dead, rebec, served, allowed)

    def _of_body(
        self, dead: Dead, rebec: int, served: Served
    ) -> tuple[Kind, str, tuple[Difference, ...]]:
        """The message is the right one; what the body did is not."""
        moves = self.graph.all_of(dead.config.node, rebec).moves
        ended = [m for m in moves if m.ended]
        if ended and served.now > dead.time:
            return "late", f"its body ends at {dead.time} in the model", ()
        if served.now < dead.time or not ended:
            return "early", "its body takes longer in the model", ()
        states = {m.node.state[rebec].variables for m in ended}
        differences = tuple(self._differences(rebec, served, sorted(states)))
        names = ", ".join(
            f"{d.variable} = {d.recorded}, not {' or '.join(d.allowed[:_FEW])}" for d in differences
        )
        return "wrong state", names or "no choice of the model leads to this state", differences

    def _differences(
        self, rebec: int, served: Served, states: list[tuple[int, ...]]
    ) -> Iterator[Difference]:
        observable = self.graph.observable
        variables = observable.variables(rebec)
        nearest = min((observable.differing(rebec, served.cells, s) for s in states), key=len)
        for name, kind, cell in variables:
            if name in nearest:
                values = dict.fromkeys(observable.value(s[cell], kind) for s in states)
                yield Difference(name, observable.value(served.cells[cell], kind), tuple(values))

    def _of_message(
        self, dead: Dead, rebec: int, served: Served, allowed: tuple[Allowed, ...]
    ) -> tuple[Kind, str, tuple[Difference, ...]]:
        """Another message than the model allows, or at another time."""
        local = dead.config.node.state[rebec]
        graph, time = self.graph, dead.time
        waits = [m for m in local.bag if graph.serves(m, served, time)]
        expected = " or ".join(dict.fromkeys(f"{a.server}({a.arguments})" for a in allowed[:_FEW]))
        if not waits:
            if allowed and served.start >= time and self._follows_lost(dead, rebec, served):
                why = (
                    f"{expected} has to be served at {time} before, and its state was not recorded"
                )
                return "lost state", why, ()
            if expected:
                return (
                    "unexpected",
                    f"the model serves {expected} at {time}, and no such message waits",
                    (),
                )
            return "unexpected", f"no such message has been sent to it by {time}", ()
        if not allowed:
            return "early", f"it cannot be served at {served.start} yet", ()
        if any(_is_message(a, served) for a in allowed):
            kind: Kind = "late" if served.start > time else "early"
            return kind, f"the model serves it at {time}", ()
        following = self.stream.get(rebec, dead.config.positions[rebec] + 1)
        if following is not None and any(_is_message(a, following) for a in allowed):
            return "swapped", f"{expected} has to be served before, and was served after it", ()
        return "lost message", f"{expected} has to be served before, and never was", ()

    def _follows_lost(self, dead: Dead, rebec: int, served: Served) -> bool:
        """Whether it could be served if one state of the rebec was not recorded."""
        is_server = bool(self._line(rebec, served.server))
        for move in self.graph.all_of(dead.config.node, rebec).moves:
            local = move.node.state[rebec]
            if (not move.ended and is_server) or any(
                self.graph.serves(m, served, dead.time) for m in local.bag
            ):
                return True
        return False

    # --- what would be allowed

    def _allowed(self, dead: Dead, rebec: int) -> tuple[Allowed, ...]:
        found: dict[Allowed, None] = {}
        node = dead.config.node
        point = node.state[rebec].point
        for move in self.graph.all_of(node, rebec).moves:
            if move.message is None and point is None:
                continue
            state = move.node.state[rebec].variables if move.ended else None
            found[self._step(rebec, move.message, dead.time, state)] = None
            if len(found) >= 4 * _FEW:
                break
        return tuple(found)

    def _step(
        self, rebec: int, message: Message | None, time: int, cells: tuple[int, ...] | None
    ) -> Allowed:
        graph = self.graph
        shown: tuple[tuple[str, str], ...] = ()
        if cells is not None:
            shown = tuple(graph.observable.shown(rebec, cells).items())
        if message is None:
            return Allowed(self._name(rebec), "constructor", "", 0, 0, shown, 0)
        server = graph.program.servers[message.server]
        line = self.source.position(server.span.start).line
        arrival = time + message.arrival
        return Allowed(
            self._name(rebec), server.name, graph.text(message), arrival, time, shown, line
        )

    def _line(self, rebec: int, server: str) -> int:
        """The line of a message server of a rebec."""
        program = self.graph.program
        name = program.rebecs[rebec].class_name
        found = (s for s in program.servers if s.name == server and s.class_name == name)
        span = next((s.span for s in found), None)
        return self.source.position(span.start).line if span is not None else 0

    def _name(self, rebec: int) -> str:
        return self.graph.observable.nodes[rebec]


_FAILURES = {
    "assertion": "an assertion fails in {body}",
    "deadline": "{rebec} misses the deadline of {body}",
    "overflow": "the bag of {rebec} overflows in {body}",
    "index": "an index is outside of its array in {body}",
    "division": "a division by zero in {body}",
    "null": "a message goes to nobody in {body}",
    "time": "a negative time in {body}",
}
_RANK: tuple[Kind, ...] = (
    "repeated", "restarted", "second publisher", "wrong state", "swapped", "lost state",
    "lost message", "late", "early", "unexpected", "silent", "no start", "model failure",
)  # fmt: skip
_CAUSES = ("wrong state", "late", "early")  # of a message that waits: nobody else is to blame
_CERTAIN = 3  # of these kinds one is told whatever else was recorded earlier


def shown_step(served: Served) -> str:
    """A recorded step in a few words."""
    times = (
        f"at {served.start}"
        if served.start == served.arrival
        else (f"at {served.start}, arrived {served.arrival}")
    )
    return f"serves {served.server}({served.arguments}) {times}"


def _is_message(allowed: Allowed, served: Served) -> bool:
    return (allowed.server, allowed.arguments, allowed.arrival) == (
        served.server,
        served.arguments,
        served.arrival,
    )


def _repeats(one: Served, other: Served) -> bool:
    return one[:7] == other[:7]
