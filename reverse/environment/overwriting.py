"""Topics to which one step of a class may publish more than once: only the last message is seen.

States are looked at between steps, where an observation holds the last message of each topic. What
a body published before the last is in no state, so that nothing is proved of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.nodes.node_joined import OBSERVER

_MANY = 2


@dataclass(frozen=True, slots=True)
class Count:
    """How many messages the ways through some statements publish at most, up to `_MANY`.

    `through` is that of the ways to what follows, None if there are none; `out` that of the ways
    that end the body.
    """

    through: int | None
    out: int = 0

    def then(self, later: Count) -> Count:
        """The count of one after the other."""
        if self.through is None:
            return self
        through = None if later.through is None else min(self.through + later.through, _MANY)
        return Count(through, max(self.out, min(self.through + later.out, _MANY)))

    def either(self, other: Count) -> Count:
        """The count of one or the other."""
        ways = [w for w in (self.through, other.through) if w is not None]
        return Count(max(ways) if ways else None, max(self.out, other.out))


_NONE = Count(0)


def overwritten(model: m.Model, topics: Iterable[str]) -> Iterator[tuple[str, str]]:
    """The classes of a model that send to the observer, and topics that a step may repeat."""
    for owner in model.classes:
        for topic in topics if isinstance(owner, m.ReactiveClass) else ():
            assert isinstance(owner, m.ReactiveClass)
            of_class = _PublicationCount(owner, topic, {})
            bodies = [x for x in owner.members if isinstance(x, m.Constructor | m.MessageServer)]
            if any(of_class.most(x.body) >= _MANY for x in bodies if x.body is not None):
                yield owner.name, topic


@dataclass(frozen=True, slots=True)
class _PublicationCount:
    """Counts what the bodies of a class publish to one topic; `methods` are those known by now."""

    owner: m.ReactiveClass
    topic: str
    methods: dict[str, int]

    def most(self, body: m.Block) -> int:
        """The most messages that one run of a body publishes."""
        count = self._statement(body)
        return max(count.out, count.through or 0)

    def _statement(self, statement: m.Statement) -> Count:
        match statement:
            case m.Block(statements):
                return self._in_turn(statements)
            case m.If(condition, then, otherwise):
                other = self._statement(otherwise) if otherwise is not None else _NONE
                return self._parts(condition).then(self._statement(then).either(other))
            case m.While() | m.For():
                inside = self._statement(statement.body).either(_NONE)
                around = self._parts(*(p for p in m.children(statement) if p is not statement.body))
                once = around.then(inside)
                return Count(_MANY if once.through else 0, min(once.out, _MANY)).either(once)
            case m.Switch(subject, cases):
                return self._parts(subject).then(self._cases(cases))
            case m.Return(value):
                given = self._parts(value) if value is not None else _NONE
                return Count(None, given.through or 0)
            case _:
                return self._parts(statement)

    def _cases(self, cases: Iterable[m.Case]) -> Count:
        """The count of a switch, where a case that does not end goes on with the next."""
        found, before = _NONE, None
        for case in cases:
            own = self._in_turn(case.statements)
            count = own if before is None else own.either(before.then(own))
            found = found.either(count)
            before = None if case.statements[-1:] and _ends(case.statements[-1]) else count
        return found

    def _in_turn(self, statements: Iterable[m.Statement]) -> Count:
        count = _NONE
        for statement in statements:
            count = count.then(self._statement(statement))
        return count

    def _parts(self, *nodes: m.Node) -> Count:
        """The count of calls in expressions."""
        calls = (n for node in nodes for n in m.walk(node) if isinstance(n, m.Call))
        return Count(min(sum(map(self._call, calls)), _MANY))

    def _call(self, call: m.Call) -> int:
        match call.target:
            case m.Name(name) if name == OBSERVER:
                return int(call.name == self.topic)
            case None:
                return self._method(call.name)
            case _:
                return 0

    def _method(self, name: str) -> int:
        if name not in self.methods:
            self.methods[name] = _MANY  # until it is known: it may call itself
            bodies = [
                x.body
                for x in self.owner.members
                if isinstance(x, m.Method) and x.name == name and x.body is not None
            ]
            self.methods[name] = max(map(self.most, bodies), default=0)
        return self.methods[name]


def _ends(statement: m.Statement) -> bool:
    """Whether a case goes no further than this, its last statement."""
    if isinstance(statement, m.Block) and statement.statements:
        return _ends(statement.statements[-1])
    return isinstance(statement, m.Break | m.Return | m.Continue)
