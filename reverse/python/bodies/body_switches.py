"""Statements that stop timers, let them go on, or make them anew."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_timers import again, changed
from rebsync.reverse.findings import Unread
from rebsync.reverse.graph import TimerFact
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_timers import (
    MADE,
    alone,
    key_of,
    keys_of,
    switch_for,
    timer_of,
)
from rebsync.reverse.python.expressions.values import OTHER, TRUTH, WHOLE
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.py_index import arguments_of
from rebsync.reverse.syntax.py_tree import field, named, text_of

# Methods that stop a timer, or let it begin anew.
_SWITCHING = frozenset({"cancel", "reset", "shutdown"})
_LATER = "a timer that is made while the node runs, and stopped, is not read"


def switched(reader: BodyStatementReader, call: Node) -> Iterator[m.Statement] | None:
    """`timer.cancel()` and `timer.reset()`, in rospy `timer.shutdown()`; None for other calls."""
    function = field(call, "function")
    name = text_of(field(function, "attribute")) if function.type == "attribute" else ""
    if name not in _SWITCHING or any(arguments_of(call)):
        return None
    number = timer_of(reader.reading, field(function, "object"), reader.frame)
    if number is None:
        return None
    reading, span = reader.reading, reader.frame.span(call)
    found = alone(reading, number)
    if found is None:
        raise Unread(span, _LATER)
    for key, kind in zip(
        keys_of(reading.unit.unit.facts[number]), (TRUTH, WHOLE, TRUTH), strict=True
    ):
        reading.learnt.join(key, kind)
    server, switch = found[0], switch_for(reading, number, found[1])
    return again(server, switch) if name == "reset" else iter((changed(server, switch, False),))


def made(reader: BodyStatementReader, fact: TimerFact, call: Node) -> None:
    """Takes note of a timer that is made: at first and once, or when the one before is stopped."""
    is_first = reader.frame.is_start and call.id not in reader.reading.timers
    reader.reading.timers.add(call.id)
    is_only = is_first or (not reader.frame.is_start and _is_stopped_before(call))
    reader.reading.learnt.join(key_of(fact, MADE), TRUTH if is_only else OTHER)


def lost(reader: BodyStatementReader, target: Node) -> None:
    """A variable with a timer gets None: the timer goes on, unless it is stopped right before."""
    number = timer_of(reader.reading, target, reader.frame)
    if number is not None and not reader.frame.is_start and not _is_stopped_before(target):
        fact = reader.reading.unit.unit.facts[number]
        reader.reading.learnt.join(key_of(fact, MADE), OTHER)


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
