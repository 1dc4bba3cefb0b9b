"""What the language server knows of its session: documents, diagnostics and drift."""

from __future__ import annotations

import asyncio
import gc
from collections.abc import Callable, Generator, Iterator
from typing import Any, Protocol, TypeVar

from lsprotocol import types as lsp
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, lsp_method
from pygls.uris import to_fs_path

from rebsync import __version__
from rebsync.lsp.border import packages_of
from rebsync.lsp.document import Document, ModelDocument
from rebsync.lsp.drift import PackageDrift, drift_of, is_saved
from rebsync.lsp.findings import diagnostics
from rebsync.lsp.registration import registered_later
from rebsync.lsp.workspace import Documents
from rebsync.roundtrip.package.managed import ManagedPackage

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

    @property
    def registrations(self) -> list[lsp.Registration]:
        """What the server answers to for some kinds of files only."""
        assert isinstance(self.protocol, _Protocol)
        return self.protocol.registrations

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
