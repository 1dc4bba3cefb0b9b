"""Linear time: does a formula hold on every run?

What a run is, and what the operators mean on it, is said in decision 11. The runs on which the
formula does not hold are those that an automaton accepts; the product of state space and
automaton is searched for a cycle that it accepts.
"""

from __future__ import annotations

from collections.abc import Callable

from rebsync.checker.formulas import Formula
from rebsync.checker.graph import Graph
from rebsync.checker.look import Look, unwatched
from rebsync.checker.temporal.buchi import translate
from rebsync.checker.temporal.emptiness import Find, Reached, search
from rebsync.checker.temporal.lasso import Lasso, lasso
from rebsync.checker.temporal.product import Fairness, Product

__all__ = ["Fairness", "check_ltl"]

_EFFORT = 50_000  # nodes that may be looked at for the very shortest cycle


def check_ltl(
    graph: Graph,
    formula: Formula,
    fairness: Fairness = "none",
    look: Look = unwatched,
    find: Find = search,
) -> Lasso | None:
    """A run on which the formula does not hold, or None when it holds on all.

    `fairness` says which infinite runs count: all; those on which no rebec that could always act
    from some moment on never acts ("weak"); those on which time diverges ("progress"). Finite runs
    always count. `look` is called now and then; `find` searches the product. ValueError: the
    formula has an operator of TCTL.

    The prefix is the shortest after which nothing can save the formula any more; if there is none,
    the shortest with which the automaton comes into a cycle that it accepts.
    """
    product = Product.of(graph, translate(formula, wanted=False, look=look), fairness, look)
    found = find(product)
    if found.decided >= 0:
        start, prefix = found.path(product, found.decided)
        return lasso(graph, start, prefix, None)
    if found.entry < 0:
        return None
    start, prefix = found.path(product, found.entry)
    return lasso(graph, start, prefix, _cycle(product, found))


def _cycle(product: Product, found: Reached) -> list[int]:
    """The edges of a short cycle through the entry that reaches all goals."""
    number, component = found.number, found.component
    own = component[found.entry]

    def inside(key: int) -> list[_Step]:
        product.look()
        return [step for step in product.edges(key) if component[number[step[1]]] == own]

    start, full = found.keys[found.entry], product.full
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
        way = _shortest(inside, key, goal, lambda _, reached: reached != 0)
        assert way, "a component that reaches a goal has a way to it"
        steps += way
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
