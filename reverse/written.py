"""Pieces of the model that stand as text in markers."""

from __future__ import annotations

from dataclasses import replace

from rebsync.diagnostics import RebsyncError
from rebsync.grammars.parser import parse_model
from rebsync.model import Annotation, ReactiveClass
from rebsync.source import Source, Span


def annotation(marker: str, span: Span) -> Annotation | None:
    """The annotation of a marker `annotation @name(arguments)`; None for another marker."""
    kind, _, text = marker.partition(" ")
    if kind != "annotation":
        return None
    source = Source("marker", f"{text} reactiveclass A(1) {{}}")
    try:
        classes = parse_model(source).model.classes
    except RebsyncError:
        return None
    found = [a for c in classes if isinstance(c, ReactiveClass) for a in c.annotations]
    return replace(found[0], span=span) if len(found) == 1 else None
