"""How a document looks: outline, folding, colours, verdicts behind properties, layout."""

from __future__ import annotations

from lsprotocol import types as lsp

from rebsync.grammars.formatting import format_text
from rebsync.lsp.colours import LEGEND, semantic_tokens
from rebsync.lsp.document import Document, ModelDocument
from rebsync.lsp.outline import folding, outline
from rebsync.lsp.session import RebsyncServer, of_document, server
from rebsync.lsp.verdicts import VERDICTS, verdict_hints


@server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
@of_document
def document_symbol(
    ls: RebsyncServer, document: Document, params: lsp.DocumentSymbolParams
) -> list[lsp.DocumentSymbol]:
    """The outline; that of the last text of which something could be read."""
    found = outline(document)
    if found or not document.source.text.strip():
        ls.outlines[document.uri] = found
    return ls.outlines.get(document.uri, [])


@server.feature(lsp.TEXT_DOCUMENT_FOLDING_RANGE)
@of_document
def folding_range(
    ls: RebsyncServer, document: Document, params: lsp.FoldingRangeParams
) -> list[lsp.FoldingRange]:
    return folding(document)


@server.feature(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, LEGEND)
@of_document
def tokens(
    ls: RebsyncServer, document: Document, params: lsp.SemanticTokensParams
) -> lsp.SemanticTokens:
    return semantic_tokens(document)


@server.feature(lsp.TEXT_DOCUMENT_INLAY_HINT)
@of_document
def inlay_hint(
    ls: RebsyncServer, document: Document, params: lsp.InlayHintParams
) -> list[lsp.InlayHint]:
    if isinstance(document, ModelDocument):
        return []
    return list(verdict_hints(document, params.range))


@server.command(VERDICTS)
async def verdicts(ls: RebsyncServer) -> None:
    """Lets the editor ask for verdicts again, when it has run `rebsync verify`."""
    await ls.workspace_inlay_hint_refresh_async(None)


@server.feature(lsp.TEXT_DOCUMENT_FORMATTING)
@of_document
def formatting(
    ls: RebsyncServer, document: Document, params: lsp.DocumentFormattingParams
) -> list[lsp.TextEdit]:
    """The canonical layout of a model without errors of syntax, as `rebsync fmt` has it."""
    if not isinstance(document, ModelDocument) or not document.parts.whole.ok:
        return []
    text = document.source.text
    whole = lsp.Range(lsp.Position(0, 0), document.text_position(len(text)))
    laid_out = format_text(text)
    return [lsp.TextEdit(whole, laid_out)] if laid_out != text else []
