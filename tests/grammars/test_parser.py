"""Mistakes of syntax: each is found at its place, and reading goes on behind it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync.edits import apply_edits, certain_edits
from rebsync.grammars.formatting import format_text
from rebsync.grammars.parser import Parsed, parse_expression, parse_model, parse_statement
from rebsync.model import Binary, Broken, Paren, walk
from rebsync.printing import print_model
from rebsync.source import Source
from tests.strategies import models

CASES = Path(__file__).parent / "cases"
EXPECTATION = re.compile(r"// E: (?P<code>RS\d+) ?(?P<message>.*?)(?P<fix> \| fix)?(?=\s*// E: |$)")


def read_cases() -> Iterator[tuple[str, str]]:
    for path in sorted(CASES.glob("*.rebeca")):
        for part in path.read_text(encoding="utf-8").split("// case: ")[1:]:
            title, _, text = part.partition("\n")
            yield f"{path.stem}: {title}", text


def parse(text: str) -> Parsed:
    return parse_model(Source("case.rebeca", text))


@pytest.mark.parametrize(("title", "text"), [pytest.param(t, x, id=t) for t, x in read_cases()])
def test_mistakes_are_reported_where_they_are(title: str, text: str) -> None:
    parsed = parse(text)
    found = [
        (parsed.source.position(d.span.start).line, d.code, d.message) for d in parsed.diagnostics
    ]
    wanted = [
        (number, m["code"], m["message"])
        for number, line in enumerate(text.split("\n"), 1)
        for m in EXPECTATION.finditer(line)
    ]
    assert len(found) == len(wanted), found
    for (line, code, message), (want_line, want_code, want_message) in zip(
        sorted(found), sorted(wanted), strict=True
    ):
        assert line == want_line, found
        assert code.startswith(want_code), found
        assert message.startswith(want_message), found


@pytest.mark.parametrize(("title", "text"), [pytest.param(t, x, id=t) for t, x in read_cases()])
def test_certain_corrections_remove_the_mistake(title: str, text: str) -> None:
    parsed = parse(text)
    edits = certain_edits(parsed.diagnostics)
    fixes = sum(m["fix"] is not None for m in EXPECTATION.finditer(text))
    fixable = [d for d in parsed.diagnostics if d.edits]
    assert len(fixable) >= fixes
    if edits:
        after = parse(apply_edits(text, edits))
        assert len(after.diagnostics) == len(parsed.diagnostics) - len(fixable)


@given(models(), st.data())
def test_no_damage_stops_the_parser(model: object, data: st.DataObject) -> None:
    text = print_model(model)  # type: ignore[arg-type]
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(text)))
        end = data.draw(st.integers(at, min(len(text), at + 30)))
        new = data.draw(
            st.sampled_from(["", "{", "}", "(", ")", ";", "?", "@", "if", "x", "9", '"'])
        )
        text = text[:at] + new + text[end:]
    parsed = parse(text)
    assert parsed.ok or parsed.diagnostics
    assert all(0 <= d.span.start <= d.span.end <= len(text) + 1 for d in parsed.diagnostics)


@given(models())
def test_a_tree_without_mistakes_has_no_broken_parts(model: object) -> None:
    parsed = parse(print_model(model))  # type: ignore[arg-type]
    assert parsed.ok, parsed.diagnostics
    assert not any(isinstance(node, Broken) for node in walk(parsed.model))
    assert parsed.model == model


def test_operators_bind_as_in_c() -> None:
    tree = parse_expression("a || b && c == d + e * f - (g)")
    assert isinstance(tree, Binary) and tree.operator == "||"
    comparison = parse_expression("c == d + e * f - (g)")
    assert tree.right == Binary("&&", parse_expression("b"), comparison)
    sum_ = parse_expression("1 - 2 - 3")
    assert isinstance(sum_, Binary) and isinstance(sum_.left, Binary)
    assert isinstance(parse_expression("(a)"), Paren)


def test_a_cast_of_a_sign() -> None:
    assert parse_expression("(int) -a[0] * b") == parse_expression("(int) (-a[0]) * b")
    assert parse_expression("(float)+a.x") == parse_expression("(float) (+a.x)")
    assert isinstance(parse_expression("(a) - b"), Binary)
    assert format_text("env int a = (int) -1 - (b) - 2;") == "env int a = (int) -1 - (b) - 2;\n"


def test_parts_that_are_wrong_raise() -> None:
    with pytest.raises(ValueError, match="not a statement"):
        parse_statement("if (x")


def test_deep_nesting_is_reported_and_not_fatal() -> None:
    deep = "(" * 5000 + "x" + ")" * 5000
    parsed = parse(f"reactiveclass A(1) {{ A() {{ x = {deep}; }} }} main {{ A a():(); }}")
    assert [d.code for d in parsed.diagnostics] == ["RS111"]


def test_long_chains_are_reported_and_not_fatal() -> None:
    chain = " + ".join(["x"] * 5000)
    parsed = parse(f"reactiveclass A(1) {{ A() {{ x = {chain}; }} }} main {{ A a():(); }}")
    assert [d.code for d in parsed.diagnostics] == ["RS111"]


@pytest.mark.parametrize("character", "\0\v\x1c\x85\u2028\u3000")
def test_odd_blanks_are_reported(character: str) -> None:
    found = parse_model(Source("a", f"main {{{character}}}")).diagnostics
    assert [d.code for d in found] == ["RS102"]


def test_a_lone_carriage_return_ends_a_line() -> None:
    text = "env int a = 1; // one\renv int b = 2; // two\rmain { }\r"
    assert format_text(text) == format_text(text.replace("\r", "\n"))
    assert parse_model(Source("a", text)).diagnostics == ()


@pytest.mark.parametrize(
    "piece", ["if (a) ", "while (a) for (;;) ", "if (a) ; else while (b) ", "if (a) b; else "]
)
def test_statements_without_braces_nest_only_so_deep(piece: str) -> None:
    def codes(times: int) -> list[str]:
        text = f"reactiveclass R(2) {{ R() {{ {piece * times}; }} }} main {{ }}"
        return [d.code for d in parse_model(Source("a", text)).diagnostics]

    assert codes(5000) == ["RS111"]
    assert codes(40) == []
