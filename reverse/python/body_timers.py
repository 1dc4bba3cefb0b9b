"""Timers that bodies stop and let go on: as those of C++, by what does not count when it comes."""

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
from rebsync.reverse.python.py_tree import field, text_of
from rebsync.reverse.python.py_worth import Made, NoneValue

if TYPE_CHECKING:
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
    for key, kind in zip(_keys(reading.unit.unit.facts[number]), (TRUTH, WHOLE), strict=True):
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
    ways = [w for w in reading.values.ways(holder, frame.scope) if not isinstance(w, NoneValue)]
    made = [w for w in ways if isinstance(w, Made)]
    numbers = {reading.unit.calls.get((w.scope.py.source.path, w.call.id)) for w in made}
    if len(numbers) != 1 or len(made) != len(ways):
        return None
    (number,) = numbers
    is_timer = number is not None and isinstance(reading.unit.unit.facts[number], TimerFact)
    return number if is_timer else None


def _started(reading: Reading, number: int) -> tuple[str, int] | None:
    """The server and period of a timer that goes on and is made once, when the node starts."""
    fact = reading.unit.unit.facts[number]
    server, period = reading.servers.get(number), reading.periods.get(number)
    if not isinstance(fact, TimerFact) or fact.one_shot is True or server is None:
        return None
    if period is None or reading.learnt.kind(_key(fact, _MADE)) != TRUTH:
        return None
    return server.name, period


def made(reader: BodyStatementReader, fact: TimerFact) -> None:
    """Takes note of a timer that is made: only one that is made once, at first, can be stopped."""
    call = fact.site.call.id
    is_first = reader.frame.is_start and call not in reader.reading.timers
    reader.reading.timers.add(call)
    reader.reading.learnt.join(_key(fact, _MADE), TRUTH if is_first else OTHER)


def _key(fact: Fact, what: str) -> Key:
    return "timer", fact.site.call.id, what


def _keys(fact: Fact) -> tuple[Key, Key]:
    return _key(fact, "running"), _key(fact, "stale")


def _switch(reading: Reading, number: int, period: int) -> Switch:
    fact = reading.unit.unit.facts[number]
    kept = fact.site.kept.rpartition(".")[2].strip("_") or "timer"
    running, stale = _keys(fact)
    names = (
        reading.state_name(running, f"{kept}_running"),
        reading.state_name(stale, f"{kept}_stale"),
    )
    return Switch(*names, period)
