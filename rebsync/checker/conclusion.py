"""What a search tells about a model and its properties, and what the whole state space does."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import field, replace
from itertools import islice

from rebsync.checker.confirming import confirmed
from rebsync.checker.exploration import Event, Exploration, Search
from rebsync.checker.formulas import Atom, NamedFormula
from rebsync.checker.graph import Graph
from rebsync.checker.invariants import predicates_of
from rebsync.checker.look import Stopped
from rebsync.checker.measures import measure_ranges, times_between
from rebsync.checker.memory import NO_MEMORY, peak_memory
from rebsync.checker.naming import coverage_of, event_name
from rebsync.checker.problem import Options, Problem
from rebsync.checker.program import Program
from rebsync.checker.result import MeasureRange, Result, Verdict, Violation
from rebsync.checker.standstill import ENDLESS, LEAVES, cycle_from, may_stand_still
from rebsync.checker.steps import Failure, ViolationKind
from rebsync.checker.telling import Teller
from rebsync.checker.trace import Trace
from rebsync.checker.watch import Watch
from rebsync.properties import Property
from rebsync.records import dataclass

FLOATING_CAVEAT = (
    "the floating view of a model with delay leaves overflow, state properties and races of "
    "priorities undecided: use --semantics tts"
)
CYCLE_CAVEAT = "time can stand still for ever in a cycle of steps, which can also be left"

_EDGE = 20  # bytes for each edge of a graph


@dataclass
class Conclusion:
    """What has been found out so far."""

    problem: Problem
    options: Options
    program: Program
    formulas: tuple[NamedFormula, ...]
    search: Search
    exploration: Exploration
    teller: Teller
    watch: Watch
    reason: str | None = None
    undecided: str | None = None
    violations: list[Violation] = field(default_factory=list)
    caveats: list[str] = field(default_factory=list)
    between: tuple[MeasureRange, ...] = ()
    verdicts: dict[str, Verdict] = field(default_factory=dict)
    temporal_seconds: float | None = None
    _graph: Graph | None = None
    _assertions: dict[int, list[Property]] | None = None
    _traces: dict[tuple[int, int], Trace] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.reason = self.exploration.reason

    @property
    def complete(self) -> bool:
        """Whether all was seen, and no bound has been reached since."""
        return self.reason is None

    def graph(self) -> Graph:
        """The state space. Raises Stopped when there is no memory left for it."""
        if self._graph is None:
            found = self.exploration
            words = max(1, -(-len(self.program.predicates) // 64))
            size = found.states * 8 * (1 + words) + found.transitions * _EDGE
            self.watch.begin("storing all steps", size)
            self._graph = self.search.graph(self.watch)
        return self._graph

    @contextmanager
    def _within_bounds(self) -> Iterator[None]:
        """What a bound, or the user, ends in here leaves everything after it undetermined."""
        try:
            yield
        except Stopped as stopped:
            self.reason = str(stopped)
        except KeyboardInterrupt:
            self.reason = "it was interrupted"
        except MemoryError:
            self.reason = NO_MEMORY

    # --- collecting

    def collect(self) -> None:
        """Looks at all that the search met, then at what only the whole state space can tell."""
        exploration = self.exploration
        if self.program.has_delay and exploration.semantics == "ftts":
            self.caveats.append(FLOATING_CAVEAT)
        self.caveats += exploration.notes
        for event in exploration.events:
            if isinstance(event.cause, int):
                self._assertion(event, event.cause)
            elif event.cause == "deadlock":
                self._deadlock(event)
            elif isinstance(event.cause, Failure):
                self._failure(event, event.cause)
        self._assertions_that_hold()
        began = time.perf_counter()
        self._temporal()
        if self.problem.properties.ltl or self.problem.properties.tctl:
            self.temporal_seconds = time.perf_counter() - began
        if exploration.semantics != "core" and self.complete and may_stand_still(self.program):
            with self._within_bounds():
                self._standstill()
        if (asked := self.problem.between) and self.complete:
            with self._within_bounds():
                known = self.graph(), self.watch, self.search.path, self.teller.trace
                self.between = times_between(asked, self.program, self.exploration.engine, *known)

    def _add(self, kind: ViolationKind, name: str, message: str, line: int, trace: Trace) -> None:
        if any((v.kind, v.name) == (kind, name) for v in self.violations):
            return
        file = self.problem.source.path
        self.violations.append(Violation(kind, name, message, file, line, trace))

    def _trace(self, event: Event) -> Trace:
        path = confirmed(self.teller, self.search.path(event.state), event)
        key = event.state, event.ordinal
        if key not in self._traces:  # many assertions can be false in one state
            self._traces[key] = self.teller.trace(path, event.ordinal)
        return self._traces[key]

    def _failure(self, event: Event, failure: Failure) -> None:
        body = self.program.body_at(failure.pc)
        if self._of_predicate(failure):
            self._without_value(event, failure)
            return
        trace = self._trace(event)
        line = self.teller.line(self.program.spans[failure.pc])
        rebec = self.teller.rebec_at(self.search.path(event.state), failure.rebec)
        failure = replace(failure, rebec=rebec)
        name = event_name(failure, body, line, self.program)
        self._add(failure.kind, name, trace.steps[-1].failure or "", line, trace)

    def _deadlock(self, event: Event) -> None:
        if "deadlock" not in self.options.allowed:
            message = "no message is left, and nobody has anything to do"
            self._add("deadlock", "deadlock", message, 0, self._trace(event))

    # --- properties

    def _entries(self) -> Iterator[tuple[Property, NamedFormula]]:
        yield from zip(self.problem.properties.all, self.formulas, strict=True)

    def _of_predicate(self, failure: Failure) -> bool:
        return failure.rebec < 0

    def _without_value(self, event: Event, failure: Failure) -> None:
        """A property that divides by zero, or reads beyond an array, in some state."""
        for entry, formula in self._entries():
            for number in predicates_of(formula):
                body = self.program.bodies[self.program.predicates[number]]
                if body.entry <= failure.pc < body.end:
                    what = "divides by zero" if failure.kind == "division" else "has no such index"
                    self.verdicts[entry.name] = "violated"
                    message = f"it {what} in this state"
                    path = self.search.path(event.state)
                    self._property(failure.kind, entry, message, path, self._trace(event))

    def _assertion(self, event: Event, predicate: int) -> None:
        for entry in self._asserted().get(predicate, ()):
            self.verdicts[entry.name] = "violated"
            message, path = "it is false in this state", self.search.path(event.state)
            self._property("property", entry, message, path, self._trace(event))

    def _asserted(self) -> dict[int, list[Property]]:
        """The assertions by the predicates that they are."""
        if self._assertions is None:
            self._assertions = {}
            for entry, formula in zip(
                self.problem.properties.assertions, self.formulas, strict=False
            ):
                if isinstance(formula.formula, Atom):
                    self._assertions.setdefault(formula.formula.predicate, []).append(entry)
        return self._assertions

    def _property(
        self,
        kind: ViolationKind,
        entry: Property,
        message: str,
        path: tuple[int, ...],
        trace: Trace,
    ) -> None:
        from rebsync.checker.marking import true_defines

        source = self.problem.property_source
        place, line, formula = "", 0, ""
        if source:
            place, line = source.path, source.position(entry.name_span.start).line
            formula = " ".join(source.slice(entry.formula.span).split())
        states = self.teller.states(path)
        true = true_defines(self.problem, entry, states, self.exploration.semantics)
        found = Violation(kind, entry.name, message, place, line, trace, formula, true)
        self.violations.append(found)

    def _assertions_that_hold(self) -> None:
        for entry in self.problem.properties.assertions:
            known: Verdict = "satisfied" if self.complete else "undetermined"
            self.verdicts.setdefault(entry.name, known)

    def _temporal(self) -> None:
        entries = list(islice(self._entries(), len(self.problem.properties.assertions), None))
        if not entries:
            return
        from rebsync.checker.deciding import FAIRNESS_CAVEATS

        if self.problem.properties.ltl and self.options.fairness != "none":
            self.caveats.append(FAIRNESS_CAVEATS[self.options.fairness])
        for entry, formula in entries:
            known = self.verdicts.setdefault(entry.name, "undetermined")
            if known == "undetermined" and self.complete:
                with self._within_bounds():
                    self._decide(entry, formula)

    def _decide(self, entry: Property, formula: NamedFormula) -> None:
        """Decides a temporal property; raises Stopped when that takes too much."""
        from rebsync.checker import deciding

        branching = entry in self.problem.properties.tctl
        if self.exploration.semantics != "tts" and deciding.has_bound(formula.formula):
            self.undecided = deciding.EXACT_ONLY
            return
        graph = self.graph()
        self.watch.begin(f"deciding {formula.name}")
        found = deciding.refutation(
            graph,
            formula.formula,
            branching,
            self.options.fairness,
            self.watch,
            self.exploration.engine == "compiled",
        )
        self.verdicts[entry.name] = "violated" if found else "satisfied"
        if found:
            run = found.run
            start = graph.initial[run.prefix[0]]
            way = graph.codes(start, (*run.prefix[1:], *(run.cycle or ())))
            path = (*self.search.path(start), *way)
            trace = self.teller.trace(path, loop=len(run.prefix) - 1 if run.cycle else None)
            self._property("property", entry, found.message, path, trace)
            if not branching and run.cycle and self.options.fairness == "none":
                self._ask_fair(entry, formula)

    def _ask_fair(self, entry: Property, formula: NamedFormula) -> None:
        """Says whether a refuted formula of LTL holds on the weakly fair runs."""
        from rebsync.checker.deciding import HOLDS_FAIRLY, refutation

        is_compiled = self.exploration.engine == "compiled"
        if self.graph().order > 1:  # an orbit may be served where one of its rebecs starves
            return
        if not refutation(self.graph(), formula.formula, False, "weak", self.watch, is_compiled):
            self.caveats.append(HOLDS_FAIRLY.format(entry.name))

    # --- time that stands still

    def _standstill(self) -> None:
        marks = self.search.marks(self.graph())
        if ENDLESS in marks:
            state, prefix, cycle = cycle_from(self.graph(), marks)
            start, codes = self.search.path(state), self.graph().codes(state, (*prefix, *cycle))
            loop = len(start) + len(prefix) - 1
            trace = self.teller.trace((*start, *codes), loop=loop)
            message = "from here on time advances on no run, and steps go on for ever"
            self._add("zeno", "zeno", message, 0, trace)
        elif ENDLESS | LEAVES in marks:
            self.caveats.append(CYCLE_CAVEAT)

    # --- the answer

    def result(self, seconds: float) -> Result:
        """The answer as a value; `seconds` is what all of it took."""
        found = self.exploration
        verdict: Verdict = "satisfied"
        if self.violations:
            verdict = "violated"
        elif self.reason or self.undecided:
            verdict = "undetermined"
        names = [entry.name for entry in self.problem.properties.all]
        return Result(
            verdict,
            self.reason or self.undecided,
            tuple(self.caveats),
            tuple((name, self.verdicts[name]) for name in names),
            tuple(self.violations),
            coverage_of(self.program, found.covered, self.problem.source),
            found.states,
            found.transitions,
            found.depth,
            found.semantics,
            found.engine,
            seconds,
            found.seconds,
            found.build_seconds,
            max(peak_memory(), found.memory),
            (*measure_ranges(self.problem.measures, found.measured, self._run_to), *self.between),
            self.temporal_seconds,
        )

    def _run_to(self, state: int) -> Trace:
        return self._trace(Event("", state))
