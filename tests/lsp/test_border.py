"""From model to code and back, drift in saved files, and the actions that take it away."""

from __future__ import annotations

import re
import shutil
from ast import literal_eval
from collections.abc import Sequence
from pathlib import Path

import pytest
from lsprotocol import types as lsp

from rebsync.cli import main
from tests.lsp.client import Editor, at
from tests.lsp.conftest import InEditor

HELLO = Path(__file__).parents[2] / "examples/hello"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    made = tmp_path / "hello"
    shutil.copytree(HELLO, made)
    return made


def _of(uri: str) -> lsp.TextDocumentIdentifier:
    return lsp.TextDocumentIdentifier(uri)


def test_an_element_leads_to_its_code_and_back(folder: Path, in_editor: InEditor) -> None:
    model = folder / "hello.rebeca"
    text = model.read_text(encoding="utf-8")

    async def play(client: Editor) -> None:
        uri = client.open(model)
        place = at(text, "msgsrv ", len("msgsrv "))
        found = await client.text_document_implementation_async(
            lsp.ImplementationParams(_of(uri), place)
        )
        assert isinstance(found, Sequence)
        code = next(f for f in found if f.uri.endswith(".cpp"))  # type: ignore[union-attr]
        assert isinstance(code, lsp.Location)
        inside = lsp.Position(code.range.start.line + 1, 0)
        back = await client.text_document_definition_async(
            lsp.DefinitionParams(_of(code.uri), inside)
        )
        assert isinstance(back, Sequence)
        (declared,) = back
        assert isinstance(declared, lsp.Location)
        assert (declared.uri, declared.range.start) == (uri, place)

    in_editor(play)


def test_a_server_leads_to_the_code_of_its_own_class_and_back(in_editor: InEditor) -> None:
    model = HELLO.parent / "experiment2/experiment2.rebeca"
    text = model.read_text(encoding="utf-8")
    second = text.index("reactiveclass", text.index("msgsrv begin"))
    before = text[: text.index("msgsrv begin", second) + len("msgsrv ")]
    place = lsp.Position(before.count("\n"), len(before) - before.rindex("\n") - 1)

    async def play(client: Editor) -> None:
        document = _of(client.open(model))
        found = await client.text_document_implementation_async(
            lsp.ImplementationParams(document, place)
        )
        assert isinstance(found, Sequence)  # a demo has one, too
        (code,) = (c for c in found if isinstance(c, lsp.Location) and "/examples/" in c.uri)
        inside = lsp.Position(code.range.start.line + 1, 0)
        back = await client.text_document_definition_async(
            lsp.DefinitionParams(_of(code.uri), inside)
        )
        assert isinstance(back, Sequence)
        (declared,) = back
        assert isinstance(declared, lsp.Location)
        assert declared.range.start == place

    in_editor(play)


@pytest.mark.parametrize(
    ("element", "files"),
    [
        ("walk() {", ["msg/WalkerWalk.msg", "src/walker.cpp"]),
        ("steps;", ["include/hello/walker.h", "msg/WalkerState.msg"]),
        ("Walker(2)", ["include/hello/walker.h", "msg/WalkerState.msg", "src/walker.cpp"]),
        ("walker()", ["launch/hello.launch"]),
    ],
)
def test_an_element_tells_its_files(
    element: str, files: list[str], folder: Path, in_editor: InEditor
) -> None:
    model = folder / "hello.rebeca"

    async def play(client: Editor) -> None:
        place = at(model.read_text(encoding="utf-8"), element)
        params = lsp.HoverParams(_of(client.open(model)), place)
        shown = await client.text_document_hover_async(params)
        assert shown is not None
        assert isinstance(shown.contents, lsp.MarkupContent)
        links = dict(re.findall(r"\[(.*?)\]\((.*?)\)", shown.contents.value))
        assert links == {name: (folder / "hello" / name).as_uri() for name in files}

    in_editor(play)


def test_a_change_of_the_code_is_taken_into_the_model(folder: Path, in_editor: InEditor) -> None:
    (source,) = folder.glob("hello/src/*[!e].cpp")
    text = source.read_text(encoding="utf-8")
    (model,) = folder.glob("*.rebeca")
    before = model.read_text(encoding="utf-8")

    async def play(client: Editor) -> None:
        uri = client.open(source)
        source.write_text(text.replace("after(1)", "after(2)"), encoding="utf-8")
        client.text_document_did_save(lsp.DidSaveTextDocumentParams(_of(uri)))
        (found,) = await client.diagnostics(uri)
        assert found.code == "RS952"
        context = lsp.CodeActionContext(diagnostics=[found])
        (action,) = (
            await client.text_document_code_action_async(
                lsp.CodeActionParams(_of(uri), found.range, context)
            )
            or ()
        )
        assert action.title == "Take into the model (rebsync sync)"
        # lsprotocol takes an action that has a command for a command, and its command for a text
        sent = literal_eval(str(action.command))
        command = lsp.ExecuteCommandParams(sent["command"], sent["arguments"])
        await client.workspace_execute_command_async(command)
        assert client.messages[-1].startswith("save ")  # the open text is the old one
        lines = text.count("\n")
        place = lsp.Range(lsp.Position(0, 0), lsp.Position(lines + 1, 0))
        client.type(uri, place, source.read_text(encoding="utf-8"))
        await client.workspace_execute_command_async(command)
        assert re.fullmatch(r"wrote \S+\.rebeca(; .+)?", client.messages[-1])
        assert not await client.diagnostics(uri)

    in_editor(play)
    assert model.read_text(encoding="utf-8") == before.replace("after(1)", "after(2)") != before


def test_an_edit_of_a_shared_run_time_part_is_told(folder: Path, in_editor: InEditor) -> None:
    generated = ["generate", "--runtime", "package", str(folder / "hello.rebeca")]
    assert main([*generated, "-o", str(folder)]) == 0
    path = folder / "rebsync_runtime" / "include" / "rebsync_runtime" / "mailbox.h"
    text = path.read_text()

    async def play(client: Editor) -> None:
        uri = client.open(path)
        path.write_text(text.replace("kQueueSize = 1000", "kQueueSize = 9", 1))
        client.text_document_did_save(lsp.DidSaveTextDocumentParams(_of(uri)))
        (found,) = await client.diagnostics(uri)
        assert found.code == "RS956"
        path.write_text(text)
        client.text_document_did_save(lsp.DidSaveTextDocumentParams(_of(uri)))
        assert not await client.diagnostics(uri)

    in_editor(play)


def test_a_mistake_that_the_check_meets_too_is_shown_once(
    folder: Path, in_editor: InEditor
) -> None:
    model = folder / "hello.rebeca"
    text = model.read_text(encoding="utf-8")
    model.write_text(text.replace("self.walk", "self.wolk", 1), encoding="utf-8")

    async def play(client: Editor) -> None:
        uri = client.open(model)
        (typed,) = await client.diagnostics(uri)
        client.text_document_did_save(lsp.DidSaveTextDocumentParams(_of(uri)))
        assert await client.diagnostics(uri) == [typed]

    in_editor(play)
