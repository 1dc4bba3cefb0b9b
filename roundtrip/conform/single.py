"""The usual case of a search: one possible state, and one step that fits; without sets of states.

It stops at the beginning of the first moment in which there is more than one way, or none, or in
which anything else happens that asks for a closer look; the search goes on from there.
"""

from __future__ import annotations

from rebsync.roundtrip.conform.graph import Move, Node, StateGraph
from rebsync.roundtrip.conform.path import Visit
from rebsync.roundtrip.conform.persistent import PersistentSets
from rebsync.roundtrip.conform.possible import Observer
from rebsync.roundtrip.conform.stream import Positions, Stream

_OFTEN = 64  # observations after which those that were passed are let go


class Single:
    """Follows one possible state."""

    def __init__(
        self,
        graph: StateGraph,
        stream: Stream,
        persistent: PersistentSets,
        passed: Observer,
        visit: Visit | None,
    ) -> None:
        self._graph = graph
        self._stream = stream
        self._persistent = persistent
        self._passed = passed
        self._visit = visit

    def follow(self, node: Node, positions: Positions, time: int) -> tuple[Node, Positions, int]:
        """The state at the beginning of the first moment that needs a closer look."""
        count = 0
        while (after := self._moment(node, list(positions), time)) is not None:
            through, at, node, until = after
            if self._visit is not None:
                for each in through:
                    self._visit(time, each)
                self._visit(until, node)
            positions, time = at, until
            count += len(through)
            if count >= _OFTEN:
                count = 0
                self._passed(self._stream.drop_before(positions))
        self._passed(self._stream.drop_before(positions))
        return node, positions, time

    def _moment(
        self, node: Node, positions: list[int], time: int
    ) -> tuple[list[Node], Positions, Node, int] | None:
        """The states of one moment, and the state with which the next one begins."""
        through: list[Node] = []
        while node.able:
            move = self._step(node, positions, time)
            if move is None:
                return None
            node = move
            through.append(node)
        later = self._graph.later(node)
        if later is None or self._stream.ended:
            return None
        until = time + later[1]
        for rebec, position in enumerate(positions):
            served = self._stream.at_hand(rebec, position)
            if served is not None and served.start < until and not node.state[rebec].point:
                return None
        return through, tuple(positions), later[0], until

    def _step(self, node: Node, positions: list[int], time: int) -> Node | None:
        """The only step that fits, of the first rebec that has one; it moves the positions."""
        graph = self._graph
        for rebec in node.able:
            served = self._stream.get(rebec, positions[rebec])
            if served is None:
                return None
            if served.start != time and node.state[rebec].point is None:
                continue
            arrival, start = served.arrival, served.start
            key = (rebec, served.server, served.arguments, arrival - start, served.cells)
            fitting = node.moves.get(key) or graph.fitting(node, key, served)
            if fitting.failures:
                return None
            moves: list[Move] = [
                m for m in fitting.moves if (served.now == time if m.ended else served.now >= time)
            ]
            if not moves:
                continue
            if len(moves) > 1:
                return None
            is_only = len(node.able) == 1
            if not (is_only or self._persistent.has(node, positions, served, moves, time)):
                continue
            if moves[0].ended:
                positions[rebec] += 1
            return moves[0].node
        return None
