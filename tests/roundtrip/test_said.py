"""What is said of a difference tells the two sides apart, as a stranger reads it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.difference import explain
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.verdict.drift import Mover
from rebsync.roundtrip.verdict.report.movers import change_of_mover
from rebsync.roundtrip.verdict.wiring.facts import _change
from rebsync.source import Source

MODEL = """\
env int {env} = 4;
reactiveclass R(3) {{
  statevars {{ int x; int {state}; }}
  R() {{ self.go(1); }}
  msgsrv go(int {parameter}) {{
    {body}
    if (d < shortest) {{ x = d; }}
  }}
}}
main {{ R r():(); }}
"""
LOCAL = "int shortest = 9;\n    int d = x;"
USED = {"env": "e", "state": "s", "parameter": "p"}
SIDES = {
    "local": MODEL.format(**USED, body=LOCAL),
    "state": MODEL.format(**(USED | {"state": "shortest"}), body="int d = x;"),
    "env": MODEL.format(**(USED | {"env": "shortest"}), body="int d = x;"),
    "parameter": MODEL.format(**(USED | {"parameter": "shortest"}), body="int d = x;"),
    "inner": MODEL.format(
        **USED,
        body="int d = x;\n    if (x > 3) { int shortest = 9; d = shortest; }\n"
        "    int shortest = 10;",
    ),
}
PAIRS = [(a, b) for a in SIDES for b in SIDES if a != b]


def given(name: str) -> SourcedModel:
    source = Source(f"{name}.rebeca", SIDES[name])
    parsed = parse_model(source)
    assert parsed.ok
    return SourcedModel(parsed.model, source)


def said(one: str, other: str) -> Iterator[str]:
    for difference in compare(given(one), given(other)).differences:
        yield from (change_of_mover(difference, mover) for mover in Mover)
        yield explain(difference)


@pytest.mark.parametrize(("one", "other"), PAIRS)
def test_nothing_changes_from_something_to_the_same(one: str, other: str) -> None:
    texts = list(said(one, other))
    for text in texts:
        for words in (" changed from ", " is "):
            old, _, new = text.partition(words)[2].partition(" to " if "from" in words else ", ")
            assert not old or old != new, text
    alike = [t for t in texts if "shortest being" in t or "written alike" in t]
    assert alike or {one, other} == {"env", "state"}, texts


@pytest.mark.parametrize(
    ("old", "new", "wanted"),
    [
        ({"generated"}, set(), "is gone"),
        ({"there"}, set(), "is gone"),
        (set(), {"included"}, "is new"),
        (set(), {"a/b"}, "is new: a/b"),
        ({"a/b"}, set(), "is gone; it was a/b"),
        ({"1.0"}, {"0.5"}, "is 0.5; it was 1.0"),
    ],
)
def test_a_fact_is_said_in_plain_words(old: set[str], new: set[str], wanted: str) -> None:
    assert _change("parameter", old, new) == wanted


def test_of_a_function_only_what_is_otherwise_is_said() -> None:
    assert _change("set-up", {"a; b"}, {"a; c"}) == "is with c; it was with b"
    assert _change("set-up", {"a; b"}, {"a"}) == "is without b"
    assert _change("set-up", {"a"}, {"a; b"}) == "is with b as well"
    assert _change("set-up", {"a; b"}, set()) == "is without a and b"
