"""The laws of printing and formatting, on drawn models and on drawn disorder."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from typing import TypeVar, cast

from hypothesis import given
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.grammars.formatting import format_text, source_tokens
from rebsync.grammars.parser import parse_expression, parse_model, parse_statement
from rebsync.printing import print_expression, print_model, print_statement
from rebsync.source import Source
from rebsync.spacing import is_comment
from tests.strategies import blocks, expressions, models

_T = TypeVar("_T")

GAPS = (" ", "  ", "\n", "\n\n", "\n \n\t\n", "\t", "\r\n", " /*{}*/ ", "\n/*{}*/\n", " //{}\n")
MORE_GAPS = ("\n  //{}\n\n", " /*{}\n    more */ ", "\n  /* {}\n   * more\n   */\n", " //{}\r\n")


def parsed(text: str) -> m.Model:
    """The tree of a text without mistakes."""
    result = parse_model(Source("drawn.rebeca", text))
    assert not result.diagnostics, f"{result.diagnostics}\n{text}"
    return result.model


def rebuilt(node: _T, change: Callable[[m.Node], m.Node | None]) -> _T:
    """The tree with `change` applied to every node, inner ones first."""
    return cast("_T", _rebuilt(node, change))


def _rebuilt(node: object, change: Callable[[m.Node], m.Node | None]) -> object:
    if isinstance(node, tuple):
        return tuple(_rebuilt(each, change) for each in node)
    if not is_dataclass(node):
        return node
    tree = cast("m.Block", node)
    kept = {f.name: _rebuilt(getattr(tree, f.name), change) for f in fields(tree) if f.compare}
    return change(replace(tree, **kept))  # type: ignore[arg-type]


def bare(node: _T) -> _T:
    """Without the parentheses that a tree may do without."""
    return rebuilt(node, lambda n: n.inner if isinstance(n, m.Paren) else n)


def unbraced(node: m.Statement) -> m.Statement:
    """Without the braces of a single statement under a header."""
    return rebuilt(node, _unbraced)


def _unbraced(node: m.Node) -> m.Node:
    match node:
        case m.If():
            otherwise = _lone(node.otherwise) if node.otherwise else None
            return replace(node, then=_lone(node.then), otherwise=otherwise)
        case m.While() | m.For():
            return replace(node, body=_lone(node.body))
        case _:
            return node


def _lone(body: m.Statement) -> m.Statement:
    while isinstance(body, m.Block) and len(body.statements) == 1 and not body.annotations:
        body = body.statements[0]
    return body


@given(models())
def test_a_printed_model_parses_to_itself_and_is_canonical(model: m.Model) -> None:
    text = print_model(model)
    assert parsed(text) == model
    assert format_text(text) == text


@given(expressions())
def test_parentheses_come_in_where_a_tree_without_them_needs_them(
    expression: m.Expression,
) -> None:
    tree = bare(expression)
    text = print_expression(tree)
    assert bare(parse_expression(text)) == tree, text


@given(blocks())
def test_an_else_stays_with_its_if(block: m.Block) -> None:
    tree = unbraced(block)
    text = print_statement(tree)
    assert unbraced(parse_statement(text)) == tree, text


@given(models(), st.data())
def test_disorder_is_put_in_order_and_nothing_is_lost(model: m.Model, data: st.DataObject) -> None:
    tokens = [token.text for token in source_tokens(print_model(model))]
    gaps = data.draw(
        st.lists(
            st.sampled_from(GAPS + MORE_GAPS), min_size=len(tokens) + 1, max_size=len(tokens) + 1
        )
    )
    spread = "".join(
        gap.format(i) + token for i, (gap, token) in enumerate(zip(gaps, tokens, strict=False))
    )
    spread += gaps[-1].format("end")
    text = format_text(spread)
    assert parsed(text) == model
    assert _words(text) == _words(spread)
    assert format_text(text) == text


def _words(text: str) -> list[str]:
    """All tokens and comments, blanks within comments aside."""
    return [
        "".join(token.text.split()) if is_comment(token.text) else token.text
        for token in source_tokens(text)
    ]
