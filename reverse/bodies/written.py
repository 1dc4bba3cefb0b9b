"""Pieces of the model that stand as text in markers."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from rebsync.diagnostics import RebsyncError
from rebsync.grammars.parser import parse_model
from rebsync.model import Annotation, ReactiveClass
from rebsync.source import Source, Span


def annotation(marker: str, span: Span) -> Annotation | None:
    """The annotation of a marker `annotation @name(arguments)`; None for another marker."""
    kind, _, text = marker.partition(" ")
    if kind != "annotation":
        return None
    found = _parsed(_without_rest(text))
    return replace(found, span=span) if found is not None else None


@cache
def _parsed(text: str) -> Annotation | None:
    """The annotation that a text is; kept, as packages have few and parsing takes a while."""
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
