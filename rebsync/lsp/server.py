"""The loop of the language server: requests of an editor are answered by pure functions."""

from __future__ import annotations

import asyncio
import gc
import sys
from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from typing import Any, Protocol, TypeVar

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, lsp_method
from pygls.uris import to_fs_path

from rebsync import __version__
from rebsync.files import MODEL
from rebsync.grammars.formatting import format_text
from rebsync.lsp.border import CODE, in_code, in_model, model_path, packages_of
from rebsync.lsp.colours import LEGEND, semantic_tokens
from rebsync.lsp.completion import completion
from rebsync.lsp.document import Document, ModelDocument
from rebsync.lsp.drift import (
    SYNC,
    PackageDrift,
    belongs_to,
    drift_of,
    is_saved,
    sync_actions,
    sync_command,
)
from rebsync.lsp.findings import diagnostics, quick_fixes
from rebsync.lsp.generation import with_generated_files
from rebsync.lsp.navigation import definitions, entity_at, hover, references
from rebsync.lsp.outline import folding, outline
from rebsync.lsp.registration import registered_later
from rebsync.lsp.renaming import RenameRefused, renamed
from rebsync.lsp.verdicts import VERDICTS, verdict_hints
from rebsync.lsp.workspace import Documents
from rebsync.roundtrip.package.managed import ManagedPackage

_NEVER = 1_000_000  # collections of younger objects before one of all
DELAY = 0.15  # seconds without a keystroke before diagnostics are sent
REST = 3.0  # seconds without a keystroke after which memory is looked through
LONG_DELAY = 1.0  # the same for those of a text with errors of syntax, read as a whole


class _Protocol(LanguageServerProtocol):
    """Columns count UTF-16 units, which every client knows; code has other servers, too."""

    registrations: list[lsp.Registration]

    @lsp_method(lsp.INITIALIZE)
    def lsp_initialize(
        self, params: lsp.InitializeParams
    ) -> Generator[Any, Any, lsp.InitializeResult]:
        if params.capabilities.general is not None:
            params.capabilities.general.position_encodings = None
        result: lsp.InitializeResult = yield from super().lsp_initialize(params)
        self.registrations = registered_later(result.capabilities, params.capabilities)
        return result


class RebsyncServer(LanguageServer):
    """What a session knows: its documents, and which of them wait for diagnostics."""

    def __init__(self) -> None:
        super().__init__("rebsync", __version__, protocol_cls=_Protocol)
        self.documents = Documents(self.open_text)
        self.waiting: dict[str, asyncio.TimerHandle] = {}
        self.resting: asyncio.TimerHandle | None = None
        self.outlines: dict[str, list[lsp.DocumentSymbol]] = {}
        self.drifts: dict[str, PackageDrift] = {}
        self.packages_by_model: dict[str, list[ManagedPackage]] = {}

    def open_text(self, uri: str) -> str | None:
        """The text of a document that is open in the editor."""
        found = self.workspace.text_documents.get(uri)
        return found.source if found is not None else None

    def publish_soon(self, uri: str, delay: float = DELAY, *, exact: bool = False) -> None:
        """Sends diagnostics of a document, and those of its properties, after a pause."""
        if (waiting := self.waiting.pop(uri, None)) is not None:
            waiting.cancel()
        loop = asyncio.get_running_loop()
        self.waiting[uri] = loop.call_later(delay, lambda: self.publish(uri, exact=exact))
        self.rest_soon()

    def rest_soon(self) -> None:
        """Looks for memory that is free when nothing has been typed for a while."""
        if self.resting is not None:
            self.resting.cancel()
        self.resting = asyncio.get_running_loop().call_later(REST, gc.collect)

    def publish(self, uri: str, *, exact: bool = False) -> None:
        """Sends the diagnostics of a document, and of the properties of a model."""
        self.waiting.pop(uri, None)
        document = self.documents.document(uri)
        if document is None:
            return
        every = self.documents.related(document)
        for each in every if isinstance(document, ModelDocument) else [document]:
            if self.open_text(each.uri) is not None:
                found = diagnostics(each, exact=exact)
                found += [d for d in self.drift_at(each.uri) if d not in found]
                self.text_document_publish_diagnostics(
                    lsp.PublishDiagnosticsParams(each.uri, found)
                )
        if isinstance(document, ModelDocument) and not exact and not document.parts.whole.ok:
            self.publish_soon(uri, LONG_DELAY, exact=True)

    def unsaved(self) -> Iterator[str]:
        """The paths of open texts that are not as on the disk."""
        for uri, document in self.workspace.text_documents.items():
            path = to_fs_path(uri)
            if path is not None and not is_saved(path, document.source):
                yield path

    async def packages(self, model: str) -> list[ManagedPackage]:
        """The packages of a model; looked for once until some file is saved."""
        if model not in self.packages_by_model:
            self.packages_by_model[model] = await asyncio.to_thread(packages_of, model)
        return self.packages_by_model[model]

    def drift_at(self, uri: str) -> list[lsp.Diagnostic]:
        """What is different between models and code at a file."""
        return [d for drift in self.drifts.values() for d in drift.diagnostics.get(uri, ())]

    async def check(self, path: str) -> None:
        """Checks the packages that a file belongs to, and sends what is different."""
        for package in await asyncio.to_thread(packages_of, path):
            drift = await asyncio.to_thread(drift_of, package)
            before = self.drifts.get(drift.root)
            self.drifts[drift.root] = drift
            for uri in {**(before.diagnostics if before is not None else {}), **drift.diagnostics}:
                if self.documents.document(uri) is not None:
                    self.publish_soon(uri)
                else:
                    told = lsp.PublishDiagnosticsParams(uri, self.drift_at(uri))
                    self.text_document_publish_diagnostics(told)


