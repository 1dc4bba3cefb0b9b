"""What the reference and an engine say of one model, in a form in which they can be compared."""

from __future__ import annotations

from dataclasses import dataclass

from rebsync.checker.exploration import Exploration, Limits, Search
from rebsync.checker.lowering import lower
from rebsync.checker.program import Program
from rebsync.checker.steps import Failure
from rebsync.grammars.parser import parse_model
from rebsync.grammars.properties import parse_properties
from rebsync.properties import Properties
from rebsync.property_check import check_properties
from rebsync.source import Source
from rebsync.static import Analysis, analyse
from tests.checker.reference import Outcome, explore
from tests.checker.reference_properties import false_assertions
from tests.checker.reference_steps import View, Violation


@dataclass(frozen=True)
class System:
    """A model that has passed all checks, with its properties."""

    source: Source
    analysis: Analysis
    properties: Properties
    program: Program

    @staticmethod
    def of(model: str, properties: str = "") -> System:
        """Reads both texts; what the static rules refuse is an AssertionError."""
        source = Source("model.rebeca", model)
        parsed = parse_model(source)
        assert parsed.ok, parsed.diagnostics
        analysis = analyse(parsed.model)
        assert not analysis.errors, analysis.errors
        read = Properties()
        if properties:
            formulas = parse_properties(Source("model.property", properties))
            assert formulas.ok, formulas.diagnostics
            read = formulas.properties
            found = check_properties(read, analysis)
            assert not [d for d in found if d.severity.value == "error"], found
        return System(source, analysis, read, lower(analysis, read)[0])

    def invariants(self) -> tuple[int, ...]:
        """The predicates of the assertions, which come first in the file."""
        return tuple(range(len(self.properties.assertions)))


@dataclass(frozen=True)
class Findings:
    """The figures and the verdicts of one exploration."""

    states: int
    transitions: int
    depth: int
    failures: frozenset[Violation]
    false: frozenset[str]
    deadlock: bool


def by_reference(system: System, view: View, most: int, until: int | None = None) -> Outcome:
    """What the reference finds."""
    return explore(system.analysis, system.source, view, most, until)


def findings(system: System, outcome: Outcome) -> Findings:
    """The reference's findings."""
    false = false_assertions(system.analysis, system.properties, outcome.reached)
    failures = frozenset(outcome.failures)
    return Findings(
        outcome.states,
        outcome.transitions,
        outcome.depth,
        failures,
        frozenset(false),
        outcome.deadlock,
    )


def by_engine(system: System, search: Search, until: int | None = None) -> Findings:
    """An engine's findings."""
    return found(system, search.run(Limits(until=until)))


def found(system: System, exploration: Exploration) -> Findings:
    """The findings of a search that is over."""
    program = system.program
    failures, false, deadlock = set(), set(), False
    for event in exploration.events:
        match event.cause:
            case Failure():
                failures.add(_violation(system, event.cause))
            case int(predicate):
                false.add(system.properties.assertions[predicate].name)
            case _:
                deadlock = True
    assert len(exploration.covered.largest) == len(program.rebecs)
    return Findings(
        exploration.states,
        exploration.transitions,
        exploration.depth,
        frozenset(failures),
        frozenset(false),
        deadlock,
    )


def _violation(system: System, failure: Failure) -> Violation:
    program, rebec = system.program, system.program.rebecs[failure.rebec]
    if failure.kind == "deadline":
        return Violation("deadline", rebec.name, program.body_at(failure.pc).name)
    line = system.source.position(program.spans[failure.pc].start).line
    return Violation(failure.kind, rebec.name, line)
