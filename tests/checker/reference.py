"""The reference: all that a model can do, found slowly, straight from docs/semantics.md.

It knows nothing of rebsync.checker.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

from rebsync.source import Source
from rebsync.static import Analysis
from tests.checker.reference_steps import Explorer, State, View, Violation, is_dead


@dataclass
class Outcome:
    """What there is; `complete` is false when a bound was met."""

    states: int = 0
    transitions: int = 0
    depth: int = 0
    failures: set[Violation] = field(default_factory=set)
    deadlock: bool = False
    zeno: bool = False
    suspends: bool = False
    complete: bool = True
    reached: list[State] = field(default_factory=list)
    edges: list[list[tuple[int, int]]] = field(default_factory=list)  # target or -1, time


def explore(
    analysis: Analysis, source: Source, view: View, most: int = 3000, until: int | None = None
) -> Outcome:
    """Visits every state, breadth first; gives up beyond `most` states."""
    explorer = Explorer.of(analysis, source, view)
    outcome = Outcome()
    numbers: dict[object, int] = {}
    waiting: deque[tuple[int, int]] = deque()

    def number(state: State, level: int) -> int:
        key = explorer.identity(state)
        if key not in numbers:
            numbers[key] = len(numbers)
            outcome.reached.append(state)
            outcome.edges.append([])
            outcome.depth = level
            outcome.deadlock |= is_dead(state)
            outcome.suspends |= any(a.stand is not None for a in state.actors)
            waiting.append((numbers[key], level))
        return numbers[key]

    for result in explorer.initial():
        if isinstance(result, Violation):
            outcome.failures.add(result)
        else:
            number(result, 0)
    while waiting:
        at, level = waiting.popleft()
        state = outcome.reached[at]
        for result in explorer.steps(state):
            if isinstance(result, State) and until is not None and result.time > until:
                outcome.complete = False
                continue
            outcome.transitions += 1
            if isinstance(result, Violation):
                outcome.failures.add(result)
                outcome.edges[at].append((-1, 0))
            else:
                outcome.edges[at].append((number(result, level + 1), result.time - state.time))
        if len(numbers) > most:
            outcome.complete = False
            break
    outcome.states = len(numbers)
    outcome.zeno = view != "core" and _is_zeno(outcome)
    return outcome


def _is_zeno(outcome: Outcome) -> bool:
    """Whether some endless run can neither let time pass nor come to a deadlock."""
    edges = outcome.edges
    before: list[list[int]] = [[] for _ in edges]
    for source, leaving in enumerate(edges):
        for target, _ in leaving:
            if target >= 0:
                before[target].append(source)
    freed = {s for s, e in enumerate(edges) if any(time for _, time in e)}
    freed |= {s for s, state in enumerate(outcome.reached) if is_dead(state)}
    spreading = list(freed)
    while spreading:
        new = {s for s in before[spreading.pop()] if s not in freed}
        freed |= new
        spreading += new
    stuck = set(range(len(edges))) - freed
    while ended := {s for s in stuck if not any(t in stuck for t, _ in edges[s])}:
        stuck -= ended
    return bool(stuck)
