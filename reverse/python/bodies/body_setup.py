"""What sets a node up, waits, or ends it: calls of the client libraries, as statements."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_timers import started
from rebsync.reverse.findings import Unread
from rebsync.reverse.graph import (
    ParameterFact,
    PublisherFact,
    RateFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.program_ends import starting_contexts
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.python.bodies import (
    body_calls,
    body_loops,
    body_methods,
    body_switches,
    body_timers,
)
from rebsync.reverse.python.bodies.body_effects import is_harmless, makes_again
from rebsync.reverse.python.bodies.body_expressions import short
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_units import wakes
from rebsync.reverse.python.values.py_worth import Class
from rebsync.reverse.syntax.py_index import CLASS, arguments_of, last_name
from rebsync.reverse.syntax.py_tree import field, text_of

_SENDS = "this sends only while the life cycle of the node is active: the model always does"
_NAMES = frozenset({"identifier", "attribute"})


def asked(reader: BodyStatementReader, call: Node) -> Iterator[m.Statement] | None:
    """The statements of a call to the client library; None for any other call."""
    found = reader.reading.fact(call, reader.frame)
    if found is not None:
        return _fact(reader, call, *found) if not isinstance(found[1], ParameterFact) else None
    function = field(call, "function")
    name = reader.reading.external(function, reader.frame)
    plain, _ = arguments_of(call)
    if libraries.kind_of(name) is Kind.SLEEP and len(plain) == 1:
        if not is_harmless(reader.reading, plain[0], reader.frame):
            raise Unread(reader.frame.span(call), "how long this waits is not known")
        return iter((delay(body_calls.units(reader.expressions, plain[0]), reader, call),))
    if last_name(function) == "sleep" and function.type == "attribute":
        made = reader.reading.made_by(field(function, "object"), reader.frame)
        if made is not None and isinstance(made[1], RateFact):
            period = reader.reading.periods.get(made[0])
            if period is None:
                raise Unread(reader.frame.span(call), "how long this waits is not known")
            if not wakes(reader.reading.unit, reader.reading.code, reader.frame.is_start):
                why = "only the executor that waits for this could end the sleep of a rate"
                raise Unread(reader.frame.span(call), why)
            return iter((delay(m.IntLiteral(period), reader, call),))
    return _started(reader, call, name) if reader.frame.is_start else None


def is_entered(reader: BodyStatementReader, context: Node) -> bool:
    """Whether `with` starts by this what runs a node, and ends it where its block does."""
    if context.type != "call" or not reader.frame.is_start:
        return False
    name = reader.reading.external(field(context, "function"), reader.frame)
    return name in starting_contexts()


def delay(time: m.Expression, reader: BodyStatementReader, node: Node) -> m.Statement:
    """`delay(t);`"""
    span = reader.frame.span(node)
    return m.ExpressionStatement(m.Call(None, "delay", (time,), span=span), (), span)


def send(server: str, period: int, node: Node, reader: BodyStatementReader) -> m.Statement:
    """`self.server() after(period);`"""
    after = m.IntLiteral(period) if period else None
    span = reader.frame.span(node)
    return m.ExpressionStatement(m.Call(m.Self(), server, (), after, span=span), (), span)


def _fact(
    reader: BodyStatementReader, call: Node, number: int, fact: object
) -> Iterator[m.Statement]:
    span = reader.frame.span(call)
    match fact:
        case TimerFact():
            server, period = reader.reading.servers.get(number), reader.reading.periods.get(number)
            if server is None or period is None:
                raise Unread(span, "the callback or the period of this timer is not known")
            if fact.autostart is not True:
                raise Unread(span, "a timer that is started later is not read")
            if reader.frame.depth:
                raise Unread(span, "whether there is this timer depends on a condition")
            body_switches.made(reader, fact, call)
            switch = body_timers.switch_of(reader.reading, number)
            if switch is not None:
                yield from started(switch)
            yield send(server.name, period, call, reader)
        case SubscriptionFact(single=True):
            raise Unread(span, "it waits here for one message")
        case SubscriptionFact() if not reader.frame.is_start:
            raise Unread(span, "it subscribes while it runs: in the model it always has")
        case PublisherFact() if libraries.sends_while_active(last_name(field(call, "function"))):
            raise Unread(span, _SENDS)
        case _:
            return


def _started(reader: BodyStatementReader, call: Node, name: str) -> Iterator[m.Statement] | None:
    """What only starts the node, or lets it run."""
    function = field(call, "function")
    last = last_name(function)
    if (method := _of_new_object(reader, function)) is not None:
        return chain(*method)
    if last != "__init__" and reader.reading.function(function, reader.frame) is not None:
        return None
    asked_ = libraries.function(name)
    kind = asked_.kind if asked_ is not None else None
    if kind is Kind.SPIN or (last == "spin" and not name):
        until = asked_ is not None and asked_.result == "future"
        if until and body_loops.goes_on(call):
            raise Unread(reader.frame.span(call), "what runs when this has come is not read")
        reader.is_over = True
        plain, _ = arguments_of(call)
        made = [a for a in plain if a.type == "call"]
        return asked(reader, made[0]) if made else iter(())
    if kind is Kind.EXIT and len(plain := arguments_of(call)[0]) <= 1 and not reader.frame.depth:
        return _exit(reader, plain)
    if kind is Kind.START or (last in libraries.methods_of(Kind.START, Kind.SPIN) and not name):
        return iter(())
    lineage = reader.reading.unit.lineage
    if makes_again(call, reader.frame.scope.self_name):
        return None
    if last == "__init__":
        above = reader.reading.method("__init__", 1)
        running = above is not None and above.node.id not in reader.running
        return body_methods.inlined(reader, above, call) if above and running else iter(())
    ways = reader.reading.values.ways(function, reader.frame.scope)
    if lineage and any(isinstance(w, Class) and w.scope is lineage[0] for w in ways):
        own = reader.reading.method("__init__", 0)
        _bind_object(reader, call)
        return body_methods.inlined(reader, own, call) if own is not None else iter(())
    if any(isinstance(w, Class) and w.scope.kind == CLASS for w in ways):
        return _made(reader, call)
    return None


def _made(reader: BodyStatementReader, call: Node) -> Iterator[m.Statement]:
    """An object of a class beside the node: a node of its own, or one that only helps.

    That it keeps the node that it gets is no matter, until something is called of it.
    """
    plain, keywords = arguments_of(call)
    for given in (*plain, *keywords.values()):
        yield from _argument(reader, given)
    effects, frame = reader.reading.effects, reader.frame
    ways = reader.reading.values.ways(field(call, "function"), frame.scope)
    helpers = [w.scope for w in ways if isinstance(w, Class)]
    made = (c for c in helpers if c not in reader.reading.nodes)
    if effects is not None and any(map(effects.of_construction, made)):
        raise Unread(frame.span(call), "to make this object acts on the node")


def _argument(reader: BodyStatementReader, given: Node) -> Iterator[m.Statement]:
    """What an argument does when it is evaluated."""
    if given.type in _NAMES:
        return
    known = asked(reader, given) if given.type == "call" else None
    if known is not None:
        yield from known
    elif not is_harmless(reader.reading, given, reader.frame):
        raise Unread(reader.frame.span(given), f'what "{short(given)}" does is not known')


def _of_new_object(
    reader: BodyStatementReader, function: Node
) -> tuple[Iterator[m.Statement], Iterator[m.Statement]] | None:
    """`Node().spin()`: the object is made, then its method runs; None for all else."""
    made = field(function, "object") if function.type == "attribute" else function
    lineage = reader.reading.unit.lineage
    if made.type != "call" or not lineage:
        return None
    ways = reader.reading.values.ways(field(made, "function"), reader.frame.scope)
    own = reader.reading.method(last_name(function), 0)
    if own is None or not any(isinstance(w, Class) and w.scope is lineage[0] for w in ways):
        return None
    call = function.parent
    first = _started(reader, made, "")
    return (first or iter(()), body_methods.inlined(reader, own, call or made))


def _exit(reader: BodyStatementReader, given: list[Node]) -> Iterator[m.Statement]:
    """`sys.exit(main())`: what it is given runs, and nothing after it."""
    for node in given:
        yield from reader.expression(node)
    reader.is_over = True


def _bind_object(reader: BodyStatementReader, call: Node) -> None:
    """The variable that the object is put into stands for it."""
    from rebsync.reverse.python.bodies.body_scope import Own

    above = call.parent
    if above is not None and above.type == "assignment":
        target = field(above, "left")
        if target.type == "identifier":
            reader.frame.bound[text_of(target)] = Own()
