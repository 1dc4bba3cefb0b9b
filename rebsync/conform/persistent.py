"""Partial-order reduction: where the steps of one rebec stand for all that may come first.

A rebec that was observed to act at a moment acts at it on every run that fits, and on the message
that was observed. Its steps are a persistent set (Godefroid, 1996) if they go first as well: no
message that the others send at that moment can be meant, and what it sends restrains nobody.
Both are seen in what is observed from there on: a rebec serves messages in the order in which they
have arrived, so the observations with an arrival up to the moment are those of its messages.
A full bag is left out of account (`search` looks at all orders then).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rebsync.checker.program import UNRANKED
from rebsync.checker.state import Local, Message
from rebsync.conform.graph import Move, Node, StateGraph
from rebsync.conform.recording import Served
from rebsync.conform.stream import Stream


class PersistentSets:
    """Tells of the steps of a rebec in a state whether the steps of others may be left out."""

    def __init__(self, graph: StateGraph, stream: Stream) -> None:
        self._graph, self._stream = graph, stream
        program = graph.program
        ranks = {r.priority for r in program.rebecs}
        self.exist = ranks <= {UNRANKED} and not program.global_ranks
        sends = [i for i in program.code if i.op in ("SEND", "SENDBY")]
        asks = any(i.op == "SENDER" for i in program.code)
        # Where nobody sees a sender or has a deadline, messages that look equal are.
        self._is_plain = not asks and all(i.op == "SEND" for i in sends)
        selectors = {i.a for i in sends if not i.constants[0]}
        self._sent_at_once = {
            program.servers[rebec.dispatch[selector]].name
            for rebec in program.rebecs
            for selector in selectors
            if rebec.dispatch[selector] >= 0
        }
        self._ranks: list[dict[str, int]] = []
        for rebec in program.rebecs:
            servers = [program.servers[n] for n in rebec.dispatch if n >= 0]
            worst = {s.name: max(o.priority for o in servers if o.name == s.name) for s in servers}
            is_ranked = len({s.priority for s in servers}) > 1
            self._ranks.append(worst if is_ranked else {})

    def has(
        self, node: Node, at: Sequence[int], served: Served, moves: Sequence[Move], time: int
    ) -> bool:
        """Whether these steps, of the rebec that `served` is of, can go first on every run."""
        return (
            self.exist
            and self._is_own_choice(node, at, served, time)
            and (not any(self._ranks) or not any(self._restrain(node, at, m, time) for m in moves))
        )

    def _is_own_choice(self, node: Node, at: Sequence[int], served: Served, time: int) -> bool:
        """Whether no message that is sent at this moment can be the one that was served."""
        if self._is_plain or served.arrival < time or node.state[served.rebec].point is not None:
            return True
        if served.server not in self._sent_at_once:
            return True
        later = self._arrived(served.rebec, at[served.rebec] + 1, time)
        look = served.server, served.arguments, served.arrival
        return later is not None and all(s[1:4] != look for s in later)

    def _restrain(self, node: Node, at: Sequence[int], move: Move, time: int) -> bool:
        """Whether a step may keep others from serving what they have served before its messages."""
        after = move.node.state
        return any(
            self._delays(rebec, at, message, time)
            for rebec, before in enumerate(node.state)
            if self._ranks[rebec] and after[rebec] is not before and rebec != move.rebec
            for message in _sent_now(before, after[rebec])
        )

    def _delays(self, rebec: int, at: Sequence[int], message: Message, time: int) -> bool:
        """Whether a message has a better rank than one that was served before it."""
        later = self._arrived(rebec, at[rebec], time)
        if later is None:
            return True
        server = self._graph.program.servers[message.server]
        look = server.name, self._graph.text(message), time
        places = [number for number, served in enumerate(later) if served[1:4] == look]
        ranks = self._ranks[rebec]
        return not places or any(
            served.arrival == time and ranks.get(served.server, UNRANKED) > server.priority
            for served in later[: places[-1]]
        )

    def _arrived(self, rebec: int, position: int, time: int) -> list[Served] | None:
        """What a rebec serves of what arrives up to a time; None where that is not known."""
        found: list[Served] = []
        while (served := self._stream.get(rebec, position)) is not None:
            if served.arrival > time:
                return found
            found.append(served)
            position += 1
        return None


def _sent_now(before: Local, after: Local) -> Iterator[Message]:
    """The messages that arrive now and were not there before."""
    left = list(before.bag)
    for message in after.bag:
        if message in left:
            left.remove(message)
        elif message.arrival == 0:
            yield message
