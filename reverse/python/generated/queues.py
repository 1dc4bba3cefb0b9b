"""How long the queue of a class of generated Python is: what its mailbox is told."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.python.generated.named_constants import CodeConstants, NamedConstants
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, text_of

PASSED = "queue_length"  # what a class hands on that others extend
_NAMES = frozenset({PASSED, "capacity"})
_NODES = frozenset({"self", "node"})


def queue_in(arguments: list[Node]) -> Node | None:
    """The argument that says how long the queue is, of a mailbox or of what makes one."""
    for argument in arguments:
        if argument.type == "keyword_argument" and text_of(field(argument, "name")) in _NAMES:
            return field(argument, "value")
    given = arguments[1:] if arguments and text_of(arguments[0]) in _NODES else arguments
    return given[0] if given and given[0].type != "keyword_argument" else None


def length_of(
    code: CodeConstants,
    owner: Scope,
    queues: list[Node],
    default: Node | None,
    findings: Findings,
) -> int:
    """The length that the last of some arguments gives, or else a default.

    What is no number, nor a constant, is listed.
    """
    told = [queue for queue in queues if text_of(queue) != PASSED]
    if not told and default is None:
        return 1
    given = told[-1] if told else default
    assert given is not None
    text = text_of(given)
    if text.isdecimal():
        return int(text)
    known = NamedConstants(code, owner.module).get(text)
    if isinstance(known, m.IntLiteral):
        return known.value
    unread = Unread(owner.py.span(given), "this is no number of messages that is known here")
    findings.unreadable(owner.py.source, unread, owner.name)
    return 1
