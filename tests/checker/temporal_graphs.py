"""Small state spaces, written down or drawn at random, and formulas to ask of them.

Drawn with the generator of Python, not of hypothesis: thousands of them are looked at in a second,
and all of them are small.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterator, Sequence
from random import Random
from typing import Literal

import pytest
from hypothesis import settings

from rebsync.checker.exploration import Unavailable
from rebsync.checker.formulas import And, Atom, Bound, Formula, Not, Or, Temporal, Timed
from rebsync.checker.graph import Graph
from rebsync.checker.temporal import compiled_figures
from rebsync.checker.temporal.figures import FindFigures

# target (-1: the step fails), actor (-1: time), time
Edge = tuple[int, int, int]
Draw = Callable[[Random, int], Formula]
_UNARY: tuple[Literal["AG", "AF", "EG", "EF"], ...] = ("AG", "AF", "EG", "EF")


def random_cases(often: int) -> Iterator[Random]:
    """Generators with different seeds: so many for each example that hypothesis would try."""
    for seed in range(often * settings.default.max_examples if settings.default else often):
        yield Random(seed)


def graph_of(
    edges: Sequence[Sequence[Edge]], labels: Sequence[int], initial: tuple[int, ...] = (0,)
) -> Graph:
    """A state space; bit p of a label is predicate p."""
    first = array("Q", [0])
    for own in edges:
        first.append(first[-1] + len(own))
    every = [edge for own in edges for edge in own]
    return Graph(
        first,
        array("q", (e[0] for e in every)),
        array("i", (e[1] for e in every)),
        array("q", (e[2] for e in every)),
        array("Q", labels),
        1,
        initial,
    )


def in_c() -> FindFigures:
    """What finds the figures of untils in C; without a compiler the test is skipped."""
    try:
        compiled_figures._library()
    except Unavailable as unavailable:
        pytest.skip(f"no C: {unavailable}")
    return compiled_figures.figures_for


def draw_graph(random: Random, most: int = 4, longest: int = 5) -> Graph:
    """A state space with two predicates and two rebecs; edges fail, end or loop anyhow."""
    count = random.randint(1, most)

    def edge() -> Edge:
        target = random.randrange(count) if random.random() < 0.9 else -1
        time = random.choice((0, 0, 1, 1, 2, 3, random.randint(0, longest)))
        return target, random.randrange(-1, 2), time

    edges = [[edge() for _ in range(random.choice((0, 1, 1, 2, 2, 3)))] for _ in range(count)]
    labels = [random.randrange(4) for _ in range(count)]
    initial = tuple(random.randrange(count) for _ in range(random.choice((1, 1, 2))))
    return graph_of(edges, labels, initial)


def draw_linear(random: Random, depth: int) -> Formula:
    """A formula of LTL over two predicates."""
    if depth == 0 or random.random() < 0.1:
        return Atom(random.randrange(2))
    if random.random() < 0.35:
        return _boolean(draw_linear, random, depth)
    if random.random() < 0.6:
        return Temporal(random.choice(("G", "F", "X")), (draw_linear(random, depth - 1),))
    operands = draw_linear(random, depth - 1), draw_linear(random, depth - 1)
    return Temporal(random.choice(("U", "W")), operands)


def draw_timed(random: Random, depth: int) -> Formula:
    """A formula of TCTL over two predicates."""
    if depth == 0 or random.random() < 0.1:
        return Atom(random.randrange(2))
    if random.random() < 0.35:
        return _boolean(draw_timed, random, depth)
    bound = draw_bound(random)
    if random.random() < 0.5:
        return Timed(random.choice(_UNARY), bound, (draw_timed(random, depth - 1),))
    operands = draw_timed(random, depth - 1), draw_timed(random, depth - 1)
    return Timed(random.choice(("AU", "EU")), bound, operands)


def draw_universal(random: Random, depth: int) -> Formula:
    """A formula of TCTL that a single run refutes, whatever other runs there are."""
    chance = random.random()
    if depth == 0:
        return draw_state(random, 1)
    if chance < 0.2:
        return And(draw_universal(random, depth - 1), draw_universal(random, depth - 1))
    if chance < 0.4:
        return Or(draw_state(random, 1), draw_universal(random, depth - 1))
    if chance < 0.7:
        return Timed("AG", draw_bound(random), (draw_universal(random, depth - 1),))
    if chance < 0.85:
        return Timed("AF", draw_bound(random), (draw_state(random, 1),))
    return Timed("AU", draw_bound(random), (draw_state(random, 1), draw_state(random, 1)))


def draw_state(random: Random, depth: int) -> Formula:
    """A formula about one state."""
    if depth == 0 or random.random() < 0.4:
        return Atom(random.randrange(2))
    return _boolean(draw_state, random, depth)


def _boolean(draw: Draw, random: Random, depth: int) -> Formula:
    one = draw(random, depth - 1)
    match random.randrange(3):
        case 0:
            return Not(one)
        case 1:
            return And(one, draw(random, depth - 1))
        case _:
            return Or(one, draw(random, depth - 1))


def draw_bound(random: Random) -> Bound | None:
    """A bound of time, or none."""
    if random.random() < 0.25:
        return None
    return random.choice(("<", "<=", ">", ">=", "==")), random.randint(0, 6)
