"""What an editor is to ask about models and property files only, and not about other code."""

from __future__ import annotations

from lsprotocol import types as lsp

from rebsync.files import MODEL, PROPERTY
from rebsync.lsp.colours import LEGEND

SELECTOR = [{"pattern": f"**/*{suffix}"} for suffix in (MODEL, PROPERTY)]
_TOKENS = "textDocument/semanticTokens"
# By method: the capability of the server, and that of the client.
_FEATURES = {
    lsp.TEXT_DOCUMENT_COMPLETION: ("completion_provider", "completion"),
    lsp.TEXT_DOCUMENT_HOVER: ("hover_provider", "hover"),
    lsp.TEXT_DOCUMENT_REFERENCES: ("references_provider", "references"),
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: ("document_symbol_provider", "document_symbol"),
    lsp.TEXT_DOCUMENT_FORMATTING: ("document_formatting_provider", "formatting"),
    lsp.TEXT_DOCUMENT_FOLDING_RANGE: ("folding_range_provider", "folding_range"),
    lsp.TEXT_DOCUMENT_RENAME: ("rename_provider", "rename"),
    lsp.TEXT_DOCUMENT_INLAY_HINT: ("inlay_hint_provider", "inlay_hint"),
    _TOKENS: ("semantic_tokens_provider", "semantic_tokens"),
}

_OPTIONS: dict[str, dict[str, object]] = {
    lsp.TEXT_DOCUMENT_COMPLETION: {"triggerCharacters": [".", "@"]},
    lsp.TEXT_DOCUMENT_RENAME: {"prepareProvider": True},
    _TOKENS: {"legend": LEGEND, "full": True},
}


def registered_later(
    server: lsp.ServerCapabilities, client: lsp.ClientCapabilities
) -> list[lsp.Registration]:
    """Takes from the server's capabilities those that the editor lets it register by kind of file.

    Without this an editor would offer rebsync as the formatter of C++.
    """
    found = []
    for method, (provider, capability) in _FEATURES.items():
        known = getattr(client.text_document, capability, None)
        if not getattr(known, "dynamic_registration", False):
            continue
        options = {"documentSelector": SELECTOR, **_OPTIONS.get(method, {})}
        found.append(lsp.Registration(method, method, options))
        setattr(server, provider, None)
    return found
