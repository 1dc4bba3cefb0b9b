"""A state space that moves together with an automaton.

A node is a state of each; its key is state * (states of the automaton) + state of the automaton.
Every edge of the product reaches *goals*, as bits: an until whose promise it does not make, what
fairness asks for, and one that every edge reaches. A cycle stands for runs that are accepted and
fair when its edges together reach all goals.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterator, Sequence
from dataclasses import field
from typing import Literal, TypeAlias

from rebsync.checker.graph import Graph
from rebsync.checker.look import Look, unwatched
from rebsync.checker.temporal.buchi import Automaton
from rebsync.records import dataclass

Fairness: TypeAlias = Literal["none", "weak", "progress"]
Classes: TypeAlias = "Callable[[Graph, tuple[int, ...]], tuple[array[int], Sequence[int]]]"


@dataclass(frozen=True, slots=True)
class Choice:
    """Where the automaton can go on a state: out of its component, or within it.

    `promises` are those that all moves to the same place of `inside` make. `decides` says that
    whatever follows can be accepted.
    """

    outside: tuple[int, ...]
    inside: tuple[int, ...]
    promises: tuple[int, ...]
    decides: bool


@dataclass(slots=True)
class Product:
    """A graph and an automaton; `full` is the set of all goals."""

    graph: Graph
    automaton: Automaton
    fairness: Fairness
    width: int
    full: int
    look: Look
    labels: array[int] = field(default_factory=lambda: array("i"))  # the class of each state
    values: Sequence[int] = ()  # of each class: bit b is the value of predicate b of the automaton
    _choices: dict[int, Choice] = field(default_factory=dict)

    @staticmethod
    def of(
        graph: Graph, automaton: Automaton, fairness: Fairness, look: Look = unwatched
    ) -> Product:
        """The product, with nothing explored; `look` is called now and then by what takes long."""
        bits = automaton.promises.bit_length() + 1
        if fairness == "weak":
            bits += max(graph.actor, default=-1) + 1
        elif fairness == "progress":
            bits += 1
        width = len(automaton.moves)
        return Product(graph, automaton, fairness, width, (1 << bits) - 1, look)

    @property
    def decisive(self) -> bool:
        """Whether a node from which the automaton accepts everything settles the matter."""
        return self.fairness != "progress" and self.automaton.anything >= 0

    @property
    def shift(self) -> int:
        """The number of goals that are not those of fairness, which come after them."""
        return self.automaton.promises.bit_length() + 1

    def classify(self, classes: Classes | None = None) -> None:
        """Finds out what holds in which state; to be done before anything is explored."""
        find = classes or classes_of
        self.labels, self.values = find(self.graph, self.automaton.predicates)

    def choice(self, state: int, place: int) -> Choice:
        """What the automaton can do in `place` when it reads `state`."""
        key = self.labels[state] * self.width + place
        found = self._choices.get(key)
        if found is None:
            found = self._choices[key] = self.choose(self.values[self.labels[state]], place)
        return found

    def choose(self, values: int, place: int) -> Choice:
        """What the automaton can do in `place` when its predicates have these values."""
        home = self.automaton.home
        outside: dict[int, None] = {}
        inside: dict[int, int] = {}
        for move in self.automaton.moves[place]:
            if move.needs & ~values or move.forbids & values:
                continue
            if home[place] >= 0 and home[move.target] == home[place]:
                inside[move.target] = inside.get(move.target, -1) & move.promises
            else:
                outside[move.target] = None
        decides = self.automaton.anything in (*outside, *inside)
        return Choice(tuple(outside), tuple(inside), tuple(inside.values()), decides)

    def edges(self, key: int) -> Iterator[tuple[int, int, int]]:
        """Edges that stay in the automaton's component: edge of the graph, key, goals.

        In a state without successors the edge is -1: the run stays there for ever.
        """
        state, place = divmod(key, self.width)
        choice = self.choice(state, place)
        if choice.inside:
            moves = self.goals(choice)
            for edge, target, fair in self._steps(state):
                for move, kept in moves:
                    yield edge, target * self.width + move, kept | fair

    def goals(self, choice: Choice) -> list[tuple[int, int]]:
        """The places of moves inside, and the goals that they reach whatever the edge."""
        promises = self.automaton.promises
        pairs = zip(choice.inside, choice.promises, strict=True)
        return [(place, 1 | (promises & ~put_off) << 1) for place, put_off in pairs]

    def _steps(self, state: int) -> list[tuple[int, int, int]]:
        """Edges of the graph with their target and the goals of fairness that they reach."""
        graph, shift = self.graph, self.shift
        live = [
            (edge, graph.target[edge])
            for edge in range(graph.first[state], graph.first[state + 1])
            if graph.target[edge] >= 0
        ]
        if not live:
            return [(-1, state, self.full >> shift << shift)]
        if self.fairness == "none":
            return [(edge, target, 0) for edge, target in live]
        if self.fairness == "progress":
            return [(edge, target, (graph.time[edge] > 0) << shift) for edge, target in live]
        acts = [1 << graph.actor[edge] if graph.actor[edge] >= 0 else 0 for edge, _ in live]
        idle = self.full >> shift
        for rebec in acts:
            idle &= ~rebec
        return [
            (edge, target, (idle | rebec) << shift)
            for (edge, target), rebec in zip(live, acts, strict=True)
        ]


def classes_of(graph: Graph, predicates: tuple[int, ...]) -> tuple[array[int], Sequence[int]]:
    """Classes of states that agree on the predicates, and the values of the predicates in each."""
    if not predicates:
        return array("i", bytes(4 * len(graph))), [0]
    masks: dict[int, int] = {}
    for predicate in predicates:
        masks[predicate // 64] = masks.get(predicate // 64, 0) | 1 << predicate % 64
    columns = [
        [word & mask for word in graph.labels[number :: graph.words]]
        for number, mask in masks.items()
    ]
    numbers: dict[tuple[int, ...], int] = {}
    labels = array("i", (numbers.setdefault(k, len(numbers)) for k in zip(*columns, strict=True)))
    place = {word: position for position, word in enumerate(masks)}
    return labels, [
        sum((key[place[p // 64]] >> p % 64 & 1) << bit for bit, p in enumerate(predicates))
        for key in numbers
    ]
