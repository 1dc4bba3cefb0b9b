"""Texts that are large without need are refused after a glance; tokens and bytes are counted."""

from __future__ import annotations

import tracemalloc
from time import process_time

import pytest

from rebsync.diagnostics import RebsyncError
from rebsync.grammars.amount import MOST_PARTS
from rebsync.grammars.lexer import MAX_NESTING, lex
from rebsync.grammars.parser import parse_model
from rebsync.grammars.properties import parse_properties
from rebsync.source import Source
from rebsync.toml import read_toml


@pytest.mark.parametrize("bracket", ["{", "(", "["])
def test_many_brackets_are_not_read(bracket: str) -> None:
    found = lex(bracket * MOST_PARTS)
    assert len(found.tokens) == MAX_NESTING + 1
    assert [d.code for d in found.diagnostics] == ["RS111"]


@pytest.mark.parametrize(
    "text",
    ["{", "}", ";", "a ", "1 ", "x = x + 1;\n", "R r(r):();\n", "// a\n", "/**/", '"a"', "\u00a7"],
)
def test_what_is_too_much_is_refused_at_once(text: str) -> None:
    """With a second each for what takes minutes and gigabytes where it is read."""
    start = process_time()
    source = Source("a", text * 1_000_000)
    model, properties = parse_model(source), parse_properties(source)
    assert process_time() - start < 4
    assert [d.code for d in (*model.diagnostics, *properties.diagnostics)] == ["RS115"] * 2
    assert model.model.classes == ()


def test_what_is_just_not_too_much_is_read() -> None:
    text = "// a /* b\n" * 50_000 + "/* a" + " b" * MOST_PARTS + " */" + '"' + "a " * MOST_PARTS
    assert [d.code for d in lex(text).diagnostics] == ["RS103"]
    assert not lex(" " * 2 * MOST_PARTS).diagnostics


def test_a_comment_takes_no_more_memory_than_its_text() -> None:
    text = "/* " + "a b c d e\n" * 100_000
    lex("")
    tracemalloc.start()
    try:
        found = lex(text)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert [d.code for d in found.diagnostics] == ["RS103"]
    assert most < 10 * len(text)


def test_choices_in_angles_without_an_end_take_linear_time() -> None:
    """With quadratic time this takes minutes."""
    found = lex("?<" * 50_000)
    assert any(d.code == "RS111" for d in found.diagnostics)


@pytest.mark.parametrize(
    "text",
    [
        "[" + ".".join("a" * 50_000) + "]\n",
        ".".join("a" * 50_000) + " = 1\n",
        '["a" . ' + " . ".join(["'b'"] * 50_000) + "]\n",
        "a = " + "[" * 50_000 + "]" * 50_000 + "\n",
        "a = " + "{a=" * 50_000 + "1" + "}" * 50_000 + "\n",
    ],
)
def test_deep_toml_is_refused(text: str) -> None:
    with pytest.raises(RebsyncError) as raised:
        read_toml(Source("rebsync.toml", text))
    (found,) = raised.value.findings[0].diagnostics
    assert found.code == "RS807"
    assert "nested too deeply" in found.message


@pytest.mark.parametrize("line", [". " * 400, "." * 900, "a b " * 200, "[a" + " " * 900])
def test_places_are_looked_for_in_linear_time(line: str) -> None:
    """With what grows exponentially this never ends."""
    table = read_toml(Source("rebsync.toml", f'x = """\n{line}\n"""\n'))
    table.finish()
    assert [d.code for d in table.diagnostics] == ["RS808"]


def test_dots_in_texts_are_no_depth() -> None:
    dots = " ".join(["one.two.three"] * 100)
    assert read_toml(Source("rebsync.toml", f'x = "{dots}"\n')).text("x") == dots
