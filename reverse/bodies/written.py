"""Pieces of the model that stand as text in markers."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from functools import cache

from rebsync.diagnostics import RebsyncError
from rebsync.model import Annotation, IntLiteral, ReactiveClass
from rebsync.source import NOWHERE, Source, Span

_PLAIN = re.compile(r"@([A-Za-z]\w*)(?:\((\d+)\))?\Z", re.ASCII)


def annotations_in(markers: Iterable[str], span: Span) -> tuple[Annotation, ...]:
    """The annotations among markers."""
    found = (annotation(text, span) for text in markers)
    return tuple(a for a in found if a is not None)


def annotation(marker: str, span: Span) -> Annotation | None:
    """The annotation of a marker `annotation @name(arguments)`; None for another marker."""
    kind, _, text = marker.partition(" ")
    if kind != "annotation":
        return None
    found = _parsed(_without_rest(text))
    return replace(found, span=span) if found is not None else None


@cache
def _parsed(text: str) -> Annotation | None:
    """The annotation that a text is; kept, as packages have few and parsing takes a while.

    For the plain ones the parser is not even loaded.
    """
    if (plain := _PLAIN.match(text)) is not None:
        number = plain[2]
        arguments = (IntLiteral(int(number), Span(*plain.span(2))),) if number else None
        return Annotation(plain[1], arguments, NOWHERE)
    from rebsync.grammars.parser import parse_model

    source = Source("marker", f"{text} reactiveclass A(1) {{}}")
    try:
        classes = parse_model(source).model.classes
    except RebsyncError:
        return None
    found = [a for c in classes if isinstance(c, ReactiveClass) for a in c.annotations]
    return found[0] if len(found) == 1 else None


def _without_rest(text: str) -> str:
    """`@name(...)` without what follows it in a comment that goes on."""
    name, opening, _ = text.partition("(")
    if " " in name.strip() or not opening:
        return name.split()[0] if name.split() else ""
    depth = 0
    for index, character in enumerate(text):
        depth += (character == "(") - (character == ")")
        if character == ")" and depth == 0:
            return text[: index + 1]
    return text
