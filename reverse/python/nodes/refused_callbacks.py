"""Callbacks of Python that a client library never runs, or whose results it refuses.

Of a library with flat names a service whose callback gives no response of its type ends the
program; else the caller alone gets to know. A coroutine runs only where an executor awaits it.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import Fact, ServiceFact
from rebsync.reverse.libraries.routines import Library
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import arguments_of
from rebsync.reverse.syntax.py_tree import SCOPES, field, text_of

_COROUTINE = "this client library never runs the coroutine that the callback gives"
_NO_ANSWER = "the client library raises an exception where a service gives no response"


def odd_callback(fact: Fact, server: Server, library: Library) -> tuple[Node, str] | None:
    """What of a callback the client library refuses, or never runs."""
    function = server.body if server.body.type in SCOPES else server.body.parent
    if function is None or function.type not in ("function_definition", "lambda"):
        return None
    if any(c.type == "async" for c in function.children) and not library.flat:
        return function, _COROUTINE
    if not isinstance(fact, ServiceFact) or not library.flat:
        return None
    body, answers = field(function, "body"), _Answers(_called(fact), function)
    if function.type == "lambda":
        return (body, _NO_ANSWER) if not answers.may_be(body) else None
    if not _returns(body):
        return function, _NO_ANSWER
    returned = (n for n in nodes_in(body, *SCOPES) if n.type == "return_statement")
    return next(((n, _NO_ANSWER) for n in returned if not answers.may_give(n)), None)


@dataclass(frozen=True, slots=True)
class _Answers:
    """What is a response of a service in a function, by what its type is called there."""

    types: frozenset[str]
    function: Node

    def may_give(self, returned: Node) -> bool:
        """Whether a statement returns a response."""
        values = [n for n in returned.named_children if n.type != "comment"]
        return len(values) == 1 and self.may_be(values[0])

    def may_be(self, value: Node, seen: frozenset[str] = frozenset()) -> bool:
        """Whether an expression is a response: a new one, the one that is given, or a copy."""
        match value.type:
            case "call":
                made = text_of(field(value, "function")).rpartition(".")
                return made[2] == "Response" and made[0] in self.types
            case "conditional_expression":
                condition = value.named_children[1]
                parts = (n for n in value.named_children if n != condition)
                return all(self.may_be(n, seen) for n in parts)
            case "identifier" if (name := text_of(value)) not in seen:
                stored = list(self._stored(name))
                is_known = name in self._given or bool(stored)
                return is_known and all(self.may_be(n, seen | {name}) for n in stored)
            case _:
                return False

    @property
    def _given(self) -> list[str]:
        """The name of the last parameter, which is the response."""
        parameters = field(self.function, "parameters").named_children
        names = [next((c for c in nodes_in(p) if c.type == "identifier"), p) for p in parameters]
        return [text_of(n) for n in names[-1:]]

    def _stored(self, name: str) -> Iterator[Node]:
        for node in nodes_in(field(self.function, "body"), *SCOPES):
            if node.type == "assignment" and text_of(field(node, "left")) == name:
                yield field(node, "right")


def _called(service: ServiceFact) -> frozenset[str]:
    """What the type of a service may be called: as where it is offered, or as it is."""
    plain, keywords = arguments_of(service.site.call)
    plain_name = str(service.type).replace("/", ".").rpartition(".")[2]
    return frozenset({plain_name, *(text_of(a) for a in (*plain[:1], *keywords.values()))})


def _returns(node: Node) -> bool:
    """Whether a statement, or the last one of a block, always returns, or ends by an exception."""
    parts = [n for n in node.named_children if n.type != "comment"]
    match node.type:
        case "return_statement" | "raise_statement":
            return True
        case "block":
            return any(map(_returns, parts))
        case "with_statement" | "else_clause" | "elif_clause" | "except_clause":
            return _returns(parts[-1])
        case "if_statement":
            blocks = [n for n in parts if n.type in ("block", "elif_clause", "else_clause")]
            return parts[-1].type == "else_clause" and all(map(_returns, blocks))
        case "try_statement":
            if parts[-1].type == "finally_clause" and _returns(parts[-1].named_children[-1]):
                return True
            after = any(n.type == "else_clause" and _returns(n) for n in parts)
            caught = all(_returns(n) for n in parts if n.type == "except_clause")
            return caught and (after or _returns(parts[0]))
        case _:
            return False
