"""A state space as numbers: what linear and branching time properties are decided on."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator
from dataclasses import field
from functools import partial

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Graph:
    """States are numbered in breadth-first order; the edges of s are first[s] up to first[s + 1].

    `target` is -1 for a failed step. `actor` is the rebec that acts, -1 for a step of time alone;
    `time` is how much time passes with the step (before the target is reached). `labels` holds
    `words` numbers of 64 bits for each state: predicate p is bit p % 64 of word p // 64.
    `deadlocks` are the final states in which nothing can happen any more. `initial` lists the
    initial states. All in one order with the steps of the interpreter, so an edge is an ordinal.
    Of a quotient by a group of some `order`, `turn` numbers what has made the target canonical.
    """

    first: array[int]  # 'Q', one more than there are states
    target: array[int]  # 'q'
    actor: array[int]  # 'i'
    time: array[int]  # 'q'
    labels: array[int]  # 'Q'
    words: int
    initial: tuple[int, ...]
    turn: array[int] = field(default_factory=partial(array, "H"))
    order: int = 1

    def __len__(self) -> int:
        return len(self.first) - 1

    def holds(self, state: int, predicate: int) -> bool:
        """Whether a predicate holds in a state."""
        word = self.labels[state * self.words + predicate // 64]
        return bool(word >> (predicate % 64) & 1)

    def codes(self, state: int, ordinals: Iterable[int]) -> Iterator[int]:
        """The codes of steps from a state on: with their ordinals by what their targets became."""
        for ordinal in ordinals:
            edge = self.first[state] + ordinal
            yield ordinal * self.order + self.turn[edge] if self.order > 1 else ordinal
            state = self.target[edge]
