"""The last steps of the run of the model that fits a recording, as the checker tells runs."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from itertools import pairwise

from rebsync.checker.steps import Failure
from rebsync.checker.telling import Teller
from rebsync.checker.trace import TraceStep
from rebsync.roundtrip.conform.graph import Node, StateGraph
from rebsync.source import Source

STEPS = 150  # that are remembered


class Visited:
    """The states of the run that were visited last."""

    def __init__(self, graph: StateGraph, source: Source) -> None:
        self._teller = Teller(graph.view, source)
        self._last: deque[tuple[int, Node]] = deque(maxlen=STEPS)

    def see(self, time: int, node: Node) -> None:
        """The next state."""
        self._last.append((time, node))

    def steps(self) -> tuple[TraceStep, ...]:
        """The steps between them."""
        return tuple(self._steps())

    def _steps(self) -> Iterator[TraceStep]:
        for number, ((time, before), (_, after)) in enumerate(pairwise(self._last), 1):
            for step in before.steps():
                if not isinstance(step.result, Failure) and step.result == after.state:
                    yield self._teller.step(number, time, before.state, step)
                    break
