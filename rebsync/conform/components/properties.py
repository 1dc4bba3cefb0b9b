"""Properties over topics, evaluated on what was recorded of them.

A state is what was published or got last on each topic that a property names (decision 56). Stamps
are those of the recorder: which of two messages on different topics was first is not known if they
are near each other, nor when one was got. So but for one publisher on one topic only those states
count that lasted longer than messages may be late; and nothing counts before each topic has had a
message. What was recorded is taken to have been got. What is decided on some states of a run, in
their order, by `G` and `F` over state predicates, holds of the whole run.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from typing import Literal

from rebsync import model as m
from rebsync.checker.formulas import (
    And,
    Atom,
    Formula,
    NamedFormula,
    Not,
    Or,
    Temporal,
    Timed,
    atoms,
)
from rebsync.checker.machine import Failed
from rebsync.checker.program import Program, Slot
from rebsync.checker.search import Interpreted
from rebsync.checker.state import Local
from rebsync.conform.components.dense import MOST, DenseRun, TopicChanges
from rebsync.conform.components.dense_formulas import is_dense
from rebsync.conform.components.heard import absolute
from rebsync.conform.components.interface import Unmodelled, cell_of_field
from rebsync.conform.finite import Progression, Rest
from rebsync.conform.properties import Evaluated, RunVerdict, holds_at_the_end
from rebsync.conform.recording import Event, Heard, Truncated
from rebsync.properties import Formula as PropertyFormula
from rebsync.properties import Properties, Property, state_expressions
from rebsync.records import dataclass
from rebsync.reverse.environment.observation import ANY, COUNT, Observation

Variable = tuple[str, str]
"""A rebec, and a state variable of it."""

_End = tuple[str, str, str]
"""A rebec, a topic, and the server that gets its messages; empty for who publishes them."""

_JUMP = 1.0  # s that stamps may go back
_NO_VALUE = "it has no value in a state"
_BEGINNING = "it depends on the state in which the run began, which was not recorded"


@dataclass(frozen=True, slots=True)
class Timespan:
    """When a recording began, and up to when at least it has all messages, in seconds."""

    begin: float
    end: float


@dataclass(frozen=True, slots=True)
class TopicProperties:
    """Properties of a package; `observed` says which fields of topics their variables are.

    `program` is that of the model in which they are variables, with the properties as `formulas`.
    """

    program: Program
    formulas: tuple[NamedFormula, ...]
    properties: Properties
    observed: Mapping[Variable, Observation]
    unit: float  # s

    def fields(self) -> dict[str, tuple[str, ...]]:
        """The topics that are named, with the paths of their fields."""
        found: dict[str, dict[str, None]] = {}
        for property_ in self.properties.all:
            for variable in _variables(self.properties, property_):
                seen = self.observed.get(variable)
                if seen is not None:
                    paths = found.setdefault(absolute(seen.topic), {})
                    if seen.path not in (ANY, COUNT):
                        paths[seen.path] = None
        return {topic: tuple(paths) for topic, paths in found.items()}

    def evaluated(
        self, events: Iterable[Event], times: Timespan, unit: float, slack: float
    ) -> tuple[Evaluated, ...]:
        """The properties on a recording. RebsyncError: it is not read."""
        count, fields = len(self.properties.assertions), self.fields()
        runs = [
            _Run(self, fields, property_, formula, "assertion" if n < count else "formula", slack)
            for n, (property_, formula) in enumerate(
                zip(self.properties.all, self.formulas, strict=True)
            )
        ]
        end = times.end
        for event in events:
            if isinstance(event, Truncated):
                break
            if isinstance(event, Heard):
                end = max(end, event.stamp)
                for run in runs:
                    run.hear(event)
        return tuple(run.result(times.begin, end, unit) for run in runs)


def _variables(properties: Properties, property_: Property) -> Iterator[Variable]:
    """The state variables that a property looks at, by itself or by defines."""
    defines = {d.name: d.value for d in properties.defines}
    waiting: list[PropertyFormula] = [property_.formula]
    seen: set[str] = set()
    while waiting:
        for expression in state_expressions(waiting.pop()):
            for node in m.walk(expression):
                match node:
                    case m.Member(m.Name(rebec), variable):
                        yield rebec, variable
                    case m.Name(name) if name in defines and name not in seen:
                        seen.add(name)
                        waiting.append(defines[name])


@dataclass(slots=True)
class _Run:
    """One property: the last values, since when they are the last, and what is left to hold."""

    whole: TopicProperties
    fields: Mapping[str, tuple[str, ...]]
    property_: Property
    formula: NamedFormula
    kind: Literal["assertion", "formula"]
    slack: float
    values: dict[Variable, tuple[int, ...]] = field(default_factory=dict)
    since: float = 0.0
    decided: tuple[RunVerdict, float, str] | None = None
    looked: dict[Variable, Observation] = field(init=False)
    changes: dict[_End, TopicChanges] | None = None  # of a formula that is not of some states
    progression: Progression = field(init=False)
    search: Interpreted = field(init=False)

    def __post_init__(self) -> None:
        named = dict.fromkeys(_variables(self.whole.properties, self.property_))
        observed = self.whole.observed
        self.looked = {v: observed[v] for v in named if v in observed}
        formula = self.formula.formula
        if self.kind == "assertion":
            formula = Temporal("G", (formula,))
        self.progression = Progression(formula)
        self.search = Interpreted(self.whole.program, "tts", ())
        inside = [f"{rebec}.{name}" for rebec, name in named if (rebec, name) not in observed]
        if inside:
            self._leave_open(f"no topic shows {', '.join(inside)}")
        elif any(seen.path == COUNT for seen in self.looked.values()):
            self._leave_open("messages before the recording were not counted")
        elif not is_dense(formula):
            self._leave_open("on topics X has no meaning, nor U with a bound from below")
        elif not _is_of_some_states(formula):
            self.changes = {
                _end(variable, seen): TopicChanges(bool(seen.server))
                for variable, seen in self.looked.items()
            }

    def _leave_open(self, why: str) -> None:
        self.decided = ("undetermined", 0.0, why)

    def hear(self, heard: Heard) -> None:
        """The next message: the state before it has ended."""
        looked = [(v, s) for v, s in self.looked.items() if absolute(s.topic) == heard.topic]
        if self.decided is not None or not looked:
            return
        ends = {_end(v, s) for v, s in self.looked.items()}
        is_one = len(ends) == 1
        if self.changes is None and not is_one and heard.stamp - self.since > self.slack:
            self._count()
        try:
            for variable, seen in looked:
                if seen.server or self._is_by(variable[0], seen, heard):
                    self.values[variable] = self._cells(variable, seen, heard)
        except Unmodelled as why:
            self._leave_open(str(why))
        if self.changes is not None:
            self._changed({_end(variable, seen) for variable, seen in looked}, heard.stamp)
            return
        self.since = max(self.since, heard.stamp)
        if is_one:
            self._count()

    def _changed(self, ends: set[_End], stamp: float) -> None:
        """Keeps what is on some topics now."""
        assert self.changes is not None
        if stamp < self.since - _JUMP:
            self._leave_open("the clock jumps back")
        self.since = max(self.since, stamp)
        for end in ends & {_end(v, self.looked[v]) for v in self.values}:
            changes = self.changes[end]
            changes.see(stamp, tuple(self.values[v][0] for v in self._variables_of(end)))
            if len(changes.changes) > MOST:
                self._leave_open(f"more than {MOST:,} changes on {end[1]}")

    def _variables_of(self, end: _End) -> list[Variable]:
        return [v for v, seen in self.looked.items() if _end(v, seen) == end]

    def _is_by(self, rebec: str, seen: Observation, heard: Heard) -> bool:
        """Whether a rebec has published a message. Unmodelled: that is not known."""
        every = self.whole.observed.items()
        others = {r for (r, _), o in every if not o.server and o.topic == seen.topic}
        name = heard.publisher.rpartition("/")[2]
        if name in others or (not name and len(others) == 1):
            return name in ("", rebec)
        raise Unmodelled(f"who publishes on {heard.topic} is not known")

    def _cells(self, variable: Variable, seen: Observation, heard: Heard) -> tuple[int, ...]:
        if seen.path == ANY:
            return (1,)
        at = self.fields[heard.topic].index(seen.path)
        return (cell_of_field(seen.path, self._slot(variable).kind, heard.values[at]),)

    def _slot(self, variable: Variable) -> Slot:
        info = next(r for r in self.whole.program.rebecs if r.name == variable[0])
        return next(slot for slot in info.state if slot.name == variable[1])

    def _count(self) -> None:
        """A state that the run was in."""
        if self.decided is not None or len(self.values) < len(self.looked):
            return
        rest = self._progressed()
        if isinstance(rest, bool):
            self.decided = ("satisfied" if rest else "violated", self.since, "")

    def _progressed(self) -> Rest | None:
        try:
            truth = self._truth(self.values)
        except Failed:
            self._leave_open(_NO_VALUE)
            return None
        return self.progression.see(truth, 1)

    def _truth(self, values: Mapping[Variable, tuple[int, ...]]) -> dict[int, bool]:
        """What holds in a state. Failed: something has no value there."""
        program = self.whole.program
        state = [[0] * rebec.cells for rebec in program.rebecs]
        names = [rebec.name for rebec in program.rebecs]
        for variable, cells in values.items():
            offset = self._slot(variable).offset
            state[names.index(variable[0])][offset : offset + len(cells)] = cells
        locals_ = tuple(Local(tuple(cells), ()) for cells in state)
        return {p: self.search.holds(locals_, p) for p in atoms(self.formula.formula)}

    def _dense(self, changes: Mapping[_End, TopicChanges], end: float) -> DenseRun:
        order = [self._variables_of(each) for each in changes]

        def truth(state: Mapping[int, tuple[int, ...]]) -> Mapping[int, bool]:
            values = {v: (c,) for n, of in state.items() for v, c in zip(order[n], of, strict=True)}
            return self._truth(values)

        return DenseRun(tuple(changes.values()), truth, end, self.slack)

    def result(self, begin: float, end: float, unit: float) -> Evaluated:
        """What is known at the end."""
        name = self.formula.name
        if self.decided is None:
            lacking = {s.topic for v, s in self.looked.items() if v not in self.values}
            if lacking:
                self._leave_open(f"nothing on {', '.join(sorted(lacking))} was recorded")
        if self.decided is None and self.changes is not None:
            return self._in_real_time(self._dense(self.changes, end), begin, unit)
        if self.decided is None:
            fulfilled = holds_at_the_end(self.progression.rest)
            return Evaluated(name, self.kind, "open", is_fulfilled=fulfilled)
        verdict, stamp, why = self.decided
        if why:
            return Evaluated(name, self.kind, verdict, reason=why)
        return Evaluated(name, self.kind, verdict, round((stamp - begin) / unit))

    def _in_real_time(self, run: DenseRun, begin: float, unit: float) -> Evaluated:
        name, formula = self.formula.name, self.progression.formula
        try:
            found = run.evaluated(formula, begin, self.whole.unit, unit)
        except Failed:
            return Evaluated(name, self.kind, "undetermined", reason=_NO_VALUE)
        if found.verdict == "undetermined":
            return Evaluated(name, self.kind, found.verdict, reason=_BEGINNING)
        time = None if found.verdict == "open" else round((found.time - begin) / unit)
        return Evaluated(name, self.kind, found.verdict, time, found.margin, found.is_fulfilled)


def _end(variable: Variable, seen: Observation) -> _End:
    return variable[0], seen.topic, seen.server


def _is_of_some_states(formula: Formula, is_inside: bool = False) -> bool:
    """Whether it is made of G and F of state predicates: decided on some states, it is decided."""
    match formula:
        case Atom():
            return is_inside
        case Not(operand):
            return _is_of_some_states(operand, is_inside)
        case And(left, right) | Or(left, right):
            return _is_of_some_states(left, is_inside) and _is_of_some_states(right, is_inside)
        case Temporal("G" | "F", (operand,)) | Timed("AG" | "AF", None, (operand,)):
            return _is_of_some_states(operand, True)
        case _:
            return False
