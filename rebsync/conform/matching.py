"""Model x Recording -> Conformance."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

from rebsync.checker.formulas import NamedFormula
from rebsync.checker.problem import Problem
from rebsync.checker.program import Program
from rebsync.checker.steps import Failure
from rebsync.checker.telling import Teller
from rebsync.checker.trace import TraceStep
from rebsync.config import Config
from rebsync.conform import path as run_path
from rebsync.conform.conformance import Conformance, Deviation, Verdict
from rebsync.conform.diagnosis import Diagnosis, shown_step
from rebsync.conform.explanation import explanation
from rebsync.conform.graph import Node, StateGraph
from rebsync.conform.lateness import Clocks
from rebsync.conform.observable import Observable
from rebsync.conform.properties import Evaluation
from rebsync.conform.recording import Event, Recording, Served
from rebsync.conform.search import WIDEST, Search, SearchResult
from rebsync.conform.starts import REACHED, Mode, Start, modes, start
from rebsync.conform.stream import Stream
from rebsync.diagnostics import RebsyncError
from rebsync.records import dataclass
from rebsync.source import Source

LAST = 60  # steps before the end of the comparison that are remembered
STEPS = 150  # that are remembered


@dataclass(frozen=True, slots=True)
class Subject:
    """What a recording is compared with: a model, and how its nodes show what they do."""

    source: Source
    program: Program
    observable: Observable
    formulas: tuple[NamedFormula, ...] = ()
    assertions: int = 0  # how many of the formulas are assertions

    @classmethod
    def of(cls, problem: Problem, config: Config) -> Subject:
        """A model with its properties, and the settings of its package."""
        from rebsync.checker.lowering import lower
        from rebsync.forward.generate import package_name
        from rebsync.forward.view import view

        program, formulas = lower(problem.analysis, problem.properties)
        name = package_name(Path(problem.source.path).stem, config)
        package, _ = view(problem.analysis.model, problem.analysis, config, name)
        observable = Observable.of(program, package)
        return cls(
            problem.source, program, observable, formulas, len(problem.properties.assertions)
        )

    @property
    def time_unit(self) -> float:
        """A unit of model time in seconds."""
        return self.observable.package.settings.time_unit

    @property
    def slack(self) -> float:
        """How late, in seconds, a node may be before it says so."""
        return self.observable.package.settings.slack


def _unseen(_: Event) -> None:
    return


def conform(
    subject: Subject,
    recording: Recording,
    most: int = REACHED,
    keeps_run: bool = False,
    widest: int = WIDEST,
) -> Conformance:
    """Whether a recorded run is a run of the model; `most` states are looked at to synchronise.

    `keeps_run`: the last steps of the run that fits are in the answer. With more than `widest`
    possible states at one moment the search is cut.
    """
    graph = StateGraph(subject.program, subject.observable)
    first = Stream(recording.events(), len(subject.program.rebecs), _unseen)
    hidden = _hidden(subject, first, recording)
    attempt = _Attempt(subject, recording, graph, most, keeps_run, hidden, widest)
    refused: Conformance | None = None
    for mode in modes(graph, first, hidden):
        found = attempt.run(mode)
        if found.verdict not in ("deviates", "undetermined"):
            return found
        if refused is None or found.compared > refused.compared:
            refused = found
        if found.verdict == "undetermined" and mode != "constructors":
            return found
    assert refused is not None
    return _explained(subject, recording, refused)


def _explained(subject: Subject, recording: Recording, found: Conformance) -> Conformance:
    """The answer with what the topics say of its deviation."""
    deviation = found.deviation
    if deviation is None or deviation.rebec not in subject.observable.nodes:
        return found
    rebec = subject.observable.nodes.index(deviation.rebec)
    try:
        said = explanation(deviation, rebec, recording.events(with_sent=True))
    except RebsyncError:  # of what follows, and a note says so
        return found
    return replace(found, deviation=replace(deviation, explanation=said))


def _hidden(subject: Subject, first: Stream, recording: Recording) -> frozenset[int]:
    """The rebecs of which there is no state message in the whole recording."""
    silent = {r for r in range(len(subject.program.rebecs)) if first.get(r, 0) is None}
    if silent and not first.ended:
        for event in recording.events():
            if isinstance(event, Served):
                silent.discard(event.rebec)
                if not silent:
                    break
    return frozenset(silent)


@dataclass(frozen=True, slots=True)
class _Attempt:
    """Comparing a recording with a model, begun in one of the possible ways."""

    subject: Subject
    recording: Recording
    graph: StateGraph
    most: int
    keeps_run: bool
    hidden: frozenset[int]
    widest: int

    def run(self, mode: Mode) -> Conformance:
        """What becomes of it."""
        subject, graph = self.subject, self.graph
        clocks = Clocks(subject.observable.nodes, subject.time_unit)
        stream = Stream(self.recording.events(), len(subject.program.rebecs), clocks.see)
        begun = start(graph, stream, mode, self.most)
        passed = _Passed()
        evaluation = Evaluation(subject.program, subject.formulas, subject.assertions)
        visited = _Visited(graph, subject.source)

        def visit(time: int, node: Node) -> None:
            evaluation.see(time, node)
            if self.keeps_run:
                visited.see(time, node)

        path = run_path.Path(visit) if subject.formulas or self.keeps_run else None
        tail = int(subject.slack / subject.time_unit)
        search = Search(graph, stream, tail, passed, path, self.hidden, self.widest)
        found = search.run(begun.configs, begun.time) if begun.configs else None
        diagnosis = Diagnosis(graph, stream, subject.source, passed.by_rebec, passed.last)
        answer = _Conclusion(
            subject, graph, stream, begun, passed, clocks, diagnosis, self.hidden
        ).of(found)
        is_lost = path is not None and path.is_lost
        is_known = not self.hidden
        properties = evaluation.result(begun.is_middle, is_lost, is_known)
        properties = properties if answer.recorded else ()
        return replace(answer, properties=properties, run=visited.steps())


class _Passed:
    """The last observations that fitted."""

    def __init__(self) -> None:
        self.last: deque[Served] = deque(maxlen=LAST)
        self.by_rebec: dict[int, Served] = {}

    def __call__(self, gone: list[Served]) -> None:
        self.last.extend(sorted(gone, key=lambda served: (served.now, served.stamp)))
        for served in gone:
            self.by_rebec[served.rebec] = served


@dataclass(frozen=True, slots=True)
class _Conclusion:
    subject: Subject
    graph: StateGraph
    stream: Stream
    begun: Start
    passed: _Passed
    clocks: Clocks
    diagnosis: Diagnosis
    hidden: frozenset[int]

    def of(self, found: SearchResult | None) -> Conformance:
        """What there is to say at the end of a search."""
        if self.stream.read == 0 and self.stream.ended:
            return self._undetermined(0, 0, "nothing that the nodes served is in the recording")
        if found is None:
            return self._without_start()
        match found.verdict:
            case "fits" if self.begun.unseen:
                reason = (
                    f"it fits from {self.begun.time} on, but {self.begun.unseen} recorded steps "
                    "up to then could not be compared"
                )
                return self._undetermined(found.compared, found.time, reason)
            case "fits" if self.stream.truncated is not None:
                reason = f"it fits so far, and {self.stream.truncated.why}"
                return self._undetermined(found.compared, found.time, reason)
            case "fits":
                return self._conformance("conforms", found.compared, found.time, found.widest)
            case "cut":
                return self._undetermined(found.compared, found.time, found.reason)
            case "refused":
                return self._refused(found)

    def _refused(self, found: SearchResult) -> Conformance:
        for dead in found.dead:
            self._remember(dead.config.positions)
        deviation = self.diagnosis.of(found)
        if not self.begun.is_whole:
            reason = "no state of the model that was looked at fits, and not all were looked at"
            return self._undetermined(found.compared, found.time, f"{reason}: {deviation.message}")
        verdict: Verdict = "violated" if deviation.kind == "model failure" else "deviates"
        return self._conformance(verdict, found.compared, found.time, found.widest, deviation)

    def _remember(self, positions: tuple[int, ...]) -> None:
        """Takes what the furthest possible state has passed for the last that fitted."""
        gone = []
        for rebec, position in enumerate(positions):
            before = self.stream.first(rebec)
            for number in range(before, position):
                served = self.stream.at_hand(rebec, number)
                if served is not None:
                    gone.append(served)
        self.passed(gone)

    def _without_start(self) -> Conformance:
        wrong = self.begun.mismatch
        if wrong is not None:
            name = self.subject.observable.nodes[wrong.rebec]
            why = "the model constructs it otherwise"
            if self.begun.is_middle:
                why = "it has no such message server"
            message = f"{name} {shown_step(wrong)}: {why}"
            deviation = Deviation("no start", name, self.begun.time, message, wrong, 0)
            return self._conformance("deviates", 0, 0, 0, deviation)
        if not self.begun.is_whole:
            reason = "the recording begins in the middle, and the model has too many states to find"
            return self._undetermined(0, self.begun.time, f"{reason} the one where it does")
        message = f"no reachable state of the model fits what is recorded around {self.begun.time}"
        deviation = Deviation("no start", "", self.begun.time, message, None, 0)
        return self._conformance("deviates", 0, self.begun.time, 0, deviation)

    def _undetermined(self, compared: int, time: int, reason: str) -> Conformance:
        return self._conformance("undetermined", compared, time, 0, reason=reason)

    def _conformance(
        self,
        verdict: Verdict,
        compared: int,
        time: int,
        widest: int,
        deviation: Deviation | None = None,
        reason: str = "",
    ) -> Conformance:
        notes: list[str] = []
        try:
            self.stream.read_to_end()
        except RebsyncError as error:
            if deviation is None:
                raise
            why = error.findings[0].diagnostics[0].message
            notes.append(f"what follows the deviation cannot be read: {why}")
        if self.stream.truncated is not None and not reason:
            notes.append(self.stream.truncated.why)
        notes += self.clocks.notes()
        for rebec in sorted(self.hidden):
            name = self.subject.observable.nodes[rebec]
            notes.append(f"no state of {name} was recorded: it may do all that the model allows")
        for rebec in sorted({*self.begun.missing} - self.hidden):
            name = self.subject.observable.nodes[rebec]
            notes.append(f"the state of {name} after its constructor was not recorded")
        if self.begun.is_middle and self.stream.read:
            at = self.begun.time
            count = len(self.begun.configs)
            notes.insert(
                0,
                f"the recording begins in the middle: compared from {at} on, "
                f"with {count} possible states",
            )
        return Conformance(
            verdict,
            max(compared - self.begun.skipped, 0),
            self.stream.read,
            self.begun.time,
            time,
            reason,
            deviation,
            self.clocks.lateness(),
            tuple(notes),
            tuple(self.passed.last),
            widest,
        )


class _Visited:
    """The states of the run that were visited last."""

    def __init__(self, graph: StateGraph, source: Source) -> None:
        self._teller = Teller(graph.view, source)
        self._last: deque[tuple[int, Node]] = deque(maxlen=STEPS)

    def see(self, time: int, node: Node) -> None:
        """The next state."""
        self._last.append((time, node))

    def steps(self) -> tuple[TraceStep, ...]:
        """The steps between them."""
        return tuple(self._steps())

    def _steps(self) -> Iterator[TraceStep]:
        for number, ((time, before), (_, after)) in enumerate(pairwise(self._last), 1):
            for step in before.steps():
                if not isinstance(step.result, Failure) and step.result == after.state:
                    yield self._teller.step(number, time, before.state, step)
                    break
