"""Renaming an element in a model and its properties, unless a name would then mean another."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lsprotocol import types as lsp

from rebsync.diagnostics import Edit, Severity
from rebsync.edits import apply_edits
from rebsync.lsp.document import Document, ModelDocument, read_model, read_properties
from rebsync.lsp.occurrences import Entity
from rebsync.source import Source, Span

_NAME = re.compile(r"[^\W\d][\w$]*|\$[\w$]*")


class RenameRefused(Exception):
    """Says why an element cannot have a name."""


def renamed(documents: Sequence[Document], entity: Entity, name: str) -> lsp.WorkspaceEdit:
    """The edits; the model comes first among the documents. RenameRefused: they would break it."""
    if _NAME.fullmatch(name) is None:
        raise RenameRefused(f'"{name}" is no name')
    if not all(_is_readable(document) for document in documents):
        raise RenameRefused("not all of the text can be read: correct its errors first")
    edits = {document.uri: _edits(document, entity, name) for document in documents}
    after = _edited(documents, edits)
    if _errors(after) > _errors(documents) or _bindings(after) != _bindings(documents):
        raise RenameRefused(f'"{name}" means something else here already, or is no name')
    changes = {
        document.uri: [
            lsp.TextEdit(document.text_range(edit.span), edit.text) for edit in edits[document.uri]
        ]
        for document in documents
        if edits[document.uri]
    }
    return lsp.WorkspaceEdit(changes=changes)


def _is_readable(document: Document) -> bool:
    return document.parts.whole.ok if isinstance(document, ModelDocument) else document.parsed.ok


def _edits(document: Document, entity: Entity, name: str) -> list[Edit]:
    to_text = document.layout.to_text
    spans = {each.span for each in document.occurrences if each.entity == entity}
    return [Edit(Span(to_text(s.start), to_text(s.end)), name) for s in spans]


def _edited(documents: Sequence[Document], edits: dict[str, list[Edit]]) -> list[Document]:
    after: list[Document] = []
    for document in documents:
        text = apply_edits(document.source.text, edits[document.uri])
        source = Source(document.source.path, text)
        if isinstance(document, ModelDocument):
            after.append(read_model(document.uri, source, document))
        else:
            model = next((d for d in after if isinstance(d, ModelDocument)), document.model)
            after.append(read_properties(document.uri, source, model))
    return after


def _errors(documents: Sequence[Document]) -> int:
    found = (each for document in documents for each in document.findings)
    return sum(each.severity is Severity.ERROR for each in found)


def _bindings(documents: Sequence[Document]) -> list[int]:
    """For each name in the texts the number of its first occurrence: which names are one."""
    first: dict[Entity, int] = {}
    every = [
        each.entity
        for document in documents
        for each in sorted(document.occurrences, key=lambda o: o.span.start)
    ]
    return [first.setdefault(entity, number) for number, entity in enumerate(every)]
