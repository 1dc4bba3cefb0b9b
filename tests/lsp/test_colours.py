"""Semantic tokens: a real client gets what each name is, as the text is at that moment."""

from __future__ import annotations

from pathlib import Path

from lsprotocol import types as lsp

from tests.lsp.client import Editor, at
from tests.lsp.conftest import InEditor
from tests.lsp.test_server import MODEL, PROPERTY

LEGEND = ("class", "variable", "property", "method", "function", "parameter", "decorator")


async def _tokens(client: Editor, uri: str, text: str) -> list[tuple[str, str, int]]:
    """The names with their types and modifiers, as an editor decodes them."""
    document = lsp.TextDocumentIdentifier(uri)
    found = await client.text_document_semantic_tokens_full_async(
        lsp.SemanticTokensParams(document)
    )
    assert found is not None
    lines = text.split("\n")
    named, line, column = [], 0, 0
    for i in range(0, len(found.data), 5):
        down, right, length, kind, modifiers = found.data[i : i + 5]
        line, column = line + down, right + (0 if down else column)
        units = lines[line].encode("utf-16-le")[2 * column : 2 * (column + length)]
        named.append((units.decode("utf-16-le"), LEGEND[kind], modifiers))
    return named


def test_names_have_the_colours_of_what_they_are(tmp_path: Path, in_editor: InEditor) -> None:
    model, properties = tmp_path / "counter.rebeca", tmp_path / "counter.property"
    model.write_text(MODEL, encoding="utf-8")
    properties.write_text(PROPERTY, encoding="utf-8")

    async def play(client: Editor) -> None:
        uri = client.open(model)
        assert await _tokens(client, uri, MODEL) == [
            ("limit", "variable", 3),
            ("@Robot", "decorator", 0),
            ("Counter", "class", 1),
            ("count", "property", 1),
            ("full", "property", 1),
            ("Counter", "class", 0),
            ("count", "property", 0),
            ("full", "property", 0),
            ("step", "method", 0),
            ("step", "method", 1),
            ("by", "parameter", 1),
            ("count", "property", 0),
            ("count", "property", 0),
            ("by", "parameter", 0),
            ("count", "property", 0),
            ("limit", "variable", 2),
            ("full", "property", 0),
            ("step", "method", 0),
            ("by", "parameter", 0),
            ("Counter", "class", 0),
            ("counter", "variable", 1),
        ]
        place, start = at(MODEL, "count + by"), lsp.Position(0, 0)
        client.type(uri, lsp.Range(place, place), "{")
        typed = MODEL.replace("count + by", "{count + by")
        found = await _tokens(client, uri, typed)
        assert found[:2] == [("limit", "variable", 3), ("@Robot", "decorator", 0)]
        client.type(uri, lsp.Range(start, start), "// @one\n/* @two */ ")
        assert await _tokens(client, uri, f"// @one\n/* @two */ {typed}") == found
        assert await _tokens(client, client.open(properties), PROPERTY) == [
            ("over", "variable", 3),
            ("counter", "variable", 0),
            ("count", "property", 0),
            ("limit", "variable", 2),
            ("Fills", "function", 1),
            ("over", "variable", 2),
            ("counter", "variable", 0),
            ("full", "property", 0),
        ]

    in_editor(play)
