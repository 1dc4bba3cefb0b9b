"""Effects: what a function may read and write, which acts it may do, how it may end.

A summary of each function, joined over what it may call until nothing changes (a worklist over the
call graph: Banning 1979, Cooper and Kennedy 1988). Whatever has no known target, and what has no
lowering, may do anything.
"""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.records import dataclass
from rebsync.reverse.analysis.call_graph import CallGraph, Targets
from rebsync.reverse.analysis.library_effects import LibraryEffect, LibraryTable, nothing_known
from rebsync.reverse.analysis.local_effects import BodyEffects, local_effects
from rebsync.reverse.analysis.locations import Elements, Location, Member, covers
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import ImplicitCall
from rebsync.reverse.ir.program import Program
from rebsync.reverse.ir.walk import statements
from rebsync.source import Span


@dataclass(frozen=True, slots=True)
class Effects:
    """What one call of a function may do, with all that it calls.

    `acts` are the library's callables by which it may do what can be seen outside. With `anything`
    all else is of no account: it may do whatever can be done. `why` are places that make it so.
    """

    reads: frozenset[Location] = frozenset()
    writes: frozenset[Location] = frozenset()
    acts: frozenset[str] = frozenset()
    functions: frozenset[str] = frozenset()
    may_raise: bool = False
    may_block: bool = False
    may_diverge: bool = False
    anything: bool = False
    why: frozenset[tuple[str, Span]] = frozenset()

    def may_read(self, location: Location) -> bool:
        """Whether a location may be read."""
        return self.anything or covers(self.reads, location)

    def may_write(self, location: Location) -> bool:
        """Whether a location may be written."""
        return self.anything or covers(self.writes, location)

    def may_run(self, function: str) -> bool:
        """Whether a function of the program may run meanwhile."""
        return self.anything or function in self.functions

    def join(self, other: Effects) -> Effects:
        """What either may do."""
        return Effects(
            self.reads | other.reads,
            self.writes | other.writes,
            self.acts | other.acts,
            self.functions | other.functions,
            self.may_raise or other.may_raise,
            self.may_block or other.may_block,
            self.may_diverge or other.may_diverge,
            self.anything or other.anything,
            self.why | other.why,
        )


NO_EFFECTS = Effects()
ANYTHING = Effects(may_raise=True, may_block=True, may_diverge=True, anything=True)


class EffectAnalysis:
    """The effects of all functions of a program, with what a table says of libraries."""

    def __init__(self, program: Program, table: LibraryTable = nothing_known) -> None:
        self.graph = CallGraph(program)
        self._table = table
        self._own: dict[str, Effects] = {}
        self._callees: dict[str, frozenset[str]] = {}
        classes = program.classes.values()
        operators = self.graph.implicit({o for c in classes for o, _ in c.operators})
        self._methods = operators | self.graph.suspended
        destructors = self._destructors()
        for name in program.functions:
            self._add(name, local_effects(self.graph, program.function(name)), destructors)
        self._effects = dict(self._own)
        self._solve()

    def of(self, function: str) -> Effects:
        """What a call of a function may do."""
        return self._effects[function]

    def callees(self, function: str) -> frozenset[str]:
        """The functions that a body may call itself, or have called by a library."""
        return self._callees[function]

    def _add(self, name: str, local: BodyEffects, destructors: frozenset[str]) -> None:
        """The effects of a body without what it calls, and what that is."""
        found = Effects(
            local.reads,
            local.writes,
            may_raise=local.may_raise,
            may_block=local.may_block,
            may_diverge=local.may_diverge,
            why=local.unsupported,
        )
        callees = set(local.implicit) | destructors
        if local.unsupported:
            found = found.join(ANYTHING)
        for place, targets in local.calls:
            callees |= targets.functions
            if targets.unknown:
                why = frozenset({("what is called is not known", place)})
                found = found.join(ANYTHING).join(Effects(why=why))
            for library in targets.libraries:
                effects, called = self._library(library, place, targets, local)
                found, callees = found.join(effects), callees | called
        self._own[name] = found.join(Effects(functions=frozenset({name})))
        self._callees[name] = frozenset(callees)

    def _destructors(self) -> frozenset[str]:
        """What may run whenever an object ends: of a generator what stands in a `finally`."""
        found = self.graph.implicit((ImplicitCall.DESTROY,))
        for name in self.graph.suspended:
            body = self.graph.program.function(name).body
            if any(isinstance(n, s.Try | s.With) for n in statements(body)):
                found |= {name}
        return found

    def _library(
        self, name: str, place: Span, targets: Targets, local: BodyEffects
    ) -> tuple[Effects, frozenset[str]]:
        """What a call of a library may do, and which functions it may call."""
        entry = self._table(name)
        if entry is None:
            why = frozenset({(f"nothing is known of {name}", place)})
            return ANYTHING.join(Effects(why=why)), frozenset()
        called: frozenset[str] = frozenset()
        effects = _of_entry(entry, name)
        if entry.calls:
            called |= self._methods
        if entry.applies:
            passed = local.passed.get(place, Targets(unknown=True))
            called |= passed.functions
            if passed.unknown:
                called |= frozenset(self.graph.program.functions)
            for library in passed.libraries - {name}:
                more = self._table(library)
                if more is None or more.applies:
                    return ANYTHING, frozenset()
                effects = effects.join(_of_entry(more, library))
        return effects, called

    def _solve(self) -> None:
        """Joins the effects of callees into their callers until nothing changes."""
        callers: dict[str, set[str]] = {}
        for name, callees in self._callees.items():
            for callee in callees:
                callers.setdefault(callee, set()).add(name)
        waiting = list(self._effects)
        while waiting:
            name = waiting.pop()
            found = self._own[name].join(_all(self._effects[c] for c in self._callees[name]))
            if name in found.functions and self._is_recursive(name):
                found = found.join(Effects(may_diverge=True))
            if found != self._effects[name]:
                self._effects[name] = found
                waiting += callers.get(name, ())

    def _is_recursive(self, name: str) -> bool:
        """Whether a function may run while it runs."""
        return any(name in self._effects[c].functions for c in self._callees[name])


def _of_entry(entry: LibraryEffect, name: str) -> Effects:
    reads: frozenset[Location] = frozenset({Elements(), Member(None)})
    writes: frozenset[Location] = frozenset()
    if entry.elements:
        writes |= {Elements()}
    if entry.members:
        writes |= {Elements(), Member(None)}
    acts = frozenset({name}) if entry.acts or entry.registers else frozenset()
    return Effects(reads, writes, acts, may_raise=entry.raises, may_block=entry.blocks)


def _all(effects: Iterable[Effects]) -> Effects:
    found = NO_EFFECTS
    for each in effects:
        found = found.join(each)
    return found
