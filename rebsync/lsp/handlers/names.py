"""What a name is: hover, places, renaming, and the names that may stand at a place."""

from __future__ import annotations

from pathlib import Path

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from rebsync.lsp.border import CODE, in_code, in_model, model_path, packages_of
from rebsync.lsp.completion import completion
from rebsync.lsp.document import Document, ModelDocument
from rebsync.lsp.generation import with_generated_files
from rebsync.lsp.navigation import definitions, entity_at, hover, references
from rebsync.lsp.renaming import RenameRefused, renamed
from rebsync.lsp.session import RebsyncServer, of_document, server


@server.feature(lsp.TEXT_DOCUMENT_HOVER)
async def text_hover(ls: RebsyncServer, params: lsp.HoverParams) -> lsp.Hover | None:
    document = ls.documents.document(params.text_document.uri)
    if document is None:
        return None
    shown, found = hover(document, params.position), entity_at(document, params.position)
    model = ls.documents.related(document)[0]
    if shown is None or found is None or not isinstance(model, ModelDocument):
        return shown
    packages = await ls.packages(model.source.path)
    return with_generated_files(shown, model, found.entity, packages)


@server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
def definition(ls: RebsyncServer, params: lsp.DefinitionParams) -> list[lsp.Location]:
    if params.text_document.uri.endswith(CODE):
        return _in_model(ls, params)
    document = ls.documents.document(params.text_document.uri)
    found = entity_at(document, params.position) if document is not None else None
    if document is None or found is None:
        return []
    return definitions(ls.documents.related(document), found.entity)


@server.feature(lsp.TEXT_DOCUMENT_IMPLEMENTATION)
def implementation(ls: RebsyncServer, params: lsp.ImplementationParams) -> list[lsp.Location]:
    """The code that was generated from an element; of code the element."""
    if params.text_document.uri.endswith(CODE):
        return _in_model(ls, params)
    document = ls.documents.document(params.text_document.uri)
    if document is None:
        return []
    found, model = entity_at(document, params.position), ls.documents.related(document)[0]
    if found is None or not isinstance(model, ModelDocument):
        return []
    return in_code(model, found.entity, packages_of(model.source.path))


def _in_model(
    ls: RebsyncServer, params: lsp.DefinitionParams | lsp.ImplementationParams
) -> list[lsp.Location]:
    text = ls.documents.text(params.text_document.uri)
    if text is None:
        return []
    models = (model_path(package) for package in packages_of(text.source.path))
    documents = (ls.documents.document(Path(m).absolute().as_uri()) for m in models if m)
    every = (in_model(text, params.position, d) for d in documents if isinstance(d, ModelDocument))
    return [place for places in every for place in places]


@server.feature(lsp.TEXT_DOCUMENT_REFERENCES)
@of_document
def text_references(
    ls: RebsyncServer, document: Document, params: lsp.ReferenceParams
) -> list[lsp.Location]:
    found = entity_at(document, params.position)
    if found is None:
        return []
    declared = params.context.include_declaration
    return references(ls.documents.related(document), found.entity, declared)


@server.feature(lsp.TEXT_DOCUMENT_PREPARE_RENAME)
@of_document
def prepare_rename(
    ls: RebsyncServer, document: Document, params: lsp.PrepareRenameParams
) -> lsp.Range | None:
    found = entity_at(document, params.position)
    return document.range(found.span) if found is not None else None


@server.feature(lsp.TEXT_DOCUMENT_RENAME, lsp.RenameOptions(prepare_provider=True))
@of_document
def rename(
    ls: RebsyncServer, document: Document, params: lsp.RenameParams
) -> lsp.WorkspaceEdit | None:
    found = entity_at(document, params.position)
    if found is None:
        return None
    try:
        return renamed(ls.documents.related(document), found.entity, params.new_name)
    except RenameRefused as refused:
        raise JsonRpcInvalidParams(str(refused)) from None


@server.feature(lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=[".", "@"]))
@of_document
def text_completion(
    ls: RebsyncServer, document: Document, params: lsp.CompletionParams
) -> list[lsp.CompletionItem]:
    return completion(document, params.position)
