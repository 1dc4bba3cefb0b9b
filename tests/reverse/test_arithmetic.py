"""Expressions are worked out as Python does, as far as they are arithmetic."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync.reverse.launch.arithmetic import Scalar, evaluate
from rebsync.reverse.unknowns import Open

_NUMBERS = st.integers(-9, 9).map(str) | st.sampled_from(["0.5", "1e2", "True", "'a'", "x"])
_SIGNS = st.sampled_from(["+", "-", "*", "/", "//", "%", "**", "<", "==", "and", "or", "in"])
_EXPRESSIONS = st.recursive(
    _NUMBERS,
    lambda inner: st.one_of(
        st.tuples(inner, _SIGNS, inner).map(" ".join),
        inner.map(lambda e: f"(not {e})"),
        inner.map(lambda e: f"-({e})"),
        inner.map(lambda e: f"str({e})"),
    ),
    max_leaves=6,
)


@given(_EXPRESSIONS)
def test_the_value_is_that_of_python(expression: str) -> None:
    found = evaluate(expression, {"x": 3}, {})
    if isinstance(found, Open):
        return
    scope = {"__builtins__": {"str": str}, "x": 3}
    expected = eval(expression, scope)
    assert type(found) is type(expected)
    assert found == expected or found != found


@given(st.text())
def test_any_text_has_a_value_or_a_reason(text: str) -> None:
    found = evaluate(text, {"a": 1}, {})
    assert not isinstance(found, Open) or found.why


def test_names_and_functions() -> None:
    names: dict[str, Scalar | Open] = {"n": 2, "lost": Open("it is lost")}
    assert evaluate("n * f('a')", names, {"f": lambda text: len(text) + 4}) == 10
    assert evaluate("1 or lost", names, {}) == 1
    assert evaluate("lost + 1", names, {}) == Open("it is lost")
    assert evaluate("other", names, {}) == Open("`other` has no value")
    assert evaluate("sin(pi / 2)", {}, {}) == math.sin(math.pi / 2)


@pytest.mark.parametrize("text", ["1 if x", "[x for x in y]", "().x", "f'{1}'", "lambda: 1", "1j"])
def test_what_is_more_than_arithmetic_is_open(text: str) -> None:
    assert isinstance(evaluate(text, {"x": 1, "y": 2}, {}), Open)


@pytest.mark.parametrize("text", ["-" * 4000 + "1", "+".join("1" * 2000), "2**64**2", "'a'+" * 900])
def test_large_expressions_end(text: str) -> None:
    evaluate(text, {}, {})
