"""Whether a product has a run that its automaton accepts, and that is fair: searched in Python.

`templates/product.c` does the same for large ones.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable
from itertools import pairwise
from typing import Protocol, TypeAlias

from rebsync.checker.graph import Graph
from rebsync.checker.temporal.components import components
from rebsync.checker.temporal.product import Product
from rebsync.records import dataclass


class Numbers(Protocol):
    """Numbers by their position."""

    def __getitem__(self, position: int, /) -> int: ...


@dataclass(frozen=True, slots=True)
class Reached:
    """What can be reached of a product, as nodes in breadth-first order, and what was found there.

    `number` gives the node of a key, or -1. `parent` is the node from which a node was met first,
    for an initial one -1 - its position. `decided` is the first node from which every run is
    accepted, or -1; the search ends there. `component` tells nodes apart that are in no cycle
    together which stays in one component of the automaton; `entry` is the first node in a
    component that reaches all goals, or -1.
    """

    number: Numbers
    keys: Numbers
    parent: Numbers
    component: Numbers
    decided: int
    entry: int
    owner: object = None  # what keeps the numbers alive

    def path(self, product: Product, node: int) -> tuple[int, list[int]]:
        """The position of the initial state, and the edges of the graph from there to the node."""
        states = [self.keys[node] // product.width]
        while self.parent[node] >= 0:
            node = self.parent[node]
            states.append(self.keys[node] // product.width)
        states.reverse()
        pairs = pairwise(states)
        return -1 - self.parent[node], [
            edge for before, after in pairs for edge in _first_edge(product.graph, before, after)
        ]


Find: TypeAlias = Callable[[Product], Reached]


def _first_edge(graph: Graph, before: int, after: int) -> list[int]:
    """The first edge between two states; none where the run stays in its last state."""
    edges = range(graph.first[before], graph.first[before + 1])
    return [edge for edge in edges if graph.target[edge] == after][:1]


def search(product: Product) -> Reached:
    """Explores a product, and looks for a component that reaches all goals."""
    product.classify()
    found = _explore(product)
    component = array("q")
    entry = -1
    if found.decided < 0:
        component = components(found.first, found.target, product.look)
        entry = _entry(product, found, component)
    return Reached(found.number, found.keys, found.parent, component, found.decided, entry)


@dataclass(slots=True)
class _Explored:
    """As in Reached; `first` and `target` have only edges that stay in a component of the automaton
    in which it can accept."""

    number: array[int]
    keys: array[int]
    parent: array[int]
    first: array[int]
    target: array[int]
    decided: int = -1


def _explore(product: Product) -> _Explored:
    """Everything that can be reached, up to the first node that decides."""
    graph, width, choice = product.graph, product.width, product.choice
    number = array("q", [-1]) * (len(graph) * width)
    keys, parent = array("q"), array("q")
    first, target = array("q", [0]), array("q")
    for position, state in enumerate(graph.initial):
        if number[state * width] < 0:
            number[state * width] = len(keys)
            keys.append(state * width)
            parent.append(-1 - position)
    found = _Explored(number, keys, parent, first, target)
    for node, key in enumerate(keys):  # grows
        if not node & 4095:
            product.look()
        state, place = divmod(key, width)
        moves = choice(state, place)
        if moves.outside or moves.inside:
            if product.decisive and moves.decides:
                found.decided = node
                break
            after = [t for t in graph.target[graph.first[state] : graph.first[state + 1]] if t >= 0]
            for successor in after or (state,):
                base = successor * width
                for move in moves.outside:
                    if number[base + move] < 0:
                        number[base + move] = len(keys)
                        keys.append(base + move)
                        parent.append(node)
                for move in moves.inside:
                    if number[base + move] < 0:
                        number[base + move] = len(keys)
                        keys.append(base + move)
                        parent.append(node)
                    target.append(number[base + move])
        first.append(len(target))
    return found


def _entry(product: Product, found: _Explored, component: array[int]) -> int:
    """The first node on a cycle that reaches all goals, or -1."""
    full, number = product.full, found.number
    goals: dict[int, int] = {}
    for node, key in enumerate(found.keys):
        if not node & 4095:
            product.look()
        own = component[node]
        if found.first[node] == found.first[node + 1] or goals.get(own) == full:
            continue
        targets = found.target[found.first[node] : found.first[node + 1]]
        if any(component[t] == own for t in targets):
            for _, after, reached in product.edges(key):
                if component[number[after]] == own:
                    goals[own] = goals.get(own, 0) | reached
    fair = {own for own, reached in goals.items() if reached == full}
    return next((n for n in range(len(found.keys)) if component[n] in fair), -1) if fair else -1
