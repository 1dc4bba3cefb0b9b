"""Which bodies of two models do the same: translation validation, body by body (Pnueli, 1998).

The two have the same rebecs, classes, variables, servers and constants, and differ in bodies and
methods only: that is for whoever asks to see to. A body does the same if on every path, whatever
the variables, the message and the time are, it sends, delays, chooses, asserts and fails in the
same order with the same values, and leaves the same variables.

Integers may be known to be within bounds whenever the left side serves a message (an invariant).
If all bodies do the same within these, that holds of the right side too, by induction over a run.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from typing import TypeAlias

import z3

from rebsync.checker.program import NULL, Instruction, Program, RebecInfo, Server, Slot
from rebsync.checker.symbolic import terms
from rebsync.checker.symbolic.execution import Execution, Names, Unproved
from rebsync.checker.symbolic.paths import Path, prove_alike
from rebsync.checker.symbolic.terms import Condition, Term
from rebsync.intervals import Interval
from rebsync.records import dataclass

_JUMPS = ("JUMP", "JUMPF", "JUMPT")
_OF_STATE = ("VAR", "VARAT", "SETVAR", "SETVARAT")


@dataclass(frozen=True, slots=True)
class Proof:
    """Whether the bodies of one name do the same in a class of rebecs.

    `server` is empty for what constructs them; `methods` are called by one of the two.
    """

    class_name: str
    server: str
    methods: frozenset[str]
    is_alike: bool


Invariants: TypeAlias = Mapping[str, Mapping[str, Interval]]
"""The bounds of integers between messages, by class and variable."""


def proofs(left: Program, right: Program, invariants: Invariants) -> Iterator[Proof]:
    """A proof for each body of each class that has a rebec, or the lack of one."""
    for name in dict.fromkeys(rebec.class_name for rebec in left.rebecs):
        shared: dict[object, int] = {}
        both = _Side.of(left, name, shared), _Side.of(right, name, shared)
        are_alike = _are_alike(*both)
        for server, first, second in _pairs(*both):
            methods = both[0].called(first) | both[1].called(second)
            known = invariants.get(name, {}) if server else None
            is_alike = are_alike and _is_alike(both, first, second, known)
            yield Proof(name, server, methods, is_alike)


@dataclass(frozen=True, slots=True, eq=False)
class _Side:
    """A class in one of the programs: its rebecs, its servers, and what numbers stand for.

    `shared` has numbers for bodies that are alike to the letter; `images` those of own bodies.
    """

    program: Program
    rebecs: tuple[RebecInfo, ...]
    servers: dict[tuple[object, ...], Server]
    names: Names
    shared: dict[object, int]
    images: dict[int, int] = field(default_factory=dict)

    @classmethod
    def of(cls, program: Program, name: str, shared: dict[object, int]) -> _Side:
        rebecs = tuple(r for r in program.rebecs if r.class_name == name)
        servers = {_answer(program, s): s for s in program.servers if s.class_name == name}
        classes = {r.class_index: r.class_name for r in program.rebecs}
        known = zip(*(r.known for r in rebecs), strict=True)
        names = Names(
            rebecs[0].state,
            tuple(_known(program, bound) for bound in known),
            lambda number: tuple(_dispatched(program, number)),
            lambda numbers: tuple(sorted(classes[n] for n in numbers)),
        )
        return cls(program, rebecs, servers, names, shared)

    def called(self, number: int) -> frozenset[str]:
        """The names of all methods that a body calls, be it through others."""
        found: dict[int, str] = {}
        waiting = [number] if number >= 0 else []
        while waiting:
            body = self.program.bodies[waiting.pop()]
            code = self.program.code[body.entry : body.end]
            for callee in {i.a for i in code if i.op == "CALL"} - found.keys():
                found[callee] = self.program.bodies[callee].name.rpartition(".")[2]
                waiting.append(callee)
        return frozenset(found.values())

    def image(self, number: int) -> int:
        """What a body is to the letter, with what its numbers stand for: alike on both sides.

        One that calls itself is like no other.
        """
        if number not in self.images:
            self.images[number] = self._numbered((id(self), number))
            body = self.program.bodies[number]
            code = self.program.code[body.entry : body.end]
            meant = body.frame, *(self._meant(i, body.entry) for i in code)
            self.images[number] = self._numbered(meant)
        return self.images[number]

    def _numbered(self, meant: object) -> int:
        return self.shared.setdefault(meant, len(self.shared))

    def _meant(self, i: Instruction, entry: int) -> object:
        match i.op:
            case "CALL":
                return i.op, self.image(i.a)
            case "SEND" | "SENDBY":
                return i.op, i.b, self.names.selectors(i.a)
            case "CONST" if i.b:
                return i.op, i.a, self.program.texts[i.b - 1]
            case "TABLE" if i.a:
                return i.op, self.program.texts[i.a - 1], i.b, i.constants
            case "ASSERT":
                return i.op, self.program.texts[i.a] if i.a >= 0 else None
            case "KNOWN":
                return i.op, str(self.names.known[i.a])
            case "IS":
                return i.op, self.names.classes(i.constants)
            case op if op in _JUMPS:
                return op, i.a - entry
            case op if op in _OF_STATE:
                slot = next(s for s in self.names.state if s.offset <= i.a < s.offset + s.size)
                return op, slot.name, i.a - slot.offset
            case _:
                return i


def _known(program: Program, bound: tuple[int, ...]) -> Term:
    """A known rebec: only who it is for each rebec of the class tells it from others."""
    names = (program.rebecs[b].name if b != NULL else "null" for b in bound)
    return terms.symbol(f"known {' '.join(names)}", "rebec")


def _answer(program: Program, server: Server) -> tuple[object, ...]:
    """A server by what both models call it."""
    parameters = program.bodies[server.body].parameters
    types = tuple(str(p.type) for p in parameters)
    return server.class_name, server.name, types, server.priority


def _dispatched(program: Program, selector: int) -> Iterator[tuple[object, ...]]:
    for rebec in program.rebecs:
        number = rebec.dispatch[selector]
        yield _answer(program, program.servers[number]) if number >= 0 else ()


def _are_alike(left: _Side, right: _Side) -> bool:
    """Whether a class has the same servers and variables, each with a name of its own."""
    variables = [sorted((s.name, str(s.type)) for s in side.names.state) for side in (left, right)]
    is_plain = len({name for name, _ in variables[0]}) == len(variables[0])
    return is_plain and variables[0] == variables[1] and left.servers.keys() == right.servers.keys()


def _pairs(left: _Side, right: _Side) -> Iterator[tuple[str, int, int]]:
    """The name and the numbers of each body; -1 for one that a side does not have."""
    for key, server in left.servers.items():
        other = right.servers.get(key)
        yield server.name, server.body, other.body if other is not None else -1
    made = zip(*([r.constructor for r in side.rebecs] for side in (left, right)), strict=True)
    yield from (("", *each) for each in dict.fromkeys(made))


def _is_alike(
    both: tuple[_Side, _Side], first: int, second: int, known: Mapping[str, Interval] | None
) -> bool:
    """Whether two bodies do the same from any variables within the bounds that are known; None:
    from the start of a rebec.
    """
    left, right = both
    if first < 0 or second < 0:
        return first == second
    if left.image(first) == right.image(second):
        return True
    slots, variables = left.program.bodies[first].parameters, right.names.state
    arguments = [_symbols(f"parameter {i}", slot) for i, slot in enumerate(slots)]
    state = {s.name: _initial(s) if known is None else _symbols(s.name, s) for s in variables}
    given = tuple(term for each in arguments for term in each)
    holds = [*_in_kinds(slots, arguments), *_in_kinds(variables, state.values())]
    for name, bounds in (known or {}).items():
        holds += [z3.And(t >= bounds.low, t <= bounds.high) for t in state[name]]

    def run(path: Path) -> tuple[Execution, Execution]:
        return (
            _executed(left, first, given, state, path),
            _executed(right, second, given, state, path),
        )

    try:
        prove_alike(holds, run)
    except (Unproved, terms.Mixed, z3.Z3Exception):  # z3's own: operands of other sizes
        return False
    return True


def _executed(
    side: _Side, body: int, given: tuple[Term, ...], state: dict[str, list[Term]], path: Path
) -> Execution:
    variables = [term for slot in side.names.state for term in state[slot.name]]
    execution = Execution(side.program, side.names, variables, path.decide, path.choose)
    execution.run(body, given)
    return execution


def _symbols(name: str, slot: Slot) -> list[Term]:
    return [terms.symbol(f"{name}[{i}]", slot.kind) for i in range(slot.size)]


def _initial(slot: Slot) -> list[Term]:
    return [NULL if slot.kind == "rebec" else 0] * slot.size


def _in_kinds(slots: Iterable[Slot], cells: Iterable[list[Term]]) -> Iterator[Condition]:
    for slot, each in zip(slots, cells, strict=True):
        for term in each:
            holds = terms.in_kind(term, slot.kind) if not isinstance(term, int) else None
            if holds is not None:
                yield holds
