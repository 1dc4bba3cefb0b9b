"""Which differences between two models are so in writing only."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.equivalence import without_equivalent
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.source import Source

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

BOUNDED = tomllib.loads(Path(__file__).with_name("bounded.toml").read_text(encoding="utf-8"))
MODEL = """\
env int STEP = 1;
abstract reactiveclass Base(3) {{
  statevars {{ int n; {more} }}
  abstract int rate();
  int twice(int v) {{ return v * rate(); }}
  msgsrv step(int k) {{ {step} }}
  {methods}
}}
@Robot
reactiveclass Slow extends Base(3) {{
  Slow() {{ self.step(1); }}
  int rate() {{ return 2; }}
}}
@Robot
reactiveclass Fast extends Base(3) {{
  Fast() {{ self.step(1); }}
  int rate() {{ return 3; }}
}}
main {{ Slow slow():(); {instances} }}
"""
PLAIN = {"more": "", "step": "n = twice(k);", "methods": "", "instances": "Fast fast():();"}


def _left_over(left: dict[str, str], right: dict[str, str]) -> int:
    """How many of the differences may be more than writing."""
    return _left_over_of(*(MODEL.format(**{**PLAIN, **changes}) for changes in (left, right)))


def _left_over_of(*texts: str) -> int:
    sides = []
    for text in texts:
        parsed = parse_model(Source("base.rebeca", text))
        assert parsed.ok, parsed.diagnostics
        sides.append(SourcedModel(parsed.model, Source("base.rebeca", text)))
    first, second = sides
    apart = compare(first, second)
    assert not apart.is_empty
    rest, same = without_equivalent(apart, first, second)
    assert len(rest.differences) + len(same.differences) == len(apart.differences)
    return len(rest.differences)


SAME = {
    "a method in its place": ({}, {"step": "n = k * rate();"}),
    "a helper": ({}, {"step": "store(k);", "methods": "void store(int v) { n = twice(v); }"}),
    "a move by numbers": (
        {"step": "if (k > 0) { @Move(X + 1, Y); } n = k;"},
        {"step": "n = k; if (!(k > 0)) return; @Move(X + 1, Y);"},
    ),
    "a move by a local": (
        {"step": "if (k > 0) { @Move(X + 1, Y); } else { @Move(X - 1, Y); }"},
        {"step": "int d = k > 0 ? 1 : -1; @Move(X + d, Y);"},
    ),
    "a move by the same cells": (
        {"step": "if (k > 0) { @Move(X + 1, Y); } else if (k < 0) { @Move(X - 1, Y); }"},
        {"step": "if (k != 0) { @Move(X + (k < 0 ? -1 : 1), Y); }"},
    ),
    "a move in a loop": (
        {"step": "@Move(X, Y + STEP); delay(2); @Move(X, Y + STEP); delay(2);"},
        {"step": "for (int i = 0; i < 2; i++) { @Move(X, Y + STEP); delay(2); }"},
    ),
}
DIFFERENT = {
    "a variable on which nothing depends": (
        {},
        {"more": "int seen;", "step": "seen = seen + k; n = twice(k);"},
    ),
    "what only one of the heirs does": ({}, {"step": "n = k * 2;"}),
    "an heir that has no rebec": ({"instances": ""}, {"instances": "", "step": "n = k * 2;"}),
    "a move by what a local holds": (
        {"step": "int d = 1; @Move(X + d, Y); n = k;"},
        {"step": "int d = 2; @Move(X + d, Y); n = k;"},
    ),
    "a move by other cells for one number": (
        {"step": "if (k > 0) { @Move(X + 1, Y); } else if (k < 0) { @Move(X - 1, Y); }"},
        {"step": "if (k != 0) { @Move(X + (k < 1 ? 1 : -1), Y); }"},
    ),
    "a move along the other axis": (
        {"step": "int d = 1; @Move(X + d, Y); n = k;"},
        {"step": "int d = 1; @Move(X, Y + d); n = k;"},
    ),
    "a move to the other side": (
        {"step": "@Move(X + k, Y);"},
        {"step": "@Move(X - k, Y);"},
    ),
    "a move before what is stored": (
        {"step": "n = n + 1; @Move(X + n, Y);"},
        {"step": "@Move(X + n, Y); n = n + 1;"},
    ),
    "a move by a constant instead of its value": (
        {"step": "@Move(X + STEP, Y);"},
        {"step": "@Move(X + 1, Y);"},
    ),
    "a move under another condition": (
        {"step": "if (k > 0) { @Move(X + 1, Y); }"},
        {"step": "if (k >= 0) { @Move(X + 1, Y); }"},
    ),
    "what is asserted instead of a move": (
        {"step": "@Move(X + 1, Y); n = k;"},
        {"step": 'assertion(true, "@Move(X + 1, Y)"); n = k;'},
    ),
    "a variable on which something depends": (
        {},
        {"more": "int seen;", "step": "seen = seen + k; n = seen;"},
    ),
    "a variable that the model alone has": (
        {"more": "int seen;", "step": "seen = seen + k; n = twice(k);"},
        {},
    ),
    "a renamed method": (
        {"step": "store(k);", "methods": "void store(int v) { n = twice(v); }"},
        {"step": "keep(k);", "methods": "void keep(int v) { n = twice(v); }"},
    ),
    "another queue": ({"methods": ""}, {"instances": "Fast fast():(); Fast other():();"}),
}


@pytest.mark.parametrize("name", SAME)
def test_what_is_only_written_otherwise(name: str) -> None:
    assert _left_over(*SAME[name]) == 0


@pytest.mark.parametrize("name", DIFFERENT)
def test_what_may_be_something_else(name: str) -> None:
    assert _left_over(*DIFFERENT[name]) > 0


def _bounded(case: dict[str, str]) -> int:
    text = BOUNDED["model"]["text"]
    others = case["other"], case.get("other_right", case["other"])
    bodies = zip((case["left"], case["right"]), others, strict=True)
    return _left_over_of(*(text.replace("GO", g).replace("OTHER", o) for g, o in bodies))


@pytest.mark.parametrize("case", BOUNDED["same"], ids=lambda case: str(case["name"]))
def test_what_is_the_same_within_the_bounds_that_a_class_keeps(case: dict[str, str]) -> None:
    assert _bounded(case) == 0


@pytest.mark.parametrize("case", BOUNDED["different"], ids=lambda case: str(case["name"]))
def test_what_bounds_do_not_make_the_same(case: dict[str, str]) -> None:
    assert _bounded(case) > 0
