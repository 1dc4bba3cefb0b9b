"""A state space in which what holds stays as it is along every edge, and every run is endless."""

from __future__ import annotations

from array import array

from rebsync.checker.graph import Graph
from rebsync.checker.look import Look, unwatched
from rebsync.records import dataclass


@dataclass(slots=True)
class Timeline:
    """Nodes 0 to n - 1 are the states of a graph, further ones points on the way along an edge.

    While the time of an edge passes, what holds at its source goes on to hold; where it would not,
    the edge is split by a node. `step` is the edge of the graph that an edge begins, or -1.
    Failed steps are left out. A final state has an edge to itself, of more time than any bound.
    `origin` is, for a node that splits an edge, the source of the edge. `entering` is known once
    `before` was asked for.
    """

    first: array[int]
    source: array[int]
    target: array[int]
    time: array[int]
    step: array[int]
    origin: array[int]
    look: Look = unwatched
    entering: tuple[array[int], array[int]] | None = None

    @staticmethod
    def of(graph: Graph, patience: int, look: Look = unwatched) -> Timeline:
        """The states of a graph; `patience` is the time of the edges of final states.

        `look` is called now and then by everything that goes over all nodes.
        """
        first, source, target = array("q", [0]), array("q"), array("q")
        time, step = array("q"), array("q")
        for state in range(len(graph)):
            if not state & 4095:
                look()
            start = len(target)
            for edge in range(graph.first[state], graph.first[state + 1]):
                if graph.target[edge] >= 0:
                    source.append(state)
                    target.append(graph.target[edge])
                    time.append(graph.time[edge])
                    step.append(edge)
            if len(target) == start:
                source.append(state)
                target.append(state)
                time.append(patience)
                step.append(-1)
            first.append(len(target))
        origin = array("q", range(len(graph)))
        return Timeline(first, source, target, time, step, origin, look)

    def __len__(self) -> int:
        return len(self.origin)

    def edges(self, node: int) -> range:
        """The edges that leave a node."""
        return range(self.first[node], self.first[node + 1])

    def before(self) -> tuple[array[int], array[int]]:
        """The edges that enter each node: those of n are edges[first[n]] up to first[n + 1]."""
        if self.entering is None:
            code = self.first.typecode
            first, edges = array(code, [0]) * (len(self) + 1), array(code, [0]) * len(self.target)
            for target in self.target:
                first[target + 1] += 1
            for node in range(len(self)):
                first[node + 1] += first[node]
            place = array(code, first)
            for edge, target in enumerate(self.target):
                if not edge & 4095:
                    self.look()
                edges[place[target]] = edge
                place[target] += 1
            self.entering = first, edges
        return self.entering

    def split(self, edge: int, remaining: list[int]) -> None:
        """Puts nodes on an edge, where so much of its time remains; the last one comes last."""
        source, target, left = self.source[edge], self.target[edge], self.time[edge]
        for rest in remaining:
            node = len(self)
            self.target[edge], self.time[edge] = node, left - rest
            edge, left = len(self.target), rest
            self.source.append(node)
            self.target.append(target)
            self.time.append(rest)
            self.step.append(-1)
            self.first.append(len(self.target))
            self.origin.append(source)
        self.entering = None

    def extend(self, values: bytearray) -> bytearray:
        """The values of nodes, those of newer nodes added: as at the source of their edge."""
        for node in range(len(values), len(self)):
            values.append(values[self.origin[node]])
        return values
