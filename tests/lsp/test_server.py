"""`rebsync lsp` answers a real client over its streams."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from tests.lsp.client import Editor, at
from tests.lsp.conftest import InEditor

MODEL = """\
env int limit = 3;

/* 😀 counts */ @Robot reactiveclass Counter(3) {
  statevars {
    int count;
    boolean full;
  }
  Counter() {
    count = 0;
    full = false;
    self.step(1);
  }
  msgsrv step(int by) {
    count = count + by;
    if (count > limit) {
      full = true;
    } else {
      self.step(by) after(1);
    }
  }
}

main {
  Counter counter():();
}
"""
PROPERTY = """\
property {
  define {
    over = counter.count > limit;
  }
  Assertion {
    Fills: !over || counter.full;
  }
}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "counter.rebeca").write_text(MODEL, encoding="utf-8")
    (tmp_path / "counter.property").write_text(PROPERTY, encoding="utf-8")
    return tmp_path


def _of(uri: str) -> lsp.TextDocumentIdentifier:
    return lsp.TextDocumentIdentifier(uri)


def test_diagnostics_follow_what_is_typed(folder: Path, in_editor: InEditor) -> None:
    async def play(client: Editor) -> None:
        uri = client.open(folder / "counter.rebeca")
        assert not [d for d in await client.diagnostics(uri) if d.severity == 1]
        name = at(MODEL, "count + by")
        client.type(uri, lsp.Range(name, lsp.Position(name.line, name.character + 5)), "𐐀cont")
        (found,) = [d for d in await client.diagnostics(uri) if d.severity == 1]
        assert found.code == "RS203"
        assert found.range == lsp.Range(name, lsp.Position(name.line, name.character + 6))

    in_editor(play)


def test_diagnostics_of_properties_follow_the_model(folder: Path, in_editor: InEditor) -> None:
    async def play(client: Editor) -> None:
        model = client.open(folder / "counter.rebeca")
        properties = client.open(folder / "counter.property")
        assert not await client.diagnostics(properties)
        start = at(MODEL, "boolean full", 8)
        client.type(model, lsp.Range(start, lsp.Position(start.line, start.character + 4)), "all")
        (found,) = await client.diagnostics(properties)
        assert found.code == "RS902"

    in_editor(play)


def test_a_half_typed_document_has_an_outline(folder: Path, in_editor: InEditor) -> None:
    async def play(client: Editor) -> None:
        uri = client.open(folder / "counter.rebeca")
        params = lsp.DocumentSymbolParams(_of(uri))
        names = _names(await client.text_document_document_symbol_async(params))
        assert names == ["limit", "Counter", "count", "full", "Counter", "step", "main", "counter"]
        end = at(MODEL, "count + by")
        client.type(uri, lsp.Range(end, lsp.Position(99, 0)), "")
        rest = _names(await client.text_document_document_symbol_async(params))
        assert rest == names[:6]
        client.type(uri, lsp.Range(lsp.Position(0, 0), lsp.Position(99, 0)), "{{{{ (")
        assert _names(await client.text_document_document_symbol_async(params)) == rest

    in_editor(play)


def _names(symbols: object) -> list[str]:
    assert isinstance(symbols, Sequence)
    return [name for s in symbols for name in (s.name, *_names(s.children or []))]


def test_names_lead_to_declarations_and_uses(folder: Path, in_editor: InEditor) -> None:
    async def play(client: Editor) -> None:
        uri = client.open(folder / "counter.property")
        place = at(PROPERTY, "count > limit")
        found = await client.text_document_definition_async(lsp.DefinitionParams(_of(uri), place))
        model = (folder / "counter.rebeca").as_uri()
        assert isinstance(found, Sequence)
        (declared,) = found
        assert isinstance(declared, lsp.Location)
        assert (declared.uri, declared.range.start) == (model, at(MODEL, "count;"))
        context = lsp.ReferenceContext(include_declaration=False)
        used = await client.text_document_references_async(
            lsp.ReferenceParams(context, _of(uri), place)
        )
        assert used is not None
        assert len(used) == 5
        shown = await client.text_document_hover_async(lsp.HoverParams(_of(uri), place))
        assert shown is not None
        assert "statevar int count" in shown.contents.value  # type: ignore[union-attr]

    in_editor(play)


@pytest.mark.parametrize(
    ("place", "told"),
    [
        ("after(1)", "units of time later"),
        ("@Robot", "a robot"),
        ("after nothing", None),
        ("limit)", "```\n\nat most"),
        ("step(1)", "Counts up.\nIt goes on for ever."),
    ],
)
def test_hover_tells_of_words_and_of_remarks(
    place: str, told: str | None, folder: Path, in_editor: InEditor
) -> None:
    remarks = "  // Counts up.\n  // It goes on for ever.\n  @priority(1)\n  msgsrv step("
    model = MODEL.replace("  msgsrv step(", remarks) + "// after nothing\n"
    model = model.replace("limit = 3;", "limit = 3;  // at most")

    async def play(client: Editor) -> None:
        uri = client.open(folder / "counter.rebeca", model)
        params = lsp.HoverParams(_of(uri), at(model, place))
        shown = await client.text_document_hover_async(params)
        assert shown is None if told is None else told in shown.contents.value  # type: ignore[union-attr]

    in_editor(play)


