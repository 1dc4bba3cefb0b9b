"""A real client: pygls' own, which starts `rebsync lsp` and speaks to it over its streams."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from lsprotocol import types as lsp
from pygls.lsp.client import LanguageClient

from tests.cli.run import environment


class Editor(LanguageClient):
    """An editor with open texts, which remembers the diagnostics that it was sent."""

    def __init__(self) -> None:
        super().__init__("tests", "1")
        self.sent: asyncio.Queue[lsp.PublishDiagnosticsParams] = asyncio.Queue()
        self.messages: list[str] = []
        self.registered: dict[str, lsp.Registration] = {}
        self.versions: dict[str, int] = {}

        self.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)(lambda sent: self.sent.put_nowait(sent))
        self.feature(lsp.WINDOW_SHOW_MESSAGE)(lambda shown: self.messages.append(shown.message))

        @self.feature(lsp.CLIENT_REGISTER_CAPABILITY)  # type: ignore[untyped-decorator]
        def register(params: lsp.RegistrationParams) -> None:
            self.registered |= {each.method: each for each in params.registrations}

    @property
    def process_id(self) -> int:
        """The server's process."""
        assert self._server is not None
        return self._server.pid

    def open(self, path: Path, text: str | None = None) -> str:
        """Opens a file, with another text if it is not as on the disk; gives its address."""
        uri = path.as_uri()
        shown = text if text is not None else path.read_text(encoding="utf-8")
        document = lsp.TextDocumentItem(uri, "rebeca", 1, shown)
        self.versions[uri] = 1
        self.text_document_did_open(lsp.DidOpenTextDocumentParams(document))
        return uri

    def type(self, uri: str, place: lsp.Range, text: str) -> None:
        """Replaces a range of an open text."""
        self.versions[uri] += 1
        version = lsp.VersionedTextDocumentIdentifier(self.versions[uri], uri)
        change = lsp.TextDocumentContentChangePartial(place, text)
        self.text_document_did_change(lsp.DidChangeTextDocumentParams(version, [change]))

    async def diagnostics(self, uri: str) -> list[lsp.Diagnostic]:
        """The next diagnostics of a document."""
        while True:
            found = await asyncio.wait_for(self.sent.get(), 20)
            if found.uri == uri:
                return list(found.diagnostics)


@asynccontextmanager
async def editor(folder: Path) -> AsyncIterator[Editor]:
    """An editor whose server runs while it is in use."""
    client = Editor()
    await client.start_io(sys.executable, "-m", "rebsync", "lsp", env=environment(), cwd=folder)
    offered = [lsp.PositionEncodingKind.Utf8, lsp.PositionEncodingKind.Utf16]
    general = lsp.GeneralClientCapabilities(position_encodings=offered)
    formatting = lsp.DocumentFormattingClientCapabilities(dynamic_registration=True)
    documents = lsp.TextDocumentClientCapabilities(formatting=formatting)
    capabilities = lsp.ClientCapabilities(general=general, text_document=documents)
    await client.initialize_async(lsp.InitializeParams(capabilities, root_uri=folder.as_uri()))
    client.initialized(lsp.InitializedParams())
    try:
        yield client
    finally:
        await asyncio.wait_for(client.shutdown_async(None), 20)
        client.exit(None)
        await client.stop()  # type: ignore[no-untyped-call]


def at(text: str, marked: str, offset: int = 0) -> lsp.Position:
    """The place where something is first written in a text, and some characters further."""
    before = text[: text.index(marked) + offset]
    column = len(before[before.rfind("\n") + 1 :].encode("utf-16-le")) // 2
    return lsp.Position(before.count("\n"), column)
