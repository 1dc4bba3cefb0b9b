"""Locals of C++ without an initial value: any may be in them, where a model has zero."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rebsync import model as m
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.models.rewriting import rewritten
from rebsync.reverse.nodes.node_unset import read_unset
from rebsync.source import SourceSpan
from rebsync.statements import UNREADABLE
from rebsync.static.types import BOOLEAN

_WHY = '"{}" has no value that is known when it is first read'
_EITHER = m.Choice((m.BoolLiteral(False), m.BoolLiteral(True)))


def with_set_locals(
    body: m.Block, methods: Sequence[m.Method], findings: Findings, within: str
) -> m.Block:
    """The body with a choice for each truth value that may be read before it is set.

    Another local that may be is listed, and makes the body unreadable.
    """
    declarations = [n.declaration for n in m.walk(body) if isinstance(n, m.Local)]
    types = {d.name: each.type for each in declarations for d in each.declarators if not d.initial}
    server = m.MessageServer("", (), body)
    unset = set(read_unset(types, m.Block(()), [server], methods))
    if not unset:
        return body
    lacking: list[m.Statement] = []
    for declaration in declarations:
        for declarator in declaration.declarators:
            span = declarator.span
            if declarator.name not in unset or not isinstance(span, SourceSpan):
                continue
            why = _WHY.format(declarator.name)
            if declaration.type == BOOLEAN:
                findings.approximated(span.source, span, why, "give it an initial value", within)
            else:
                unread = Unread(span, why, "give it an initial value")
                findings.unreadable(span.source, unread, within)
                lacking = [m.Empty((m.Annotation(UNREADABLE),))]

    def chosen(part: object) -> object:
        match part:
            case m.Declaration(type, declarators) if type == BOOLEAN:
                given = (replace(d, initial=_EITHER) if d.name in unset else d for d in declarators)
                return replace(part, declarators=tuple(given))
            case _:
                return part

    changed = rewritten(body, chosen)
    return replace(changed, statements=(*lacking, *changed.statements))
