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
from rebsync.properties import Formula as PropertyFormula
from rebsync.properties import Properties, Property, state_expressions
from rebsync.records import dataclass
from rebsync.reverse.environment.observation import ANY, COUNT, Observation
from rebsync.roundtrip.conform.components.heard import absolute
from rebsync.roundtrip.conform.components.interface import Unmodelled, cell_of_field
from rebsync.roundtrip.conform.finite import Progression, Rest
from rebsync.roundtrip.conform.properties import Evaluated, RunVerdict, holds_at_the_end
from rebsync.roundtrip.conform.recording import Event, Heard, Truncated

Variable = tuple[str, str]
"""A rebec, and a state variable of it."""


@dataclass(frozen=True, slots=True)
class TopicProperties:
    """Properties of a package; `observed` says which fields of topics their variables are.

    `program` is that of the model in which they are variables, with the properties as `formulas`.
    """

    program: Program
    formulas: tuple[NamedFormula, ...]
    properties: Properties
    observed: Mapping[Variable, Observation]

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
        self, events: Iterable[Event], begin: float, unit: float, slack: float
    ) -> tuple[Evaluated, ...]:
        """The properties on a recording that began at `begin`. RebsyncError: it is not read."""
        count, fields = len(self.properties.assertions), self.fields()
        runs = [
            _Run(self, fields, property_, formula, "assertion" if n < count else "formula", slack)
            for n, (property_, formula) in enumerate(
                zip(self.properties.all, self.formulas, strict=True)
            )
        ]
        for event in events:
            if isinstance(event, Truncated):
                break
            if isinstance(event, Heard):
                for run in runs:
                    run.hear(event)
        return tuple(run.result(begin, unit) for run in runs)


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
        elif not _is_of_some_states(formula):
            self._leave_open("on topics it has a meaning by G and F without bounds only")

    def _leave_open(self, why: str) -> None:
        self.decided = ("undetermined", 0.0, why)

    def hear(self, heard: Heard) -> None:
        """The next message: the state before it has ended."""
        looked = [(v, s) for v, s in self.looked.items() if absolute(s.topic) == heard.topic]
        if self.decided is not None or not looked:
            return
        ends = {(v[0], s.topic, s.server) for v, s in self.looked.items()}
        is_one = len(ends) == 1
        if not is_one and heard.stamp - self.since > self.slack:
            self._count()
        try:
            for variable, seen in looked:
                if seen.server or self._is_by(variable[0], seen, heard):
                    self.values[variable] = self._cells(variable, seen, heard)
        except Unmodelled as why:
            self._leave_open(str(why))
        self.since = max(self.since, heard.stamp)
        if is_one:
            self._count()

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
        program = self.whole.program
        state = [[0] * rebec.cells for rebec in program.rebecs]
        names = [rebec.name for rebec in program.rebecs]
        for variable, cells in self.values.items():
            offset = self._slot(variable).offset
            state[names.index(variable[0])][offset : offset + len(cells)] = cells
        locals_ = tuple(Local(tuple(cells), ()) for cells in state)
        try:
            truth = {p: self.search.holds(locals_, p) for p in atoms(self.formula.formula)}
        except Failed:
            self._leave_open("it has no value in a state")
            return None
        return self.progression.see(truth, 1)

    def result(self, begin: float, unit: float) -> Evaluated:
        """What is known at the end."""
        name = self.formula.name
        if self.decided is None:
            lacking = {s.topic for v, s in self.looked.items() if v not in self.values}
            if lacking:
                self._leave_open(f"nothing on {', '.join(sorted(lacking))} was recorded")
        if self.decided is None:
            fulfilled = holds_at_the_end(self.progression.rest)
            return Evaluated(name, self.kind, "open", is_fulfilled=fulfilled)
        verdict, stamp, why = self.decided
        if why:
            return Evaluated(name, self.kind, verdict, reason=why)
        return Evaluated(name, self.kind, verdict, round((stamp - begin) / unit))


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
