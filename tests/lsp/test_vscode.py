"""The grammar of VS Code has the words of the language, and tokenises the examples as the lexer."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from rebsync.grammars.formulas import OPERATORS
from rebsync.grammars.lexer import keywords, lex, rebeca_grammar
from rebsync.grammars.properties import property_grammar
from rebsync.static.scope import CLOCK, FUNCTIONS
from rebsync.static.types import PRIMITIVES

ROOT = Path(__file__).parents[2]
EXTENSION = ROOT / "editors/vscode"
RESERVED = ("keyword.", "storage.", "constant.language.", "variable.language.")
WORD = re.compile(r"(?<![\w$])[A-Za-z_$][\w$]*")


def _words(name: str) -> set[str]:
    """The words in alternations and declarations of a grammar."""
    text = (EXTENSION / f"syntaxes/{name}.tmLanguage.json").read_text(encoding="utf-8")
    groups = re.findall(r"\\\\b\((?:\?:)?([A-Za-z|]+)\)", text)
    return {word for group in groups for word in group.split("|")}


def test_models_have_their_words() -> None:
    builtin = {*PRIMITIVES, *CLOCK, *FUNCTIONS, "sender", "void"}
    assert _words("rebeca") == keywords(rebeca_grammar()) | builtin


def test_properties_have_their_words() -> None:
    operators = {name for names in OPERATORS.values() for name in names}
    own = keywords(property_grammar()) - keywords(rebeca_grammar())
    assert _words("rebeca-property") == own | operators


def test_examples_are_tokenised() -> None:
    if shutil.which("node") is None or not (EXTENSION / "node_modules/vscode-textmate").is_dir():
        pytest.skip("Node or its packages are not installed: npm ci --prefix editors/vscode")
    paths = [str(p) for p in sorted(ROOT.glob("examples/*/*.rebeca"))]
    done = subprocess.run(
        ["node", str(EXTENSION / "test/grammars.js"), *paths],
        capture_output=True,
        text=True,
        check=True,
    )
    reserved = keywords(rebeca_grammar())
    for path, line in zip(paths, done.stdout.splitlines(), strict=True):
        lexed = lex(Path(path).read_text(encoding="utf-8"))
        shown = list(_scopes(json.loads(line)["tokens"]))
        assert [word for word, _ in shown] == [t for t in lexed.tokens if WORD.fullmatch(t)]
        for word, scope in shown:
            if word in reserved:
                assert scope.startswith(RESERVED), (path, word, scope)


def _scopes(tokens: list[tuple[str, str]]) -> Iterator[tuple[str, str]]:
    for text, scope in tokens:
        if not scope.startswith(("comment", "string", "constant.numeric")):
            yield from ((word, scope) for word in WORD.findall(text))
