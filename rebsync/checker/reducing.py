"""Which reduction of the state space a search uses: the one that is asked for, or one that pays.

By itself a search reduces nothing but large spaces, of which no more is asked than assertions and
what is always checked. The first states are searched in full: what has no more of them, or is
violated there, is told as it is. Then

* symmetries are used, where as many states lead clearly further with them: verdicts, kinds of
  violations and lengths of shortest runs are those of the full search (`symmetry.py`);
* or persistent sets, where those do: verdicts are those of the full search, runs may be longer
  (`reduction.py`). So where something is violated all orders are searched after all.

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
from rebsync.checker.symmetry import (
    Symmetry,
    counted_once,
    over_orbits,
    symmetry_of,
    symmetry_or_reason,
)

SMALL = 5000  # states that are searched in full before anything is reduced
TRIAL = 1000  # states by which a reduction is judged
FURTHER = 1.1  # how much further they must lead than as many of the full search
GROUP = 120  # permutations at most: with more, a space that is not large takes longer

ALL_ORDERS = "nothing is left out: what is reached beyond an overflow depends on the order of steps"
COUNTS_ALL = "--no-reduce counts all"
LEFT_OUT = f"orders of steps that cannot matter are left out: {COUNTS_ALL} states"
LONGER = f"orders of steps are left out, and runs may be longer than the shortest: {COUNTS_ALL}"
NONE = Symmetry()


class Searched(NamedTuple):
    """A search, what it found, and what reduced it."""

    search: Search
    exploration: Exploration
    persistent: PersistentSets = ()
    symmetry: Symmetry = NONE


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
        if options.symmetry:
            symmetry = symmetry_of(self.program, self.problem, options)
            return self._over_orbits(self._explored(options, (), symmetry))
        if not options.reduce or self.asks_more:
            return self._explored(options)
        reduced = self._explored(options, persistent_sets(self.program, self.semantics))
        found = reduced.exploration
        if reduced.persistent and found.reason is None and _overflows(found):
            return _in_all_orders(reduced, _noted(self._explored(options), ALL_ORDERS))
        return reduced

    def _explored(
        self, options: Options, persistent: PersistentSets = (), symmetry: Symmetry = NONE
    ) -> Searched:
        known = self.program, self.semantics, self.invariants, persistent, symmetry
        return Searched(*explore(*known, options, self.report), persistent, symmetry)

    def _over_orbits(self, found: Searched, hint: str = "") -> Searched:
        """A search of canonical states, told as one of all."""
        exploration = over_orbits(found.exploration, found.symmetry)
        note = counted_once(found.symmetry, self.program)
        return _noted(found._replace(exploration=exploration), note + hint)

    def _may_choose(self) -> bool:
        options, most = self.options, self.options.limits.states
        is_open = options.auto_reduce and not (options.reduce or options.symmetry)
        is_large = most is None or most > SMALL
        return is_open and is_large and not (options.cluster or self.asks_more)

    def _chosen(self) -> Searched:
        """A search that reduces what it is worth to reduce."""
        full = self._explored(self._up_to(SMALL))
        if not _goes_on(full):
            return full
        depth, trial = len(full.search.path(TRIAL)) - 1, self._up_to(TRIAL)
        if full.exploration.engine == "compiled":  # it is there by now
            trial = replace(trial, engine="compiled")

        def further(persistent: PersistentSets, symmetry: Symmetry = NONE) -> Searched | None:
            reduced = self._explored(trial, persistent, symmetry)
            leads_further = reduced.exploration.depth >= FURTHER * depth
            return self._resumed(reduced) if leads_further or not _goes_on(reduced) else None

        symmetry = symmetry_or_reason(self.program, self.problem, self.options, GROUP)
        if isinstance(symmetry, Symmetry) and (reduced := further((), symmetry)):
            return self._over_orbits(reduced, f"; {COUNTS_ALL}")
        if (persistent := self._persistent(full.exploration)) and (reduced := further(persistent)):
            return self._in_fewer_orders(full, reduced)
        return self._resumed(full)

    def _up_to(self, states: int) -> Options:
        return replace(self.options, limits=replace(self.options.limits, states=states))

    def _persistent(self, found: Exploration) -> PersistentSets:
        """The persistent sets, where verdicts and lengths of runs will be those of all orders."""
        if _is_violated(found, self.options.limits) or may_stand_still(self.program):
            return ()
        return persistent_sets(self.program, self.semantics)

    def _in_fewer_orders(self, full: Searched, reduced: Searched) -> Searched:
        """What persistent sets tell; or all orders, if something is violated.

        So too if a body does not end: all orders may violate something before they come to it.
        """
        found = reduced.exploration
        violated = found.reason in (None, FIRST) and _is_violated(found, self.options.limits)
        if violated or found.cut:
            return _in_all_orders(reduced, self._resumed(full))
        return _noted(reduced, LONGER if found.reason else LEFT_OUT)

    def _resumed(self, begun: Searched) -> Searched:
        """Goes on with a search, if only the number of states has ended its first part."""
        if not _goes_on(begun):
            return begun
        search, exploration = resume(begun.search, self.options, self.report)
        return begun._replace(search=search, exploration=exploration)


def _goes_on(begun: Searched) -> bool:
    """Whether only the number of states has ended the first part of a search."""
    return begun.exploration.reason in (bound_of_states(TRIAL), bound_of_states(SMALL))


def _in_all_orders(reduced: Searched, full: Searched) -> Searched:
    """What all orders tell; what some of them do if a bound has ended the search of all.

    Beyond an overflow some orders alone do not decide anything that holds.
    """
    found, reason = reduced.exploration, full.exploration.reason
    if reason in (None, FIRST) or found.cut:
        return full
    kept = replace(found, reason=reason if _overflows(found) else found.reason)
    return _noted(reduced._replace(exploration=kept), f"{LONGER}, but {reason}")


def _noted(found: Searched, note: str) -> Searched:
    notes = (*found.exploration.notes, note)
    return found._replace(exploration=replace(found.exploration, notes=notes))


def _is_violated(found: Exploration, limits: Limits) -> bool:
    return any(limits.faults.includes(event.cause) for event in found.events)


def _overflows(found: Exploration) -> bool:
    """Whether a bag was too full in some run."""
    causes = [event.cause for event in found.events]
    return any(isinstance(cause, Failure) and cause.kind == "overflow" for cause in causes)
