"""Whether whole numbers of Python stay where the model's `int` has the same numbers.

Python's have no bounds. What each state variable can hold is found from all bodies together;
with it each expression that must be within bounds is looked at.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.building import bare
from rebsync.reverse.bodies.proving import Interval, Proof
from rebsync.reverse.python.body_scope import Mark, Need
from rebsync.static.types import INT_MAX, INT_MIN

_BITS = 63
_PLAIN_ROUNDS = 3
_UNROLLED = 32
_MOST_ROUNDS = 40


@dataclass(slots=True)
class PyProof(Proof):
    """Follows bodies; `failed` are needs that may not hold, `stored` what variables get.

    `left` is what bodies leave in state variables.
    """

    needs: Mapping[int, list[Need]] = field(default_factory=dict)
    failed: set[Mark] = field(default_factory=set)
    stored: dict[str, Interval] = field(default_factory=dict)
    left: dict[str, Interval] = field(default_factory=dict)

    def body(self, statements: Sequence[m.Statement]) -> None:
        """Looks at a body, and at what it leaves in the state variables."""
        self._now = {n: self._of(n) for n in self.state if n in self.wide}
        self._real = set()
        if self._each(statements):
            self._leave()

    def _leave(self) -> None:
        for name in self.state:
            if name in self.wide:
                self.left[name] = _widest(self.left.get(name), self._of(name))

    def _statement(self, statement: m.Statement) -> bool:
        if isinstance(statement, m.Return):
            self._leave()
        if isinstance(statement, m.For) and (rounds := _rounds(statement)) is not None:
            return self._unrolled(statement, rounds)
        return Proof._statement(self, statement)

    def _unrolled(self, statement: m.For, rounds: tuple[str, range]) -> bool:
        """A loop of few rounds, one round after the other."""
        name, numbers = rounds
        for number in numbers:
            self._now[name] = number, number
            self._statement(statement.body)
        return True

    def _forget_state(self) -> None:
        """No function of the class is called: each stands in the place of its call."""

    def _value(self, expression: m.Expression) -> Interval:
        found = Proof._value(self, expression)
        for need in self.needs.get(id(bare(expression)), ()):
            if found[0] < need.low or found[1] > need.high:
                self.failed.add(need.mark)
        return found

    def _store(
        self, name: str, given: Interval, type_: m.Type | None, counts: bool = False
    ) -> Interval:
        found = Proof._store(self, name, given, type_, counts)
        if name in self.wide:
            self.stored[name] = _widest(self.stored.get(name), found)
        return found


@dataclass(frozen=True, slots=True)
class Proved:
    """What following all bodies shows: needs that may not hold, and variables beyond an `int`."""

    failed: frozenset[Mark]
    broken: frozenset[str]
    counted: frozenset[str]


@dataclass(frozen=True, slots=True)
class Bodies:
    """All bodies of a class: the constructor's, and those of servers with their parameters.

    `sure` are the state variables that the constructor gives a value before anything is served.
    """

    constructor: Sequence[m.Statement]
    servers: Sequence[tuple[Sequence[m.Statement], Mapping[str, Interval]]]
    state: frozenset[str]
    wide: frozenset[str]
    types: Mapping[str, m.Type]
    needs: Mapping[int, list[Need]]


def proved(bodies: Bodies) -> Proved:
    """Looks at all bodies until it is known what their state variables can hold."""
    steps = sorted({*_steps(bodies), INT_MIN, INT_MAX, 0, -1, 1})
    ranges = _first(bodies)
    looped = _looped(bodies)
    for number in range(_MOST_ROUNDS):
        proof = _followed(bodies, ranges)
        wider = {n: _joined(ranges.get(n), proof.left.get(n)) for n in bodies.state & bodies.wide}
        for name in looped & set(wider):
            wider[name] = _joined(wider[name], proof.stored.get(name))
        if number >= _PLAIN_ROUNDS:
            wider = {n: _stepped(steps, ranges.get(n), r) for n, r in wider.items()}
        found = {n: r for n, r in wider.items() if r is not None}
        if found == ranges:
            break
        ranges = found
    else:
        proof = _followed(bodies, {})
    return Proved(frozenset(proof.failed), frozenset(proof.broken), frozenset(proof.counted))


def _first(bodies: Bodies) -> dict[str, Interval]:
    """What state variables hold before anything is served: 0 where nothing has set them."""
    proof = _proof(bodies, {})
    proof.body(bodies.constructor)
    sure = set(_surely(bodies.constructor))
    found = {}
    for name in bodies.state & bodies.wide:
        stored = proof.stored.get(name, (0, 0))
        found[name] = stored if name in sure else _joined(stored, (0, 0)) or (0, 0)
    return found


def _surely(statements: Sequence[m.Statement]) -> Iterator[str]:
    """The variables that get a value before the node sends, waits or chooses."""
    for statement in statements:
        for node in m.walk(statement):
            match node:
                case m.Choice():
                    return
                case m.Call(target, name) if name == "delay" or target is not None:
                    return
        match statement:
            case m.ExpressionStatement(m.Assign("=", m.Name(name))):
                yield name


def _followed(bodies: Bodies, ranges: Mapping[str, Interval]) -> PyProof:
    """All bodies; of the constructor each value counts, as others may run in the middle of it."""
    proof = _proof(bodies, ranges)
    proof.body(bodies.constructor)
    proof.left |= {n: _widest(proof.left.get(n), r) for n, r in proof.stored.items()}
    for statements, known in bodies.servers:
        proof.known = {**ranges, **known}
        proof.body(statements)
    return proof


def _proof(bodies: Bodies, ranges: Mapping[str, Interval]) -> PyProof:
    wide = dict.fromkeys(bodies.wide, _BITS)
    return PyProof(wide, bodies.types, bodies.state, ranges, needs=bodies.needs)


def _steps(bodies: Bodies) -> Iterator[int]:
    """The numbers that bounds are likely to stop at: those of the code, and their neighbours."""
    for statements in (bodies.constructor, *(s for s, _ in bodies.servers)):
        for statement in statements:
            for node in m.walk(statement):
                if isinstance(node, m.IntLiteral):
                    for sign in (1, -1):
                        yield from (sign * node.value - 1, sign * node.value, sign * node.value + 1)


def _looped(bodies: Bodies) -> set[str]:
    """The variables that loops write: each value that they get there counts."""
    found: set[str] = set()
    for statements in (bodies.constructor, *(s for s, _ in bodies.servers)):
        for loop in (n for s in statements for n in m.walk(s)):
            if isinstance(loop, m.While | m.For):
                for node in m.walk(loop):
                    match node:
                        case m.Assign(_, m.Name(name)) | m.Postfix(_, m.Name(name)):
                            found.add(name)
    return found


def _rounds(loop: m.For) -> tuple[str, range] | None:
    """The variable of a loop and its numbers, if these are few and all of them come."""
    match loop:
        case m.For(
            m.Declaration(_, (m.Declarator(name, m.IntLiteral(low)),)),
            m.Binary("<", m.Name(other), m.IntLiteral(high)),
            (m.Postfix("++", _),),
        ) if name == other and high - low <= _UNROLLED:
            leaves = m.Break | m.Continue | m.Return
            if not any(isinstance(n, leaves) for n in m.walk(loop.body)):
                return name, range(low, high)
    return None


def _widest(one: Interval | None, other: Interval) -> Interval:
    return other if one is None else (min(one[0], other[0]), max(one[1], other[1]))


def _joined(one: Interval | None, other: Interval | None) -> Interval | None:
    if one is None or other is None:
        return one or other
    return min(one[0], other[0]), max(one[1], other[1])


def _stepped(
    steps: Sequence[int], before: Interval | None, after: Interval | None
) -> Interval | None:
    """A range that grew, up to the next numbers of the code."""
    if after is None or after == before or before is None:
        return after
    low, high = after
    if low < before[0]:
        low = max((s for s in steps if s <= low), default=low)
    if high > before[1]:
        high = min((s for s in steps if s >= high), default=high)
    return low, high
