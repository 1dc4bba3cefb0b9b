"""Which reduction of the state space a search uses: the one that is asked for, or one that pays.

By itself a search reduces nothing but large spaces, of which no more is asked than assertions and
what is always checked. The first states are searched in full: what has no more of them, or is
violated there, is told as it is. Then

* symmetries are used where there are any: verdicts, kinds of violations and lengths of shortest
  runs are those of the full search (`symmetry.py`);
* or persistent sets, where as many states lead clearly further with them: verdicts are those of the
  full search, runs may be longer (`reduction.py`). So where something is violated all orders are
  searched after all.

The choice goes by numbers of states alone, so that one model has one answer on all machines.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from rebsync.checker.engines import explore, resume
from rebsync.checker.exploration import Exploration, Limits, Report, Search, bound_of_states
from rebsync.checker.problem import Options, Problem
from rebsync.checker.program import Program
from rebsync.checker.reduction import PersistentSets, persistent_sets
from rebsync.checker.search import FIRST
from rebsync.checker.standstill import may_stand_still
from rebsync.checker.steps import Failure, Semantics
from rebsync.checker.symmetry import Symmetry, symmetry_of, symmetry_or_reason

TRIAL = 1000  # states that are searched in full before anything is reduced
FURTHER = 1.25  # how much further the same number of states must lead with persistent sets
GROUP = 120  # permutations at most: with more, a space that is not large takes longer

ALL_ORDERS = "nothing is left out: what is reached beyond an overflow depends on the order of steps"
SHORTEST = "nothing is left out: so the runs that violate something are the shortest"
LONGER = "orders of steps were left out, and runs may be longer than the shortest: then {}"
LEFT_OUT = "orders of steps that cannot matter are left out: --no-reduce counts all states"
COUNTED_ONCE = "symmetry reduces the states: --no-reduce counts all"


class Searched(NamedTuple):
    """A search, what it found, and what reduced it."""

    search: Search
    exploration: Exploration
    persistent: PersistentSets = ()
    symmetry: Symmetry = Symmetry()


class Reducing(NamedTuple):
    """What is searched; `asks_more` than assertions and what is always checked."""

    program: Program
    semantics: Semantics
    invariants: tuple[int, ...]
    problem: Problem
    options: Options
    report: Report | None
    asks_more: bool

    def searched(self) -> Searched:
        """Searches. Raises RebsyncError for symmetries that are asked for and do not exist."""
        options = self.options
        if self._may_choose():
            return self._chosen()
        reduces = options.reduce and not self.asks_more
        persistent = persistent_sets(self.program, self.semantics) if reduces else ()
        symmetry = symmetry_of(self.program, self.problem, options)
        found = self._explored(options, persistent, symmetry)
        if persistent and found.exploration.reason is None and _overflows(found.exploration):
            return _in_all_orders(found, self._explored(options), ALL_ORDERS)
        return found

    def _explored(
        self, options: Options, persistent: PersistentSets = (), symmetry: Symmetry | None = None
    ) -> Searched:
        symmetry = symmetry or Symmetry()
        known = self.program, self.semantics, self.invariants, persistent, symmetry
        return Searched(*explore(*known, options, self.report), persistent, symmetry)

    def _may_choose(self) -> bool:
        options, most = self.options, self.options.limits.states
        is_open = options.auto_reduce and not (options.reduce or options.symmetry)
        is_large = most is None or most > TRIAL
        return is_open and is_large and not (options.cluster or self.asks_more)

    def _chosen(self) -> Searched:
        """A search that reduces what it is worth to reduce."""
        options, bound = self.options, bound_of_states(TRIAL)
        trial = replace(options, limits=replace(options.limits, states=TRIAL))
        full = self._explored(trial)
        if full.exploration.reason != bound:
            return full
        symmetry = symmetry_or_reason(self.program, self.problem, options, GROUP)
        if isinstance(symmetry, Symmetry):
            return _noted(self._explored(options, (), symmetry), COUNTED_ONCE)
        if persistent := self._persistent(full.exploration):
            reduced = self._explored(trial, persistent)
            if _leads_further(reduced.exploration, full.exploration):
                return self._in_fewer_orders(full, reduced)
        return self._resumed(full)

    def _persistent(self, found: Exploration) -> PersistentSets:
        """The persistent sets, where verdicts and lengths of runs will be those of all orders."""
        if _is_violated(found, self.options.limits) or may_stand_still(self.program):
            return ()
        return persistent_sets(self.program, self.semantics)

    def _in_fewer_orders(self, full: Searched, reduced: Searched) -> Searched:
        """Goes on with persistent sets; then with all orders, if something is violated."""
        if reduced.exploration.reason is not None:
            reduced = self._resumed(reduced)
        found = reduced.exploration
        if found.reason in (None, FIRST) and _is_violated(found, self.options.limits):
            return _in_all_orders(reduced, self._resumed(full), SHORTEST)
        return _noted(reduced, LEFT_OUT)

    def _resumed(self, begun: Searched) -> Searched:
        search, exploration = resume(begun.search, self.options, self.report)
        return begun._replace(search=search, exploration=exploration)


def _leads_further(reduced: Exploration, full: Exploration) -> bool:
    """Whether a search with persistent sets is over, or clearly further for as many states."""
    return reduced.reason is None or reduced.depth >= FURTHER * full.depth


def _in_all_orders(reduced: Searched, full: Searched, note: str) -> Searched:
    """What all orders tell; what some of them do if a bound has ended the search of all.

    Beyond an overflow some orders alone do not decide anything that holds.
    """
    if full.exploration.reason in (None, FIRST):
        return _noted(full, note)
    found = reduced.exploration
    reason = full.exploration.reason if _overflows(found) else found.reason
    kept = reduced._replace(exploration=replace(found, reason=reason))
    return _noted(kept, LONGER.format(full.exploration.reason))


def _noted(found: Searched, note: str) -> Searched:
    notes = (*found.exploration.notes, note)
    return found._replace(exploration=replace(found.exploration, notes=notes))


def _is_violated(found: Exploration, limits: Limits) -> bool:
    return any(limits.faults.includes(event.cause) for event in found.events)


def _overflows(found: Exploration) -> bool:
    """Whether a bag was too full in some run."""
    causes = [event.cause for event in found.events]
    return any(isinstance(cause, Failure) and cause.kind == "overflow" for cause in causes)
