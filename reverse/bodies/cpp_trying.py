"""`try` of C++: what is outside may throw; what the model has mostly does not."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.cpp_users import is_logging
from rebsync.reverse.bodies.effects.cpp_effects import touching
from rebsync.reverse.bodies.effects.cpp_roots import declared_in
from rebsync.reverse.bodies.scope import Outside
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import bare, is_calm
from rebsync.reverse.syntax.cpp_calls import calls_in
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

_MAILBOX = "mailbox_"  # a member of classes whose bodies the run-time part runs
_TRUTH = m.Choice((m.BoolLiteral(True), m.BoolLiteral(False)))
# The types of handlers that take nothing of what the run-time part throws; others may.
_OTHERS = re.compile(
    r"\(\s*(?:const\s+)?std\s*::\s*(?:bad_\w+|invalid_argument|length_error|domain_error|range_error"
    r"|overflow_error|underflow_error|system_error|regex_error|future_error)\b"
)


def tried(reader: CppStatementReader, node: Node) -> Iterator[m.Statement]:
    """`try`: what is outside may throw; what the model has does not.

    So nothing has happened in the model where a handler starts, if all that may throw is first.
    Handlers that only log, and throw it again, change nothing of what becomes of an exception.
    """
    body, span = part(node, "body"), reader.cpp.span(node)
    handlers = [c for c in named(node) if c.type == "catch_clause"]
    if handlers and all(map(_goes_on, handlers)):
        told = (statement for handler in handlers for statement in _logged(reader, handler))
        yield m.Block((*reader.branch(body).statements, *told), (), span)
        return
    statements = named(body)
    risky = [touching(reader.cpp, reader.scope, s) is None or _unknown(s) for s in statements]
    last = max((i for i, r in enumerate(risky) if r), default=-1)
    if not all(risky[: last + 1]):
        why = "an exception may leave this half done"
        raise reader.unread(node, why, "do what may throw first, in a try of its own")
    if handlers and any(c.name == "at" and not _is_literal(c.arguments) for c in calls_in(body)):
        why = "this catches an index that is out of range, with which the model ends"
        raise reader.unread(node, why, "test the index before")
    inside = reader.branch(body)
    is_generated = _MAILBOX in reader.scope.members
    if is_generated and any(map(_catches_own, handlers)) and _may_end(inside):
        why = "what is caught here ends the body in the model"
        raise reader.unread(node, why, "do what may fail outside of the try")
    if last < 0:
        yield m.Block(inside.statements, (), span)
        return
    ways = [reader.branch(part(h, "body")) for h in handlers]
    unread = Unknown(span, "the model cannot know whether this throws")
    if not inside.statements and not any(w.statements for w in ways):
        return
    if not reader.scope.chooses:
        raise Unread(span, f"{unread.why}, and only a message server can choose")
    reader.findings.approximated(reader.cpp.source, span, unread.why, "", reader.within)
    chosen: m.Statement = ways[-1] if ways else m.Block(())
    for way in reversed(ways[:-1]):
        chosen = m.If(_TRUTH, way, chosen)
    yield m.If(_TRUTH, inside, chosen, (), span)


def _goes_on(handler: Node) -> bool:
    """Whether a handler only logs what it takes, and throws it again ([except.throw])."""
    *logs, last = named(part(handler, "body")) or [handler]
    return last.type == "throw_statement" and not named(last) and all(map(is_logging, logs))


def _logged(reader: CppStatementReader, handler: Node) -> list[m.Statement]:
    """What the model has of the logs of a handler: nothing, or what is listed of them."""
    outside = reader.scope
    for each in named(handler.child_by_field_name("parameters") or handler):
        if (declarator := each.child_by_field_name("declarator")) is not None:
            for name in declared_in(declarator):
                reader.meaning(name, Outside())
    read = list(reader.statements(named(part(handler, "body"))[:-1]))
    reader.scope = outside
    return read


def _is_literal(indices: Sequence[Node]) -> bool:
    return all(i.type == "number_literal" for i in indices)


def _unknown(node: Node) -> bool:
    """Whether it declares something: reading it says whether the model has it."""
    return node.type == "declaration"


def _catches_own(handler: Node) -> bool:
    """Whether a handler may be for what the run-time part throws."""
    parameters = handler.child_by_field_name("parameters")
    return parameters is None or _OTHERS.match(text_of(parameters)) is None


def _may_end(block: m.Block) -> bool:
    """Whether something in it may throw by the run-time part: a time or a rebec that is none.

    What a function of the class does is not looked into.
    """
    for node in m.walk(block):
        match node:
            case m.Call(None, "delay", (time,)):
                if not isinstance(bare(time), m.IntLiteral):
                    return True
            case m.Call(None, "assertion"):
                pass
            case m.Call(None) if not is_calm(node):
                return True
            case m.Call(target) if isinstance(target, m.Paren | m.Cast | m.Index):
                return True
            case _:
                pass
    return False
