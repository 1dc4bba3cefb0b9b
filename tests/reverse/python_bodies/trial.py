"""Runs drawn nodes in Python, and looks whether their models can do what was seen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from random import Random
from types import SimpleNamespace
from typing import Any

from rebsync.checker.endless import EndlessBody
from rebsync.checker.lowering import lower
from rebsync.checker.machine import Coverage
from rebsync.checker.outcomes import Actor, Outcome
from rebsync.checker.program import NO_DEADLINE, Cell, Program, Slot
from rebsync.checker.state import Local, Message
from rebsync.checker.values import real, stored
from rebsync.properties import Properties
from rebsync.reverse.findings import Grade
from rebsync.reverse.recovery import extract
from rebsync.source import Source
from rebsync.static import analyse
from tests.reverse.python_bodies.drawing import TOPICS, draw_node

CALLS = 12
_MEMBERS = ("a", "b", "c", "f", "r")
Shown = tuple[tuple[str, float], ...]


@dataclass
class Tally:
    """How many calls were compared, by what is said of them, and what the models lack."""

    exact: int = 0
    approximated: int = 0
    unreadable: int = 0
    refused: list[str] = field(default_factory=list)
    unsound: list[str] = field(default_factory=list)


class Run:
    """A node that runs: what its callbacks publish is noted."""

    def __init__(self, text: str) -> None:
        self.sent: list[tuple[str, float]] = []
        kept = [x for x in text.splitlines() if not x.startswith(("import", "from", "    rospy."))]
        rospy = SimpleNamespace(Publisher=self._publisher, Subscriber=lambda *a, **k: None)
        made = {name: _message(zero) for name, zero in _ZEROS.items()}
        names: dict[str, Any] = {"rospy": rospy, "__name__": "drawn", **made}
        exec("\n".join(kept), names)
        self.node = names["Drawn"]()

    def _publisher(self, topic: str, *_: object, **__: object) -> SimpleNamespace:
        kind = topic.rpartition("/")[2]
        return SimpleNamespace(publish=lambda m: self._publish(kind, m.data))

    def _publish(self, kind: str, value: float) -> None:
        low, high = {"small": (0, 255), "whole": (-(1 << 31), (1 << 31) - 1)}.get(kind, (0, 0))
        if low != high and not low <= value <= high:
            raise ValueError("a value that the message does not hold")
        self.sent.append((f"get_{kind}", float(value)))

    def call(self, name: str, value: float) -> tuple[Shown, list[float]] | None:
        """What a callback sends and leaves; None where it raises an exception."""
        self.sent = []
        try:
            getattr(self.node, name)(SimpleNamespace(data=value))
        except (ArithmeticError, ValueError):
            return None
        return tuple(self.sent), self.state()

    def state(self) -> list[float]:
        """The attributes of the node."""
        return [getattr(self.node, n) for n in _MEMBERS]


_ZEROS = {"Int32": 0, "Bool": False, "Float64": 0.0, "UInt8": 0}


def _message(zero: float) -> Callable[..., SimpleNamespace]:
    return lambda data=zero: SimpleNamespace(data=data)


def value_of(random: Random, name: str) -> float:
    """A value that comes in."""
    match name:
        case "on_whole":
            far = random.choice(((1 << 31) - 1, -(1 << 31), 1 << 30))
            return far if random.random() < 0.15 else random.randint(-20, 60)
        case "on_truth":
            return random.random() < 0.5
        case "on_small":
            return random.randint(0, 255)
        case _:
            return random.choice((0.0, 0.5, 2.5, -4.0, 1e6))


def compared(seed: int) -> Tally:
    """What one drawn node shows."""
    text, random, tally = draw_node(seed), Random(seed), Tally()
    found = extract({"drawn.py": Source("drawn.py", text)})
    analysis = analyse(found.model)
    tally.refused += [f"{seed}: {d.message}" for d in analysis.errors]
    if tally.refused:
        return tally
    program = lower(analysis, Properties())[0]
    index = next(n for n, r in enumerate(program.rebecs) if r.class_name == "Drawn")
    # A full mailbox, also that of the sink, is told by the checker, and is no matter of the reader.
    rebecs = tuple(replace(r, capacity=10_000) for r in program.rebecs)
    program, rebec = replace(program, rebecs=rebecs, places=10_000), rebecs[index]
    actor = Actor(program, index, "ftts", Coverage())
    slots = {s.name: s for s in rebec.state}
    results = [o.result for o in actor.construct(())]
    states = {r.variables for r in results if isinstance(r, Local)}
    run = Run(text)
    for _ in range(CALLS):
        name = random.choice(tuple(TOPICS))
        value, before = value_of(random, name), run.state()
        grades = {f.grade for f in found.findings if f.within == f"Drawn.{name}"}
        grades |= {f.grade for f in found.findings if "without end" in f.why}
        seen = run.call(name, value)
        if any(abs(n) > (1 << 31) - 1 for n in run.state()[:3]):
            if not {Grade.UNREADABLE, Grade.APPROXIMATED, Grade.ASSUMED} & grades and _kept(
                slots, run.state()
            ):
                tally.unsound.append(f"{seed}: {name}({value}) leaves the int: {run.state()}")
            return tally
        if seen is None and not set("abc") <= set(slots):
            return tally  # what the model does not have may raise exceptions
        servers = [
            n for n, s in enumerate(program.servers) if s.class_name == "Drawn" and s.name == name
        ]
        if Grade.UNREADABLE in grades or not servers:
            tally.unreadable += 1
            states = {_as_seen(s, slots, run.state()) for s in states}
            continue
        parameters = program.bodies[program.servers[servers[0]].body].parameters
        arguments = tuple(stored(value, p.kind) for p in parameters)
        message = Message(0, servers[0], index, NO_DEADLINE, arguments)
        try:
            ways = [o for s in states for o in actor.outcomes(Local(s, (message,)))]
        except EndlessBody:  # a choice may go on for ever
            return tally
        agreeing = {
            o.result.variables
            for o in ways
            if seen is not None
            and isinstance(o.result, Local)
            and _values(o.result.variables, slots) == _wanted(slots, seen[1])
            and _sends(program, o) == _heard(program, seen[0])
        }
        if not agreeing:
            shown = [
                (_values(o.result.variables, slots), _sends(program, o))
                for o in ways[:2]
                if isinstance(o.result, Local)
            ]
            tally.unsound.append(f"{seed}: {name}({value}) of {before}: {seen}, not {shown}")
        if {Grade.APPROXIMATED, Grade.ASSUMED} & grades:
            tally.approximated += 1
        else:
            tally.exact += 1
        states = agreeing or {_as_seen(s, slots, run.state()) for s in states}
    return tally


def _kept(slots: dict[str, Slot], state: list[float]) -> bool:
    """Whether one of the numbers that left the `int` is in the model."""
    numbers = zip(_MEMBERS[:3], state, strict=False)
    return any(n in slots and abs(v) > (1 << 31) - 1 for n, v in numbers)


def _values(state: tuple[Cell, ...], slots: dict[str, Slot]) -> list[float]:
    return [_number(state[slots[n].offset], slots[n]) for n in _MEMBERS if n in slots]


def _wanted(slots: dict[str, Slot], state: list[float]) -> list[float]:
    return [float(v) for n, v in zip(_MEMBERS, state, strict=True) if n in slots]


def _as_seen(
    state: tuple[Cell, ...], slots: dict[str, Slot], seen: list[float]
) -> tuple[Cell, ...]:
    cells = list(state)
    for name, value in zip(_MEMBERS, seen, strict=True):
        if name in slots:
            cells[slots[name].offset] = stored(value, slots[name].kind)
    return tuple(cells)


def _sends(program: Program, outcome: Outcome) -> list[tuple[str, float | None]]:
    found: list[tuple[str, float | None]] = []
    for sent in outcome.sends:
        server = program.servers[sent.message.server]
        parameters = program.bodies[server.body].parameters
        given = zip(sent.message.arguments, parameters, strict=True)
        numbers = [_number(c, p) for c, p in given]
        found.append((server.name, numbers[0] if numbers else None))
    return found


def _heard(program: Program, sent: Shown) -> list[tuple[str, float | None]]:
    """What was sent as the sink's servers get it: a field that is open has no value."""
    takes = {
        s.name: bool(program.bodies[s.body].parameters)
        for s in program.servers
        if s.class_name == "Sink"
    }
    return [(name, value if takes[name] else None) for name, value in sent]


def _number(cell: Cell, slot: Slot) -> float:
    return real(cell) if slot.kind in ("float", "double") else float(cell)


def tallied(seeds: range) -> Tally:
    """What several nodes show."""
    whole = Tally()
    for seed in seeds:
        one = compared(seed)
        whole.exact += one.exact
        whole.approximated += one.approximated
        whole.unreadable += one.unreadable
        whole.refused += one.refused
        whole.unsound += one.unsound
    return whole
