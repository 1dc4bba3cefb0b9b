"""What a recovered model can do where the code's callback has done something."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

from rebsync.checker.lowering import lower
from rebsync.checker.machine import Coverage
from rebsync.checker.outcomes import Actor, Outcome
from rebsync.checker.program import NO_DEADLINE, Cell, Program, Slot
from rebsync.checker.state import Local, Message
from rebsync.checker.values import real, stored
from rebsync.properties import Properties
from rebsync.reverse.findings import Grade
from rebsync.reverse.recovery import Extracted
from rebsync.static import Analysis, analyse
from tests.reverse.soundness.nodes import Callback, DrawnNode
from tests.reverse.soundness.programs import Effect, Input, Seen

# Variables that have one value of each range that the code tells apart.
_STANDS = re.compile(r'one value of "(\w+)" stands')
_ENOUGH = 10_000  # messages that the rebec may have waiting, so that none finds no place
_FUNCTION = re.compile(
    r"^(?:\w+ (?:\w+::)?|(?=on\w+_ = ))(\w+)(?:\(|_ = )[^\n]*\) \{\n(.*?)^\}",
    re.MULTILINE | re.DOTALL,
)


@dataclass
class Tally:
    """How many calls were compared, by what is said of their callbacks, and what is wrong.

    `refused` are errors in models, `unsound` what the code does and the model cannot, `inexact`
    where the model can do more and nothing says so.
    """

    exact: int = 0
    approximated: int = 0
    unreadable: int = 0
    refused: list[str] = field(default_factory=list)
    unsound: list[str] = field(default_factory=list)
    inexact: list[str] = field(default_factory=list)

    def __add__(self, other: Tally) -> Tally:
        return Tally(
            self.exact + other.exact,
            self.approximated + other.approximated,
            self.unreadable + other.unreadable,
            self.refused + other.refused,
            self.unsound + other.unsound,
            self.inexact + other.inexact,
        )


def compare(
    node: DrawnNode, extracted: Extracted, calls: Sequence[Input], seen: Sequence[Seen]
) -> Tally:
    """Whether each thing that was seen is among what the model can do in its place.

    The states that the model may be in are kept from call to call: those that agree with what
    was seen. After a callback that is listed as unreadable only what is seen is known.
    """
    grades = _Grades(node, extracted)
    tally = Tally()
    analysis = analyse(extracted.model)
    if analysis.errors:
        tally.refused += [f"{node.name}: {d.message}" for d in analysis.errors]
        return tally
    stands = {name for f in extracted.findings for name in _STANDS.findall(f.why)}
    possible = Possible(node, analysis, stands)
    first = possible.started()
    possible.states = possible.agreeing(first, seen[0])
    if not possible.states:
        tally.unsound.append(f"{node.name}: constructor: {seen[0].state}")
        possible.states = possible.as_seen(first, seen[0])
    for call, after in zip(calls, seen[1:], strict=True):
        grade = grades.of(call.callback)
        if grade is Grade.UNREADABLE or not possible.serves(call.callback):
            if grade is None and call.callback.message is not None:
                tally.unsound.append(f"{node.name}.{call.callback.name} is not in the model")
            tally.unreadable += 1
            possible.states = possible.as_seen(possible.states, after)
            continue
        done = possible.done(call)
        agreeing = {d for d in done if possible.agrees(d, call, after)}
        what = f"{node.name}.{call.callback.name}{call.values}"
        if not agreeing:
            tally.unsound.append(f"{what}: {after}, not {list(done)[:2]}")
        if grade is None:
            tally.exact += 1
            if len(done) > len(possible.states):
                tally.inexact.append(what)
        else:
            tally.approximated += 1
        kept = {d.variables for d in agreeing}
        possible.states = kept or possible.as_seen(possible.states, after)
    return tally


class _Grades:
    """What is said of the functions that a callback reaches."""

    def __init__(self, node: DrawnNode, extracted: Extracted) -> None:
        self._bodies = {m[1]: m[2] for m in _FUNCTION.finditer(node.source)}
        self._found: dict[str, Grade] = {}
        for finding in extracted.findings:
            name = re.split(r"[.:]+", finding.within)[-1]
            if finding.grade is Grade.UNREADABLE or name not in self._found:
                self._found[name] = finding.grade

    def of(self, callback: Callback) -> Grade | None:
        """The worst of them; None where all is exact."""
        reached = [callback.name]
        for name in reached:
            called = re.findall(r"\b(help\d+|tick)\(", self._bodies.get(name, ""))
            reached += [c for c in called if c not in reached]
        grades = {self._found[n] for n in reached if n in self._found}
        if Grade.UNREADABLE in grades:
            return Grade.UNREADABLE
        return Grade.APPROXIMATED if grades else None


@dataclass(frozen=True)
class Done:
    """A way to serve a message: the variables after it, and what was sent, in order."""

    variables: tuple[Cell, ...]
    sends: tuple[tuple[str, int, tuple[float, ...]], ...]
    failure: str = ""


class Possible:
    """The states that the model may be in; values of `stands` are none that the code has."""

    def __init__(self, node: DrawnNode, analysis: Analysis, stands: set[str]) -> None:
        self.node = node
        self.program: Program = lower(analysis, Properties())[0]
        rebecs = [r for r in self.program.rebecs if r.name == node.name.lower()]
        assert len(rebecs) == 1, (node.name, [r.class_name for r in self.program.rebecs])
        self.rebec = replace(rebecs[0], capacity=_ENOUGH)
        index = self.program.rebecs.index(rebecs[0])
        self.program = replace(
            self.program,
            rebecs=tuple(
                self.rebec if i == index else r for i, r in enumerate(self.program.rebecs)
            ),
        )
        self.actor = Actor(self.program, index, "ftts", Coverage())
        self.states: set[tuple[Cell, ...]] = set()
        self._slots = {s.name: s for s in self.rebec.state if s.name not in stands}

    # --- what is seen and what is possible ------------------------------------------------------

    def started(self) -> set[tuple[Cell, ...]]:
        """The states after the constructor."""
        locals_ = [o.result for o in self.actor.construct(())]
        return {found.variables for found in locals_ if isinstance(found, Local)}

    def agreeing(self, states: Iterable[tuple[Cell, ...]], seen: Seen) -> set[tuple[Cell, ...]]:
        """Those states in which the members have the values seen."""
        return {s for s in states if self._values(s) == self._seen_values(seen)}

    def as_seen(self, states: Iterable[tuple[Cell, ...]], seen: Seen) -> set[tuple[Cell, ...]]:
        """The states with the members' values put to what was seen."""
        found = set()
        for state in states:
            cells = list(state)
            for slot, values in self._pairs(seen):
                for index, value in enumerate(values):
                    cells[slot.offset + index] = stored(value, slot.kind)
            found.add(tuple(cells))
        return found

    def _pairs(self, seen: Seen) -> list[tuple[Slot, tuple[float, ...]]]:
        """The state variables that are members, with their values."""
        found, at = [], 0
        for member in self.node.members:
            size = member.length or 1
            values, at = seen.state[at : at + size], at + size
            names = member.name.rstrip("_"), member.name, member.name.replace("_.", "_")
            slot = next((self._slots[n] for n in names if n in self._slots), None)
            if slot is not None:
                found.append((slot, values))
        return found

    def _seen_values(self, seen: Seen) -> list[float]:
        return [v for _, values in self._pairs(seen) for v in values]

    def _values(self, state: tuple[Cell, ...]) -> list[float]:
        blank = Seen((), tuple(0.0 for m in self.node.members for _ in range(m.length or 1)))
        slots = [slot for slot, _ in self._pairs(blank)]
        return [_value(c, s) for s in slots for c in state[s.offset : s.offset + s.size]]

    # --- serving --------------------------------------------------------------------------------

    def serves(self, callback: Callback) -> bool:
        """Whether the model has a server for a callback."""
        return self._server(callback) is not None

    def _server(self, callback: Callback) -> int | None:
        for index, server in enumerate(self.program.servers):
            if server.class_name == self.rebec.class_name and server.name == callback.name:
                return index
        return None

    def done(self, call: Input) -> set[Done]:
        """All ways to serve a message, from all states that are possible."""
        server = self._server(call.callback)
        assert server is not None
        body = self.program.bodies[self.program.servers[server].body]
        arguments = tuple(self._argument(p, call) for p in body.parameters)
        message = Message(0, server, self.actor.index, NO_DEADLINE, arguments)
        outcomes = (
            (state, o)
            for state in self.states
            for o in self.actor.outcomes(Local(state, (message,)))
        )
        return {self._done(state, o, call.callback) for state, o in outcomes}

    def _argument(self, parameter: Slot, call: Input) -> Cell:
        for (path, _), value in zip(call.callback.fields, call.values, strict=True):
            if parameter.name.startswith(path.replace(".", "_")):
                return stored(value, parameter.kind)
        raise AssertionError(f"{self.node.name}.{call.callback.name}: {parameter.name}")

    def _done(self, state: tuple[Cell, ...], outcome: Outcome, callback: Callback) -> Done:
        sends = []
        for sent in outcome.sends:
            server = self.program.servers[sent.message.server]
            if sent.receiver == self.actor.index and server.name == callback.name == "tick":
                continue  # the timer's next tick
            parameters = self.program.bodies[server.body].parameters
            values = [_value(c, p) for c, p in zip(sent.message.arguments, parameters, strict=True)]
            sends.append((server.name, sent.message.arrival, tuple(values)))
        if isinstance(outcome.result, Local):
            return Done(outcome.result.variables, tuple(sends))
        return Done(state, tuple(sends), outcome.result.kind)

    def agrees(self, done: Done, call: Input, seen: Seen) -> bool:
        """Whether a way to serve a message shows what was seen."""
        shown = tuple(_shown(e) for e in seen.effects)
        same = self._values(done.variables) == self._seen_values(seen)
        return not done.failure and same and shown == done.sends


def _shown(effect: Effect) -> tuple[str, float, tuple[float, ...]]:
    """A message published, or a timer armed, as the message that it is in the model."""
    if effect.topic is None:
        return "later", effect.time + effect.values[0], ()
    return effect.topic.rpartition("/")[2], effect.time, effect.values


def _value(cell: Cell, slot: Slot) -> float:
    return real(cell) if slot.kind in ("float", "double") else float(cell)
