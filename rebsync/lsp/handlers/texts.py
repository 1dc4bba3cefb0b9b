"""Texts that an editor opens, changes, saves and closes."""

from __future__ import annotations

from lsprotocol import types as lsp
from pygls.uris import to_fs_path

from rebsync.files import MODEL
from rebsync.lsp.border import CODE
from rebsync.lsp.session import RebsyncServer, server


@server.feature(lsp.INITIALIZED)
def initialized(ls: RebsyncServer, params: lsp.InitializedParams) -> None:
    if ls.registrations:
        ls.client_register_capability(lsp.RegistrationParams(ls.registrations))


@server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
def did_open(ls: RebsyncServer, params: lsp.DidOpenTextDocumentParams) -> None:
    ls.publish(params.text_document.uri)


@server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
def did_change(ls: RebsyncServer, params: lsp.DidChangeTextDocumentParams) -> None:
    ls.publish_soon(params.text_document.uri)


@server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
async def did_save(ls: RebsyncServer, params: lsp.DidSaveTextDocumentParams) -> None:
    ls.packages_by_model.clear()
    path = to_fs_path(params.text_document.uri)
    if path is not None and path.endswith((*CODE, MODEL)):
        await ls.check(path)


@server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
def did_close(ls: RebsyncServer, params: lsp.DidCloseTextDocumentParams) -> None:
    uri = params.text_document.uri
    told = lsp.PublishDiagnosticsParams(uri, ls.drift_at(uri))
    ls.text_document_publish_diagnostics(told)
