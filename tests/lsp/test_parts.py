"""What is parsed part by part is what is parsed at once, through any edits."""

from __future__ import annotations

import random
import re
from pathlib import Path

import pytest

from rebsync.lint import lint
from rebsync.lsp.document import read_model
from rebsync.source import Source

ROOT = Path(__file__).parents[2]
MODELS = sorted(ROOT.glob("examples/*/*.rebeca"))
CHANGES = ("", ";", "}", "{", " x ", "reactiveclass A(2) { msgsrv m() { } }", "/*", "main")


@pytest.mark.parametrize("path", MODELS[::3], ids=lambda path: path.stem)
def test_edits_find_what_lint_finds(path: Path) -> None:
    drawn = random.Random(path.stem)
    text = path.read_text(encoding="utf-8")
    document = read_model("", Source("", text))
    for _ in range(20):
        token = drawn.choice([*re.finditer(r"\w+|\S", text)])
        edited = text[: token.start()] + drawn.choice(CHANGES) + text[token.end() :]
        document = read_model("", Source("", edited), document)
        exact = lint(document.source).diagnostics
        assert document.exact_findings == exact, edited
        if not any(d.code.startswith("RS1") for d in exact):
            assert document.findings == exact, edited
        for each in document.occurrences:
            assert document.slice(each.span) == each.entity.name


def test_only_what_was_edited_is_parsed_again() -> None:
    text = MODELS[-1].read_text(encoding="utf-8")
    before = read_model("", Source("", text))
    after = read_model("", Source("", text.replace("= 0", "= 10", 1)), before)
    kept = zip(before.parts.parts, after.parts.parts, strict=True)
    assert sum(old is not new for old, new in kept) == 1
    assert len(after.parts.parts) > 3
