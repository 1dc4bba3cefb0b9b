"""All paths that two bodies can take together, and whether they do the same on each.

One path is run after another, from the start; where a condition can go both ways, the other way is
kept for later. What the solver cannot tell within its bound counts as possible.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import field

import z3

from rebsync.checker.program import Kind
from rebsync.checker.symbolic.execution import Execution, Unproved
from rebsync.checker.symbolic.terms import Condition, Term, differ, is_word, symbol
from rebsync.records import dataclass

PATHS = 300
_INSTRUCTIONS = 40_000  # on all paths
_EFFORT = 3_000_000  # steps of the solver for all questions: the same on every machine
_QUESTION = 300_000  # for one


class _Asking:
    """Asks the solver, as long as all answers together take it no more than its steps."""

    def __init__(self, assumptions: Iterable[Condition]) -> None:
        self.solver = z3.Solver()
        self.solver.set("rlimit", _QUESTION)
        self.solver.add(*assumptions)
        self.solver.check()  # what z3 counts goes on from one solver to the next
        self.most = self._taken() + _EFFORT

    def may_hold(self, condition: Condition) -> bool:
        """Whether a condition can hold, or it is not known. Unproved: too much was asked."""
        found = self.solver.check(condition)
        if self._taken() > self.most:
            raise Unproved("it takes the solver too long")
        return bool(found != z3.unsat)

    def _taken(self) -> int:
        return int(self.solver.statistics().get_key_value("rlimit count"))


@dataclass(eq=False)
class Path:
    """One path: the ways that were taken so far, and then the first one that is possible."""

    asking: _Asking
    ways: list[bool]
    others: list[list[bool]] = field(default_factory=list)
    taken: int = 0

    def decide(self, condition: Condition) -> bool:
        """Which way a condition goes."""
        if z3.is_true(condition) or z3.is_false(condition):
            return bool(z3.is_true(condition))
        if self.taken == len(self.ways):
            self._open(condition)
        way = self.ways[self.taken]
        self.taken += 1
        self.asking.solver.add(condition if way else z3.Not(condition))
        return way

    def _open(self, condition: Condition) -> None:
        way = self.asking.may_hold(condition)
        if way and self.asking.may_hold(z3.Not(condition)):
            self.others.append([*self.ways, False])
        self.ways.append(way)

    def choose(self, number: int, options: tuple[int, ...]) -> Term:
        """What a choice gives: the same for both bodies where they choose alike."""
        kind: Kind = "int" if all(map(is_word, options)) else "double"
        chosen = symbol(f"choice {number} of {options}", kind)
        self.asking.solver.add(z3.Or([chosen == option for option in options]))
        return chosen


def prove_alike(
    assumptions: Iterable[Condition], run: Callable[[Path], tuple[Execution, Execution]]
) -> None:
    """Runs two bodies on every path that inputs with the assumptions can take.

    Unproved: they may differ on one, or there are too many.
    """
    asking = _Asking(assumptions)
    waiting: list[list[bool]] = [[]]
    steps = 0
    for _ in range(PATHS):
        if not waiting:
            return
        if steps > _INSTRUCTIONS:
            break
        path = Path(asking, waiting.pop())
        asking.solver.push()
        left, right = run(path)
        _compare(left, right, asking)
        asking.solver.pop()
        steps += left.steps + right.steps
        waiting += path.others
    raise Unproved("there are too many paths, or they are too long")


def _compare(left: Execution, right: Execution, asking: _Asking) -> None:
    if [(e.what, len(e.terms)) for e in left.events] != [
        (e.what, len(e.terms)) for e in right.events
    ]:
        raise Unproved("they may do other things")
    pairs = [
        *zip(left.seen(), right.seen(), strict=True),
        *(
            pair
            for a, b in zip(left.events, right.events, strict=True)
            for pair in zip(a.terms, b.terms, strict=True)
        ),
    ]
    apart = [differ(a, b) for a, b in pairs]
    if asking.may_hold(z3.Or([d for d in apart if not z3.is_false(d)])):
        raise Unproved("they may do the same with other values")