def test_renaming_reaches_the_properties(folder: Path, in_editor: InEditor) -> None:
    async def play(client: Editor) -> None:
        uri = client.open(folder / "counter.rebeca")
        params = lsp.RenameParams(_of(uri), at(MODEL, "full;"), "done")
        edit = await client.text_document_rename_async(params)
        assert edit is not None
        assert edit.changes is not None
        texts = {
            Path(of).suffix: _applied(edit.changes[(folder / of).as_uri()], text)
            for of, text in (("counter.rebeca", MODEL), ("counter.property", PROPERTY))
        }
        assert texts[".rebeca"] == MODEL.replace("full", "done")
        assert texts[".property"] == PROPERTY.replace("full", "done")
        for taken in ("count", "by", "main", "2x", "limit"):
            with pytest.raises(JsonRpcException, match=taken):
                await client.text_document_rename_async(
                    lsp.RenameParams(_of(uri), at(MODEL, "full;"), taken)
                )

    in_editor(play)


def _applied(edits: object, text: str) -> str:
    lines = text.splitlines(keepends=True)
    assert isinstance(edits, Sequence)
    for edit in sorted(edits, key=lambda e: (-e.range.start.line, -e.range.start.character)):
        line = lines[edit.range.start.line].encode("utf-16-le")
        start, end = edit.range.start.character * 2, edit.range.end.character * 2
        new = line[:start] + edit.new_text.encode("utf-16-le") + line[end:]
        lines[edit.range.start.line] = new.decode("utf-16-le")
    return "".join(lines)


def test_completion_knows_what_stands_before_the_dot(folder: Path, in_editor: InEditor) -> None:
    async def play(client: Editor) -> None:
        uri = client.open(folder / "counter.rebeca")
        place = at(MODEL, "count + by")
        client.type(uri, lsp.Range(place, place), "self.")
        labels = await _labels(client, uri, lsp.Position(place.line, place.character + 5))
        assert labels == {"count", "full", "step"}
        labels = await _labels(client, uri, place)
        assert {"by", "count", "limit", "now", "while", "delay"} <= labels
        properties = client.open(folder / "counter.property")
        place = at(PROPERTY, "count > limit")
        assert await _labels(client, properties, place) == {"count", "full"}

    in_editor(play)


async def _labels(client: Editor, uri: str, place: lsp.Position) -> set[str]:
    found = await client.text_document_completion_async(lsp.CompletionParams(_of(uri), place))
    assert isinstance(found, Sequence)
    return {item.label for item in found}


def test_formatting_folding_and_quick_fixes(folder: Path, in_editor: InEditor) -> None:
    text = MODEL.replace("statevars", "statvars").replace("    count = 0;", "count  =  0;")

    async def play(client: Editor) -> None:
        uri = client.open(folder / "counter.rebeca", text)
        options = lsp.FormattingOptions(tab_size=2, insert_spaces=True)
        params = lsp.DocumentFormattingParams(_of(uri), options)
        assert not await client.text_document_formatting_async(params)
        place = at(text, "statvars")
        action = lsp.CodeActionParams(
            _of(uri), lsp.Range(place, place), lsp.CodeActionContext(diagnostics=[])
        )
        (fix,) = await client.text_document_code_action_async(action) or ()
        assert isinstance(fix, lsp.CodeAction)
        assert fix.edit is not None
        assert fix.edit.changes is not None
        (edit,) = fix.edit.changes[uri]
        client.type(uri, edit.range, edit.new_text)
        (whole,) = await client.text_document_formatting_async(params) or ()
        assert "    count = 0;\n" in whole.new_text
        assert "/* 😀 counts */" in whole.new_text
        folds = await client.text_document_folding_range_async(lsp.FoldingRangeParams(_of(uri)))
        assert [f.start_line for f in folds or ()] == [3, 7, 14, 16, 12, 2, 22]

    in_editor(play)


def test_code_is_left_to_its_own_servers(folder: Path, in_editor: InEditor) -> None:
    code = folder / "robot.cpp"
    code.write_text("int  main() {}\n", encoding="utf-8")

    async def play(client: Editor) -> None:
        uri = client.open(code)
        place = lsp.Position(0, 6)
        assert await client.text_document_hover_async(lsp.HoverParams(_of(uri), place)) is None
        options = client.registered[lsp.TEXT_DOCUMENT_FORMATTING].register_options
        shown = [{"pattern": "**/*.rebeca"}, {"pattern": "**/*.property"}]
        assert json.loads(json.dumps(options, default=vars))["documentSelector"] == shown

    in_editor(play)
