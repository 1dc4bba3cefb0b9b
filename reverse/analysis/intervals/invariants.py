"""What the state variables of a class hold, whatever it is sent: class invariants by intervals.

Inferred from all bodies together (Logozzo, "Automatic inference of class invariants", VMCAI 2004):
a server starts where the constructor or a server has ended, and a function of the class may be
called in the middle of any body. The class must be alone, and all that it does must be known.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from enum import Enum, auto

from rebsync import model as m
from rebsync.intervals import INT32, INTEGERS, Interval, exactly
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.interval_analysis import IntervalAnalysis
from rebsync.reverse.analysis.intervals.interval_values import note
from rebsync.reverse.analysis.intervals.needs import Mark, Need
from rebsync.reverse.analysis.intervals.writes import written

_BITS = 63
_WIDTHS = {"byte": 7, "short": 15, "int": 31}
_PLAIN_ROUNDS = 3
_MOST_ROUNDS = 40


class BodyStart(Enum):
    """When a body starts: before anything else, between two messages, or in another body."""

    FIRST = auto()
    BETWEEN = auto()
    WITHIN = auto()


@dataclass(frozen=True, slots=True)
class Body:
    """A body with the types of the names and of what functions give; the rest as the analysis has
    it. It cuts the integers that `cuts` has, and those alone. `arguments` are what its parameters
    can be, where that is known.
    """

    name: str
    entry: BodyStart
    statements: Sequence[m.Statement]
    types: Mapping[str, m.Type]
    parameters: Collection[str] = ()
    results: Mapping[str, m.Type] = field(default_factory=dict)
    cuts: Mapping[int, Interval] = field(default_factory=dict)
    needs: Mapping[int, Sequence[Need]] = field(default_factory=dict)
    arguments: Mapping[str, Interval] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Unbounded:
    """What integers without bounds come to: needs that may not hold, variables that may leave the
    `int`, and those that only count up to its end.
    """

    failed: frozenset[Mark]
    broken: frozenset[str]
    counted: frozenset[str]


@dataclass(frozen=True, slots=True)
class _Held:
    """What state variables hold: at any time, and when a server starts."""

    always: Mapping[str, Interval]
    between: Mapping[str, Interval]

    @staticmethod
    def zero(names: Iterable[str]) -> _Held:
        zero = dict.fromkeys(names, exactly(0))
        return _Held(zero, zero)

    def widened(self, later: _Held, thresholds: Sequence[int]) -> _Held:
        return _Held(
            {n: self.always[n].widen(r, thresholds) for n, r in later.always.items()},
            {n: self.between[n].widen(r, thresholds) for n, r in later.between.items()},
        )


def failed(
    bodies: Sequence[Body],
    state: Mapping[str, m.Type] | None,
    constants: Mapping[str, Interval] | None = None,
) -> set[Mark]:
    """The needs of bodies that may not hold, where `constants` hold these values at any time.

    `state` are the state variables of the class that has these bodies and no others, to be
    followed through all of them; where these are not known (None) they may hold anything.
    """
    names = {name for name, type_ in (state or {}).items() if type_.name in INTEGERS}
    names -= _hidden(bodies)
    fixed = dict(constants or {})
    for name in _hidden(bodies) | {n for b in bodies for s in b.statements for n in written(s)}:
        fixed.pop(name, None)
    asking = [body for body in bodies if body.needs]
    found = _Round(_Held({}, {}), fixed).over(asking).failed if asking else set()
    if not found or not names:
        return found
    last = _fixpoint(bodies, _Round(_Held.zero(names), fixed, widths=dict.fromkeys(names, _BITS)))
    return last.failed if last is not None else found


def between_messages(bodies: Sequence[Body], state: Mapping[str, m.Type]) -> Mapping[str, Interval]:
    """What the integers among state variables hold whenever a server of the class starts.

    The integers of the bodies wrap, as those of a model do; nothing of one that locals hide.
    """
    names = {name for name, type_ in state.items() if type_.name in _WIDTHS} - _hidden(bodies)
    widths = {name: _WIDTHS[state[name].name] for name in names}
    last = _fixpoint(bodies, _Round(_Held.zero(widths), widths=widths, wraps=True))
    return last.held.between if last is not None else {}


def unbounded(
    constructor: Body, servers: Sequence[Body], state: Collection[str], wide: Collection[str]
) -> Unbounded:
    """What integers without bounds come to, those of `state` from body to body; `wide` are all.

    While the constructor runs, servers may: each value that it stores counts.
    """
    bodies, widths = (constructor, *servers), dict.fromkeys(wide, _BITS)
    once = _Round(_Held({}, {}), changed=(), widths=widths)
    stored = once.over([constructor]).stored
    sure = set(_surely(constructor.statements))
    first = {n: stored.get(n, exactly(0)) for n in widths.keys() & set(state)}
    first = {n: r if n in sure else r.join(exactly(0)) for n, r in first.items()}
    start = replace(once.afresh(), held=_Held(first, first), interrupted=constructor)
    last = _fixpoint(bodies, start) or once.afresh().over(bodies)
    return Unbounded(frozenset(last.failed), frozenset(last.broken), frozenset(last.counted))


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


def _fixpoint(bodies: Sequence[Body], start: _Round) -> _Round | None:
    """The round over all bodies after which nothing is new; None if there are too many."""
    thresholds = sorted({*limits_in(_nodes(bodies)), INT32.low, INT32.high, -1, 0, 1})
    called = _called(bodies)
    within = [s for body in bodies if body.name in called for s in body.statements]
    changed = frozenset(name for statement in within for name in written(statement))
    round_ = replace(start, called=called, changed=changed)
    for number in range(_MOST_ROUNDS):
        held = round_.over(bodies).held
        later = round_.later()
        if later == held:
            return round_
        held = held.widened(later, thresholds) if number >= _PLAIN_ROUNDS else later
        round_ = replace(round_.afresh(), held=held)
    return None


@dataclass(slots=True)
class _Round:
    """Follows each body once, with what state variables are taken to hold when it starts, and what
    some names (`fixed`) always do.

    `called` are the bodies that others call, whatever else they are, and `changed` what these
    change, if that is known. `widths` are the bits of state variables; `wraps` says whether sums
    wrap: then no counter is trusted to stay below the greatest number. Others may start while the
    body that is `interrupted`, the first, runs.
    """

    held: _Held
    fixed: Mapping[str, Interval] = field(default_factory=dict)
    called: frozenset[str] = frozenset()
    changed: Collection[str] | None = None
    widths: Mapping[str, int] = field(default_factory=dict)
    wraps: bool = False
    interrupted: Body | None = None
    failed: set[Mark] = field(default_factory=set)
    broken: set[str] = field(default_factory=set)
    counted: set[str] = field(default_factory=set)
    stored: dict[str, Interval] = field(default_factory=dict)
    left: dict[str, Interval] = field(default_factory=dict)

    def afresh(self) -> _Round:
        """The same before any body."""
        return replace(self, failed=set(), broken=set(), counted=set(), stored={}, left={})

    def over(self, bodies: Sequence[Body]) -> _Round:
        for body in bodies:
            self._follow(body, BodyStart.WITHIN if body.name in self.called else body.entry)
            if body is self.interrupted:
                for name, values in self.stored.items():
                    note(self.left, name, values)
        return self

    def _follow(self, body: Body, entry: BodyStart) -> None:
        names = self.held.always.keys()
        known: Mapping[str, Interval] = {}
        if entry is BodyStart.FIRST:
            known = dict.fromkeys(names, exactly(0))
        elif entry is BodyStart.BETWEEN:
            known = self.held.between
        IntervalAnalysis(
            self.widths,
            body.types,
            {**known, **body.arguments},
            {**self.fixed, **self.held.always},
            parameters=body.parameters,
            state=() if body.entry is BodyStart.WITHIN else names,
            called=set(body.types) if self.changed is None else self.changed,
            needs=body.needs,
            wraps=self.wraps,
            trusts_counters=not self.wraps,
            cuts=body.cuts,
            results=body.results,
            broken=self.broken,
            counted=self.counted,
            failed=self.failed,
            stored=self.stored,
            left=self.left,
        ).body(body.statements)

    def later(self) -> _Held:
        """What state variables hold, with what the bodies have stored and left."""
        held = self.held
        return _Held(
            {n: r.join(self.stored.get(n, r)) for n, r in held.always.items()},
            {n: r.join(self.left.get(n, r)) for n, r in held.between.items()},
        )


def _hidden(bodies: Sequence[Body]) -> set[str]:
    """The names of parameters and locals, whatever else has them."""
    found = {name for body in bodies for name in body.parameters}
    return found | {node.name for node in _nodes(bodies) if isinstance(node, m.Declarator)}


def _called(bodies: Sequence[Body]) -> frozenset[str]:
    """The functions of the class that its bodies call."""
    calls = (n for n in _nodes(bodies) if isinstance(n, m.Call) and n.target is None)
    return frozenset(call.name for call in calls)


def limits_in(nodes: Iterable[m.Node]) -> Iterator[int]:
    """The numbers that bounds are likely to stop at: those of the code, and their neighbours."""
    for node in nodes:
        if isinstance(node, m.IntLiteral):
            for sign in (1, -1):
                yield from (sign * node.value - 1, sign * node.value, sign * node.value + 1)


def _nodes(bodies: Sequence[Body]) -> Iterator[m.Node]:
    for body in bodies:
        for statement in body.statements:
            yield from m.walk(statement)
