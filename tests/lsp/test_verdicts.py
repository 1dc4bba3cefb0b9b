"""Verdicts stand behind the properties of exactly those texts that `rebsync verify` has seen."""

from __future__ import annotations

from pathlib import Path

from lsprotocol import types as lsp

from tests.cli.run import rebsync
from tests.lsp.client import Editor, at
from tests.lsp.conftest import InEditor
from tests.lsp.test_server import MODEL, PROPERTY

BOTH = PROPERTY.replace(
    "  }\n}", "    Never: !counter.full;\n  }\n  LTL {\n    Ends: F(over);\n  }\n}"
)


async def _hints(client: Editor, uri: str) -> dict[int, object]:
    everywhere = lsp.Range(lsp.Position(0, 0), lsp.Position(99, 0))
    params = lsp.InlayHintParams(lsp.TextDocumentIdentifier(uri), everywhere)
    found = await client.text_document_inlay_hint_async(params)
    return {hint.position.line: hint.label for hint in found or ()}


def test_verdicts_are_those_of_the_texts(tmp_path: Path, in_editor: InEditor) -> None:
    model, properties = tmp_path / "counter.rebeca", tmp_path / "counter.property"
    model.write_text(f"{MODEL}// {tmp_path}\n", encoding="utf-8")  # no other run has verified it
    properties.write_text(BOTH, encoding="utf-8")
    fills, never, ends = (at(BOTH, name).line for name in ("Fills", "Never", "Ends"))

    async def play(client: Editor) -> None:
        open_model, uri = client.open(model), client.open(properties)
        rebsync("verify", str(model), "--fairness", "weak", cwd=tmp_path)
        rebsync("verify", str(model), "--max-states", "1", cwd=tmp_path)
        assert await _hints(client, uri) == {}
        rebsync("verify", str(model), "--property-name", "Never", cwd=tmp_path)
        assert await _hints(client, uri) == {never: "violated"}
        rebsync("verify", str(model), cwd=tmp_path)
        every = {fills: "satisfied", never: "violated", ends: "satisfied"}
        assert await _hints(client, uri) == every
        limit = lsp.Range(at(MODEL, "3;"), at(MODEL, "3;", 1))
        client.type(open_model, limit, "4")
        assert await _hints(client, uri) == {}
        client.type(open_model, limit, "3")
        assert await _hints(client, uri) == every
        start = lsp.Position(0, 0)
        client.type(uri, lsp.Range(start, start), "\n")
        assert await _hints(client, uri) == {}

    in_editor(play)
