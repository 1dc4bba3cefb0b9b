"""Timers that bodies stop and let go on: as those of C++, by what does not count when it comes.

A timer that is made anew, when the node runs, does not stop the one before in Python: such are read
where the one before is stopped right before.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_timers import again, changed
from rebsync.reverse.bodies.scope import Switch
from rebsync.reverse.findings import Unread
from rebsync.reverse.graph import Fact, TimerFact
from rebsync.reverse.python.body_reading import Reading
from rebsync.reverse.python.body_scope import OTHER, TRUTH, WHOLE, Frame, Key
from rebsync.reverse.python.py_index import arguments_of
from rebsync.reverse.python.py_lookup import bound
from rebsync.reverse.python.py_tree import field, named, text_of
from rebsync.reverse.python.py_worth import Made, NoneValue, Ways
from rebsync.reverse.syntax.ancestors import climb

if TYPE_CHECKING:
    from rebsync.reverse.python.body_expression_reader import BodyExpressionReader
    from rebsync.reverse.python.body_statement_reader import BodyStatementReader

# Methods that stop a timer, or let it begin anew.
_SWITCHING = frozenset({"cancel", "reset", "shutdown"})
_MADE = "made"
_LATER = "a timer that is made while the node runs, and stopped, is not read"


def switched(reader: BodyStatementReader, call: Node) -> Iterator[m.Statement] | None:
    """`timer.cancel()` and `timer.reset()`, in rospy `timer.shutdown()`; None for other calls."""
    function = field(call, "function")
    name = text_of(field(function, "attribute")) if function.type == "attribute" else ""
    if name not in _SWITCHING or any(arguments_of(call)):
        return None
    number = _number(reader.reading, field(function, "object"), reader.frame)
    if number is None:
        return None
    reading, span = reader.reading, reader.frame.span(call)
    found = _started(reading, number)
    if found is None:
        raise Unread(span, _LATER)
    for key, kind in zip(
        _keys(reading.unit.unit.facts[number]), (TRUTH, WHOLE, TRUTH), strict=True
    ):
        reading.learnt.join(key, kind)
    server, switch = found[0], _switch(reading, number, found[1])
    return again(server, switch) if name == "reset" else iter((changed(server, switch, False),))


def is_stopped(reading: Reading, call: Node, frame: Frame) -> m.Expression | None:
    """`timer.is_canceled()`; None for another call."""
    function = field(call, "function")
    if function.type != "attribute" or text_of(field(function, "attribute")) != "is_canceled":
        return None
    number = _number(reading, field(function, "object"), frame)
    if number is None or (found := _started(reading, number)) is None:
        return None
    if reading.learnt.kind(_keys(reading.unit.unit.facts[number])[0]) is None:
        return m.BoolLiteral(False)
    return m.Unary("!", m.Name(_switch(reading, number, found[1]).running))


def switch_of(reading: Reading, number: int) -> Switch | None:
    """What says whether a timer runs; None for one that nobody stops."""
    found = _started(reading, number)
    if found is None or reading.learnt.kind(_keys(reading.unit.unit.facts[number])[0]) is None:
        return None
    return _switch(reading, number, found[1])


def _number(reading: Reading, holder: Node, frame: Frame) -> int | None:
    """The number of the timer that an expression is; calling a method of None raises."""
    ways = [w for w in _ways(reading, holder, frame) if not isinstance(w, NoneValue)]
    made = [w for w in ways if isinstance(w, Made)]
    numbers = {reading.unit.calls.get((w.scope.py.source.path, w.call.id)) for w in made}
    if len(numbers) != 1 or len(made) != len(ways):
        return None
    (number,) = numbers
    is_timer = number is not None and isinstance(reading.unit.unit.facts[number], TimerFact)
    return number if is_timer else None


def _ways(reading: Reading, holder: Node, frame: Frame) -> Ways:
    """What an expression stands for; an attribute of the object for what any method gives it."""
    if holder.type != "attribute" or text_of(field(holder, "object")) != frame.scope.self_name:
        return reading.values.ways(holder, frame.scope)
    name = text_of(field(holder, "attribute"))
    given = [
        bound(reading.values, binding, name, owner)
        for owner in reading.unit.lineage
        for binding in (*owner.attributes.get(name, ()), *owner.names.get(name, ()))
    ]
    return tuple(way for ways in given for way in ways)


def _started(reading: Reading, number: int) -> tuple[str, int] | None:
    """The server and period of a timer of which no two run at a time."""
    fact = reading.unit.unit.facts[number]
    server, period = reading.servers.get(number), reading.periods.get(number)
    if not isinstance(fact, TimerFact) or server is None or period is None:
        return None
    alone = sum(s.name == server.name for s in reading.servers.values()) == 1
    if not alone or reading.learnt.kind(_key(fact, _MADE)) != TRUTH:
        return None
    return server.name, period


def made(reader: BodyStatementReader, fact: TimerFact, call: Node) -> None:
    """Takes note of a timer that is made: at first and once, or when the one before is stopped."""
    is_first = reader.frame.is_start and call.id not in reader.reading.timers
    reader.reading.timers.add(call.id)
    is_only = is_first or (not reader.frame.is_start and _is_stopped_before(call))
    reader.reading.learnt.join(_key(fact, _MADE), TRUTH if is_only else OTHER)


def lost(reader: BodyStatementReader, target: Node) -> None:
    """A variable with a timer gets None: the timer goes on, unless it is stopped right before."""
    number = _number(reader.reading, target, reader.frame)
    if number is not None and not reader.frame.is_start and not _is_stopped_before(target):
        fact = reader.reading.unit.unit.facts[number]
        reader.reading.learnt.join(_key(fact, _MADE), OTHER)


def is_timer(reader: BodyExpressionReader, node: Node) -> bool:
    """Whether an expression is a timer or None."""
    return _number(reader.reading, node, reader.frame) is not None


def _is_stopped_before(node: Node) -> bool:
    """Whether a statement before the one around stops the timer of the variable that it sets."""
    at = climb(node, lambda n: n.type == "expression_statement")
    inner = named(at)[0] if at is not None else node
    target = text_of(field(inner, "left")) if inner.type == "assignment" else ""
    before = at.prev_named_sibling if at is not None else None
    while before is not None:
        if _stops(before, target):
            return True
        before = before.prev_named_sibling
    return False


def _stops(statement: Node, target: str) -> bool:
    """Whether a statement stops a timer, if there is one."""
    if statement.type == "if_statement":
        test = "".join(text_of(field(statement, "condition")).split())
        tests = (target, f"{target}isnotNone", f"{target}!=None")
        inner = named(field(statement, "consequence"))
        return test in tests and bool(inner) and _stops(inner[0], target)
    return text_of(statement) in (f"{target}.shutdown()", f"{target}.cancel()")


def _key(fact: Fact, what: str) -> Key:
    return "timer", fact.site.call.id, what


def _keys(fact: Fact) -> tuple[Key, Key, Key]:
    return _key(fact, "running"), _key(fact, "stale"), _key(fact, "waiting")


def _switch(reading: Reading, number: int, period: int) -> Switch:
    fact = reading.unit.unit.facts[number]
    assert isinstance(fact, TimerFact)
    kept = fact.site.kept.rpartition(".")[2].strip("_") or "timer"
    words = ("running", "stale", "waiting")[: 3 if fact.one_shot is True else 2]
    names = [reading.state_name(_key(fact, word), f"{kept}_{word}") for word in words]
    return Switch(names[0], names[1], period, names[2] if len(names) > 2 else "")
