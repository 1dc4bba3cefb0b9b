"""Timers that bodies stop and let go on: as those of C++, by what does not count when it comes.

A timer that is made anew, when the node runs, does not stop the one before in Python: such are read
where the one before is stopped right before.
"""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.scope import Switch
from rebsync.reverse.graph import Fact, TimerFact
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Frame, Key
from rebsync.reverse.python.expressions.values import TRUTH
from rebsync.reverse.python.values.py_lookup import bound
from rebsync.reverse.python.values.py_worth import Made, NoneValue, Ways
from rebsync.reverse.syntax.py_tree import field, text_of

MADE = "made"


def is_stopped(reading: Reading, call: Node, frame: Frame) -> m.Expression | None:
    """`timer.is_canceled()`; None for another call."""
    function = field(call, "function")
    if function.type != "attribute" or text_of(field(function, "attribute")) != "is_canceled":
        return None
    number = timer_of(reading, field(function, "object"), frame)
    if number is None or (found := alone(reading, number)) is None:
        return None
    if reading.learnt.kind(keys_of(reading.unit.unit.facts[number])[0]) is None:
        return m.BoolLiteral(False)
    return m.Unary("!", m.Name(switch_for(reading, number, found[1]).running))


def switch_of(reading: Reading, number: int) -> Switch | None:
    """What says whether a timer runs; None for one that nobody stops."""
    found = alone(reading, number)
    if found is None or reading.learnt.kind(keys_of(reading.unit.unit.facts[number])[0]) is None:
        return None
    return switch_for(reading, number, found[1])


def timer_of(reading: Reading, holder: Node, frame: Frame) -> int | None:
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


def alone(reading: Reading, number: int) -> tuple[str, int] | None:
    """The server and period of a timer of which no two run at a time."""
    fact = reading.unit.unit.facts[number]
    server, period = reading.servers.get(number), reading.periods.get(number)
    if not isinstance(fact, TimerFact) or server is None or period is None:
        return None
    several = sum(s.name == server.name for s in reading.servers.values()) > 1
    if several or reading.learnt.kind(key_of(fact, MADE)) != TRUTH:
        return None
    return server.name, period


def is_timer(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether an expression is a timer or None."""
    return timer_of(reading, node, frame) is not None


def key_of(fact: Fact, what: str) -> Key:
    """The variable for something of a timer."""
    return "timer", fact.site.call.id, what


def keys_of(fact: Fact) -> tuple[Key, Key, Key]:
    """Those of a `Switch`."""
    return key_of(fact, "running"), key_of(fact, "stale"), key_of(fact, "waiting")


def switch_for(reading: Reading, number: int, period: int) -> Switch:
    """The state variables of a timer that is stopped at times."""
    fact = reading.unit.unit.facts[number]
    assert isinstance(fact, TimerFact)
    kept = fact.site.kept.rpartition(".")[2].strip("_") or "timer"
    words = ("running", "stale", "waiting")[: 3 if fact.one_shot is True else 2]
    names = [reading.state_name(key_of(fact, word), f"{kept}_{word}") for word in words]
    return Switch(names[0], names[1], period, names[2] if len(names) > 2 else "")
