"""Sends of generated Python to overloads, which the model tells apart by types."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial

from tree_sitter import Node

from rebsync import model as m
from rebsync.names import uncarry
from rebsync.reserved import RUNTIME_TOPICS
from rebsync.reverse.bodies.overloads import HINT, WHY, Served, plain, telling
from rebsync.reverse.bodies.scope import Called, Variable
from rebsync.reverse.bodies.scope import Scope as Meanings
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.py_types import class_name, type_of
from rebsync.reverse.python.generated.roles import PyRoles, PySends
from rebsync.reverse.syntax.py_index import Scope
from rebsync.static.types import is_floating, is_integer


def families(lines: Iterable[tuple[Scope, Iterable[PyRoles]]]) -> dict[str, dict[str, str]]:
    """By class the servers by the types of their messages; with each those above, nearest first."""
    return {
        class_name(owner.name): {
            t: s for roles in [*above][::-1] for t, s in roles.messages.items()
        }
        for owner, above in lines
    }


def resolved(served: Served, owner: Scope, sends: PySends, function: Scope) -> PySends:
    """A send by the name that the server has in the model, which its message type tells.

    With the types of what it takes, and those that other servers of the name take.
    """
    given = function.parameter_nodes[1:]
    said = plain([type_of(p.child_by_field_name("type")) for p in given])
    types = said[sends.known is None :][: sends.arguments]
    message, _, key = sends.server.partition(" ")
    if not key:
        rivals = served.rivals_in(class_name(owner.name), message, types)
        return replace(sends, types=types, rivals=rivals)
    server = served.servers.get(message) or uncarry(key, RUNTIME_TOPICS)
    return replace(sends, server=server, types=types, rivals=served.rivals(message, types))


def told(
    reader: ModelExpressionReader, node: Node, sends: PySends, values: tuple[m.Expression, ...]
) -> tuple[m.Expression, ...]:
    """What is sent, by which the model chooses this server. Unread: the types are not known."""
    if not sends.rivals:
        return values
    known = {**reader.names.types, **reader.types}
    results = {n: Called(n, returns=t) for n, t in reader.names.results.items()}
    scope = Meanings({n: Variable(n, t) for n, t in known.items()}, results, {})
    kind = partial(type_in, scope)
    pairs = ((kind(v), t) for v, t in zip(values, sends.types, strict=True))
    cut = any(of and t and is_floating(of) and is_integer(t) for of, t in pairs)
    found = None if cut else telling(values, sends.types, sends.rivals, kind)
    if found is None:
        raise Unread(reader.py.span(node), WHY, HINT)
    return found
