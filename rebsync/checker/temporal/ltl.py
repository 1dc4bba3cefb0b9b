"""Linear time: does a formula hold on every run?

What a run is, and what the operators mean on it, is said in decision 11. The runs on which the
formula does not hold are those that an automaton accepts; the product of state space and
automaton is searched for a cycle that it accepts.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from rebsync.checker.formulas import Formula
from rebsync.checker.graph import Graph
from rebsync.checker.temporal.buchi import translate
from rebsync.checker.temporal.components import components
from rebsync.checker.temporal.lasso import Lasso, lasso
from rebsync.checker.temporal.product import Fairness, Product
from rebsync.checker.watch import Look, unwatched

__all__ = ["Fairness", "check_ltl"]

_EFFORT = 200_000  # nodes that may be looked at for the very shortest cycle


def check_ltl(
    graph: Graph, formula: Formula, fairness: Fairness = "none", look: Look = unwatched
) -> Lasso | None:
    """A run on which the formula does not hold, or None when it holds on all.

    `fairness` says which infinite runs count: all; those on which no rebec that could always act
    from some moment on never acts ("weak"); those on which time diverges ("progress"). Finite runs
    always count. `look` is called now and then. ValueError: the formula has an operator of TCTL.

    The prefix is the shortest after which nothing can save the formula any more; if there is none,
    the shortest with which the automaton comes into a cycle that it accepts.
    """
    product = Product.of(graph, translate(formula, wanted=False), fairness, look)
    found = _explore(product)
    if found.decided >= 0:
        start, prefix = found.path(product, found.decided)
        return lasso(graph, start, prefix, None)
    component = components(found.first, found.target, look)
    entry = _entry(product, found, component)
    if entry < 0:
        return None
    start, prefix = found.path(product, entry)
    return lasso(graph, start, prefix, _cycle(product, found, component, entry))


@dataclass(slots=True)
class _Reached:
    """The product in breadth-first order.

    `number` gives the node of a key, or -1. `parent` is the node from which a node was met first,
    for an initial one -1 - its position. `first` and `target` have only edges that stay in one
    component of the automaton in which it can accept. `decided` is the first node from which
    every run is accepted, or -1.
    """

    number: array[int]
    keys: array[int]
    parent: array[int]
    first: array[int]
    target: array[int]
    decided: int = -1

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


def _first_edge(graph: Graph, before: int, after: int) -> list[int]:
    """The first edge between two states; none where the run stays in its last state."""
    edges = range(graph.first[before], graph.first[before + 1])
    return [edge for edge in edges if graph.target[edge] == after][:1]


def _explore(product: Product) -> _Reached:
    """Everything that can be reached, up to the first node that decides."""
    graph, width, choice = product.graph, product.width, product.choice
    decisive = product.fairness != "progress" and product.automaton.anything >= 0
    number = array("q", [-1]) * (len(graph) * width)
    keys, parent = array("q"), array("q")
    first, target = array("q", [0]), array("q")
    for position, state in enumerate(graph.initial):
        if number[state * width] < 0:
            number[state * width] = len(keys)
            keys.append(state * width)
            parent.append(-1 - position)
    found = _Reached(number, keys, parent, first, target)
    for node, key in enumerate(keys):  # grows
        if not node & 4095:
            product.look()
        state, place = divmod(key, width)
        moves = choice(state, place)
        if moves.outside or moves.inside:
            if decisive and moves.decides:
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


def _entry(product: Product, found: _Reached, component: array[int]) -> int:
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


def _cycle(product: Product, found: _Reached, component: array[int], entry: int) -> list[int]:
    """The edges of a short cycle through the entry that reaches all goals."""
    number, own = found.number, component[entry]

    def inside(key: int) -> list[tuple[int, int, int]]:
        return [step for step in product.edges(key) if component[number[step[1]]] == own]

    start, full = found.keys[entry], product.full
    steps = _shortest(inside, start, full, lambda key, met: key == start and met == full, _EFFORT)
    if steps is None:
        steps = _pieced(inside, start, full)
    return [edge for edge, _, _ in steps if edge >= 0]


_Step = tuple[int, int, int]  # as Product.edges gives them


def _pieced(inside: Callable[[int], list[_Step]], start: int, full: int) -> list[_Step]:
    """A cycle that goes for one goal after the other, then home."""
    steps: list[_Step] = []
    key, met = start, 0
    while met != full:
        goal = ~met & met + 1  # the lowest one left
        steps += _shortest(inside, key, goal, lambda _, reached: reached != 0) or []
        key = steps[-1][1]
        for _, _, reached in steps:
            met |= reached
    if key != start:
        steps += _shortest(inside, key, 0, lambda key, _: key == start) or []
    return steps


def _shortest(
    inside: Callable[[int], list[_Step]],
    start: int,
    goals: int,
    ends: Callable[[int, int], bool],
    effort: int | None = None,
) -> list[_Step] | None:
    """A shortest way, at least one step long, to where `ends` holds of key and goals met.

    Only the given goals count. None: there is no way, or it takes more than `effort` to find it.
    """
    parent: dict[tuple[int, int], tuple[tuple[int, int], _Step]] = {}
    waiting = [(start, 0)]
    for key, met in waiting:  # grows
        for step in inside(key):
            after = (step[1], met | step[2] & goals)
            if ends(*after):
                steps = [step]
                here = (key, met)
                while here != (start, 0):
                    here, step = parent[here]
                    steps.append(step)
                return steps[::-1]
            if after not in parent and after != (start, 0):
                parent[after] = ((key, met), step)
                waiting.append(after)
        if effort is not None and len(waiting) > effort:
            return None
    return None
