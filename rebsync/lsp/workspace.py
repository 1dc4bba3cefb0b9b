"""The documents of a session by their addresses; read again only when their texts change."""

from __future__ import annotations

from collections.abc import Callable

from pygls.uris import to_fs_path

from rebsync.diagnostics import RebsyncError
from rebsync.files import MODEL, PROPERTY, read_source
from rebsync.lsp.document import (
    Document,
    ModelDocument,
    PropertyDocument,
    Text,
    read_model,
    read_properties,
)
from rebsync.source import Source


class Documents:
    """Documents as they are in the editor, or else on the disk."""

    def __init__(self, open_text: Callable[[str], str | None]) -> None:
        self._open_text = open_text
        self._models: dict[str, ModelDocument] = {}
        self._properties: dict[str, PropertyDocument] = {}

    def document(self, uri: str) -> Document | None:
        """The model or property file of an address."""
        if uri.endswith(PROPERTY):
            return self._property(uri)
        return self._model(uri) if uri.endswith(MODEL) else None

    def related(self, document: Document) -> list[Document]:
        """All documents that name what the document names: the model first, and its properties."""
        is_model = isinstance(document, ModelDocument)
        other = self.document(_with_suffix(document.uri, PROPERTY if is_model else MODEL))
        every = [document, other] if is_model else [other, document]
        return [each for each in every if each is not None]

    def text(self, uri: str) -> Text | None:
        """Any text of an address; None where there is none."""
        path = to_fs_path(uri)
        text = self._open_text(uri)
        if path is None:
            return None
        try:
            return Text(uri, Source(path, text) if text is not None else read_source(path))
        except RebsyncError:
            return None

    def _model(self, uri: str) -> ModelDocument | None:
        text, before = self.text(uri), self._models.get(uri)
        if text is None:
            return None
        if before is None or before.source.text != text.source.text:
            self._models[uri] = read_model(uri, text.source, before)
        return self._models[uri]

    def _property(self, uri: str) -> PropertyDocument | None:
        text, before = self.text(uri), self._properties.get(uri)
        if text is None:
            return None
        model = self._model(_with_suffix(uri, MODEL))
        is_same = before is not None and before.source.text == text.source.text
        if not is_same or before is None or before.model is not model:
            self._properties[uri] = read_properties(uri, text.source, model)
        return self._properties[uri]


def _with_suffix(uri: str, suffix: str) -> str:
    return uri.removesuffix(MODEL).removesuffix(PROPERTY) + suffix
