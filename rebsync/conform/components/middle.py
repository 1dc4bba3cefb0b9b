"""Where a component may be that was recorded from the middle of its run on."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from itertools import product
from math import inf

from rebsync.checker.endless import EndlessBody
from rebsync.conform.components.bodies import BodyRun
from rebsync.conform.components.component import Cells, Component, Timing
from rebsync.conform.components.hypotheses import Hypothesis, Posted
from rebsync.conform.observable import kinds
from rebsync.records import dataclass

_MOST_INPUTS = 1_000  # different messages that may have come before
_MOST_WAITING = 8  # messages that a rebec has posted to itself

_Posts = tuple[tuple[int, Cells], ...]
_Place = tuple[Cells, _Posts]


@dataclass(frozen=True, slots=True)
class Middle:
    """The states that a rebec may be in, `is_whole` if no other can be reached.

    Inputs before the recording are taken to have had values that were recorded, or any truth
    values; where they may have had others, there may be other states.
    """

    starts: tuple[Hypothesis, ...]
    is_whole: bool


def middle(component: Component, most: int) -> Middle:
    """The reachable states, up to so many; times play no part in what can be reached."""
    inputs, is_whole = _alphabet(component)
    is_whole &= not component.program.has_delay  # else a body may be at work
    try:
        begun = [(r.variables, _posts(r)) for r in component.bodies.constructed() if not r.failure]
        seen: set[_Place] = set(begun)
        work = deque(begun)
        while work:
            place = work.popleft()
            for after in _successors(component, place, inputs):
                if after not in seen:
                    if len(seen) >= most or len(after[1]) > _MOST_WAITING:
                        is_whole = False
                        continue
                    seen.add(after)
                    work.append(after)
    except EndlessBody:
        return Middle((), False)
    until = served_before(component.timing)
    starts = tuple(_start(component, place, n) for n in _passed(component, until) for place in seen)
    return Middle(starts, is_whole or _is_all(component, seen))


def _passed(component: Component, until: float) -> Iterator[tuple[int, ...]]:
    """How many messages of each topic were published up to a time; a kept one may be older."""
    counts = (sum(each.stamp <= until for each in outputs) for outputs in component.outputs)
    return product(
        *(
            (0, 1) if is_kept and not count else (count,)
            for count, is_kept in zip(counts, component.kept, strict=True)
        )
    )


def _is_all(component: Component, places: set[_Place]) -> bool:
    """Whether there can be no other states: all variables are truth values, and had all values."""
    slots = component.program.rebecs[component.rebec].state
    cells = [slot.kind for slot in slots for _ in range(slot.size)]
    is_boolean = all(kind == "boolean" for kind in cells) and not component.program.has_delay
    is_posting = any(posts for _, posts in places)
    return is_boolean and not is_posting and len(places) == 2 ** len(cells)


def _posts(run: BodyRun) -> _Posts:
    return tuple(sorted((p.server, p.cells) for p in run.posted))


def _alphabet(component: Component) -> tuple[list[tuple[int, Cells]], bool]:
    """The inputs that may have come before, and whether there are no others."""
    found: dict[tuple[int, Cells], None] = {}
    is_whole = True
    for each in component.inputs:
        found[each.server, each.cells] = None
        if len(found) > _MOST_INPUTS:
            return list(found), False
    for server in {server for server, _ in found}:
        cells = kinds(component.program, server)
        if all(kind == "boolean" for kind in cells) and len(cells) <= 4:
            found |= dict.fromkeys((server, each) for each in product((0, 1), repeat=len(cells)))
        else:
            is_whole = False
    return list(found), is_whole


def _successors(
    component: Component, place: _Place, inputs: list[tuple[int, Cells]]
) -> Iterator[_Place]:
    variables, posts = place
    for post in {*posts}:
        rest = list(posts)
        rest.remove(post)
        for run in component.bodies.runs(variables, *post):
            if run.failure is None:
                yield run.variables, tuple(sorted([*rest, *_posts(run)]))
    for each in inputs:
        for run in component.bodies.runs(variables, *each):
            if run.failure is None:
                yield run.variables, tuple(sorted([*posts, *_posts(run)]))


def _start(component: Component, place: _Place, passed: tuple[int, ...]) -> Hypothesis:
    """A state a little after the recording began: what was published until then is not compared."""
    timing = component.timing
    low = timing.begin + timing.slack
    pending = tuple(sorted(Posted(server, cells, low, inf) for server, cells in place[1]))
    return Hypothesis(low, low, (-inf, -inf), place[0], pending, 0, frozenset(), passed)


def served_before(timing: Timing) -> float:
    """The time up to which inputs may have been served before that state."""
    return timing.begin + 2 * timing.slack
