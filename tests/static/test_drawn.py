"""The analysis on drawn models: right ones are accepted, disorder never raises."""

from __future__ import annotations

import re
from collections import Counter
from typing import get_args

from hypothesis import given
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.codes import CODES
from rebsync.grammars.parser import parse_model
from rebsync.printing import print_model
from rebsync.source import Source
from rebsync.static import analyse
from rebsync.static.constants import constant, wrap
from tests.strategies import models

TOKEN = re.compile(r'"[^"]*"|[\w.]+|\s+|[^\w\s]')
EXPRESSIONS = get_args(m.Expression)
INTS = st.integers(-(2**31), 2**31 - 1)


def without_annotations(node: m.Node) -> list[m.Node]:
    """The nodes of a tree; what stands in annotations need not mean anything."""
    found: list[m.Node] = [node]
    for child in m.children(node):
        if not isinstance(child, m.Annotation):
            found.extend(without_annotations(child))
    return found


@given(models())
def test_drawn_models_have_no_errors_and_a_type_everywhere(model: m.Model) -> None:
    analysis = analyse(model)
    assert analysis.errors == ()
    nodes = [n for n in without_annotations(model) if isinstance(n, EXPRESSIONS)]
    assert [n for n in nodes if analysis.symbol_of(n) is None and isinstance(n, m.Name)] == []
    assert [n for n in nodes if id(n) not in analysis.types] == []


@given(models(), st.data())
def test_disorder_never_raises(model: m.Model, data: st.DataObject) -> None:
    tokens = TOKEN.findall(print_model(model))
    places = st.integers(0, len(tokens) - 1)
    for _ in range(data.draw(st.integers(1, 4))):
        tokens[data.draw(places)] = tokens[data.draw(places)]
    text = "".join(tokens)
    parsed = parse_model(Source("drawn.rebeca", text))
    found = analyse(parsed.model, incomplete=not parsed.ok).diagnostics
    assert all(d.code in CODES and 0 <= d.span.start <= d.span.end <= len(text) for d in found)
    assert max(Counter(found).values(), default=1) == 1


@given(INTS, INTS)
def test_division_truncates(left: int, right: int) -> None:
    a, b = m.IntLiteral(left), m.IntLiteral(right)
    quotient, rest = constant(m.Binary("/", a, b)), constant(m.Binary("%", a, b))
    if right == 0:
        assert quotient is None and rest is None
        return
    assert isinstance(quotient, int) and isinstance(rest, int)
    assert wrap(quotient * right + rest) == left
    assert abs(rest) < abs(right) and rest * left >= 0


@given(st.sampled_from("+-*"), INTS, INTS, INTS)
def test_arithmetic_wraps_at_every_step(operator: str, a: int, b: int, c: int) -> None:
    compute = {"+": int.__add__, "-": int.__sub__, "*": int.__mul__}[operator]
    inner = m.Binary(operator, m.IntLiteral(a), m.IntLiteral(b))
    value = constant(m.Binary(operator, inner, m.IntLiteral(c)))
    assert value == wrap(compute(compute(a, b), c))