server = RebsyncServer()


def serve() -> None:
    """Answers until the editor says that it ends.

    To look through all memory takes as long as to answer: it is done while nobody types.
    """
    gc.enable()
    gc.freeze()
    young, middle, _ = gc.get_threshold()
    gc.set_threshold(young, middle, _NEVER)
    server.start_io()


@server.feature(lsp.INITIALIZED)
def initialized(ls: RebsyncServer, params: lsp.InitializedParams) -> None:
    assert isinstance(ls.protocol, _Protocol)
    if ls.protocol.registrations:
        ls.client_register_capability(lsp.RegistrationParams(ls.protocol.registrations))


# --- texts ---------------------------------------------------------------------------------------


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


class _OfDocument(Protocol):
    """The parameters of a request about a document."""

    @property
    def text_document(self) -> lsp.TextDocumentIdentifier: ...


Params = TypeVar("Params", bound=_OfDocument)
Answer = TypeVar("Answer")


def of_document(
    answer: Callable[[RebsyncServer, Document, Params], Answer],
) -> Callable[[RebsyncServer, Params], Answer | None]:
    """Answers for models and property files only: editors may ask about code as well."""

    def handler(ls: RebsyncServer, params: Params) -> Answer | None:
        document = ls.documents.document(params.text_document.uri)
        return answer(ls, document, params) if document is not None else None

    return handler


# --- questions -----------------------------------------------------------------------------------


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
    if document is None:
        return []
    found = entity_at(document, params.position)
    return definitions(ls.documents.related(document), found.entity) if found is not None else []


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


@server.feature(
    lsp.TEXT_DOCUMENT_CODE_ACTION,
    lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix, lsp.CodeActionKind.SourceFixAll]),
)
def code_action(ls: RebsyncServer, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    uri = params.text_document.uri
    document = ls.documents.document(uri)
    fixes = quick_fixes(document, params.range) if document is not None else ()
    drifts = (sync_actions(drift, uri, params.range) for drift in ls.drifts.values())
    return [*fixes, *(action for actions in drifts for action in actions)]


@server.command(SYNC)
async def sync(ls: RebsyncServer, root: str, favour: str) -> None:
    """Runs `rebsync sync` on a package whose open texts are saved, and says what it says."""
    if unsaved := [path for path in ls.unsaved() if belongs_to(path, root)]:
        message = f"save {', '.join(sorted(unsaved))} first"
        ls.window_show_message(lsp.ShowMessageParams(lsp.MessageType.Warning, message))
        return
    done = await asyncio.create_subprocess_exec(
        *(sys.executable, "-m", "rebsync", *sync_command(root, favour)),
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.STDOUT,
    )
    said, _ = await done.communicate()
    kind = lsp.MessageType.Info if done.returncode == 0 else lsp.MessageType.Warning
    ls.window_show_message(lsp.ShowMessageParams(kind, said.decode(errors="replace").strip()))
    await ls.check(root)
