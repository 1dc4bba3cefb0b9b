"""Inlay hints: behind a property what `rebsync verify` has found for exactly these texts."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from rebsync.lsp.document import PropertyDocument
from rebsync.roundtrip.verdict.property_cache import cached_verdicts

VERDICTS = "rebsync.verdicts"
_TOOLTIP = "as `rebsync verify` found it, for the model and the properties as they are here"


def verdict_hints(document: PropertyDocument, within: lsp.Range) -> Iterator[lsp.InlayHint]:
    """The cached verdicts of the properties in a range of lines; nothing is searched for them."""
    if document.model is None:
        return
    known = cached_verdicts(document.model.source.text, document.source.text)
    for each in document.parsed.properties.all:
        at = document.position(each.span.end)
        if each.name in known and within.start.line <= at.line <= within.end.line:
            yield lsp.InlayHint(at, known[each.name], padding_left=True, tooltip=_TOOLTIP)
