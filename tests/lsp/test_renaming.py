"""Every name of an example can be changed, and changed back."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types as lsp

from rebsync.diagnostics import Edit
from rebsync.edits import apply_edits
from rebsync.lsp.document import Document, read_model, read_properties
from rebsync.lsp.renaming import RenameRefused, renamed
from rebsync.source import Source, Span

ROOT = Path(__file__).parents[2]
HIDING = """\
env int a = 1;
reactiveclass C(2) {
  statevars { int b; }
  C() { b = a; self.m(2); }
  msgsrv m(int c) { int d; d = c; b = a + d; }
}
main { C r():(); }
"""


def _documents(path: Path) -> list[Document]:
    model = read_model("m", Source("m.rebeca", path.read_text(encoding="utf-8")))
    text = path.with_suffix(".property").read_text(encoding="utf-8")
    return [model, read_properties("p", Source("m.property", text), model)]


def _renamed(documents: list[Document], edit: lsp.WorkspaceEdit) -> list[Document]:
    model, properties = (_edited(each, edit) for each in documents)
    document = read_model("m", Source("m.rebeca", model))
    return [document, read_properties("p", Source("m.property", properties), document)]


def _edited(document: Document, edit: lsp.WorkspaceEdit) -> str:
    layout, found = document.layout, (edit.changes or {}).get(document.uri, ())
    edits = (
        Edit(Span(*(layout.to_text(document.offset(p)) for p in (e.range.start, e.range.end))), n)
        for e in found
        if (n := e.new_text)
    )
    return apply_edits(document.source.text, edits)


@pytest.mark.parametrize("name", ["experiment3", "hello"])
def test_names_are_changed_and_changed_back(name: str) -> None:
    before = _documents(ROOT / f"examples/{name}/{name}.rebeca")
    entities = {o.entity for document in before for o in document.occurrences}
    assert len(entities) > 3
    for entity in entities:
        after = _renamed(before, renamed(before, entity, "zebra"))
        assert sum(d.source.text.count("zebra") for d in after) > 0
        (there,) = {o.entity for d in after for o in d.occurrences if o.entity.name == "zebra"}
        back = _renamed(after, renamed(after, there, entity.name))
        assert [d.source.text for d in back] == [d.source.text for d in before]


@pytest.mark.parametrize(
    ("old", "new"), [("b", "a"), ("c", "a"), ("d", "b"), ("a", "b"), ("a", "d")]
)
def test_a_name_that_would_hide_another_is_refused(old: str, new: str) -> None:
    document = read_model("m", Source("m.rebeca", HIDING))
    (entity,) = {o.entity for o in document.occurrences if o.entity.name == old}
    with pytest.raises(RenameRefused):
        renamed([document], entity, new)
