"""Periodic timers that bodies stop and start.

What a stopped timer has sent itself already does not count when it comes: it is stale. Messages of
one timer come in the order in which they were sent, so that a number of stale ones will do.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Switch, TimerOf
from rebsync.reverse.models.building import binary
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

# Methods that stop a timer, or let it go on.
SWITCHING = frozenset({"start", "stop", "cancel", "reset"})
_ZERO, _ONE = m.IntLiteral(0), m.IntLiteral(1)
_WHY = "the model cannot stop, start or change what it sent itself for later"
_HINT = "let the callback look at a variable that says whether it is wanted"


def switched(
    reader: CppStatementReader, node: Node, function: Node
) -> Iterator[m.Statement] | None:
    """`timer.stop()`, `timer.start()`; None for a call of something else.

    In ROS 2 `timer->cancel()` and `timer->reset()`; `timer.reset()` ends the timer.
    """
    meaning = resolve(reader.scope, part(function, "argument"))
    name = text_of(part(function, "field"))
    if name == "reset" and named(part(node, "arguments")):
        return None  # the variable gets another timer
    if name == "reset" and not any(c.type == "->" for c in function.children):
        name = "cancel"
    if not isinstance(meaning, TimerOf) or name not in (*SWITCHING, "setPeriod"):
        return None
    if meaning.switch is None or name == "setPeriod":
        raise reader.unread(node, _WHY, _HINT)
    if name == "reset":
        return iter(again(meaning.server, meaning.switch))
    return iter((changed(meaning.server, meaning.switch, name == "start"),))


def again(server: str, switch: Switch) -> Iterator[m.Statement]:
    """A timer that begins its period anew, whether it runs or not."""
    yield changed(server, switch, False)
    yield changed(server, switch, True)


def changed(server: str, switch: Switch, start: bool) -> m.Statement:
    """A timer is started or stopped, if it is not yet.

    One that has gone off once, and for good, still counts as started until it is stopped.
    """
    running = m.Name(switch.running)
    sets = (
        _set(switch.running, start),
        *((_set(switch.waiting, start),) if switch.waiting else ()),
    )
    if start:
        send = m.Call(m.Self(), server, (), m.IntLiteral(switch.period))
        return m.If(m.Unary("!", running), m.Block((*sets, m.ExpressionStatement(send))), None)
    one_more: m.Statement = _counted(switch.stale, "+")
    if switch.waiting:
        stops = m.Block((one_more, _set(switch.waiting, False)))
        one_more = m.If(m.Name(switch.waiting), stops, None)
    return m.If(running, m.Block((_set(switch.running, False), one_more)), None)


def started(switch: Switch) -> tuple[m.Statement, ...]:
    """A timer runs from here on."""
    names = (switch.running, *((switch.waiting,) if switch.waiting else ()))
    return tuple(_set(name, True) for name in names)


def _set(name: str, value: bool) -> m.Statement:
    return m.ExpressionStatement(m.Assign("=", m.Name(name), m.BoolLiteral(value)))


def _counted(name: str, operator: str) -> m.Statement:
    value = binary(operator, m.Name(name), _ONE)
    return m.ExpressionStatement(m.Assign("=", m.Name(name), value))


def without_stale(body: m.Block, switch: Switch) -> m.Block:
    """The body of a timer's server, which does nothing for a stale message."""
    leaves = m.Block((_counted(switch.stale, "-"), m.Return(None)))
    first: list[m.Statement] = [m.If(binary(">", m.Name(switch.stale), _ZERO), leaves, None)]
    if switch.waiting:
        first.append(_set(switch.waiting, False))
    return m.Block((*first, *body.statements), body.annotations, body.span)


def stale_messages(switches: Mapping[str, Switch], bodies: Iterable[m.Node]) -> int:
    """How many stale messages may wait, if each place that starts a timer runs once in a unit."""
    calls = (n for body in bodies for n in m.walk(body) if isinstance(n, m.Call))
    sent = [call.name for call in calls if isinstance(call.target, m.Self)]
    starts = {n: sent.count(n) - (not each.waiting) for n, each in switches.items()}
    return sum(max(starts[n], 0) * each.period for n, each in switches.items())
