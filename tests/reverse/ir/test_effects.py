"""The effects of functions: what runs is among them, and directed cases are found exactly."""

from __future__ import annotations

import sys
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rebsync.reverse.analysis.effects import EffectAnalysis
from rebsync.reverse.analysis.locations import Elements, Location
from tests.reverse.ir.drawing import module_text
from tests.reverse.ir.running import MODULE, by_form, is_short, program_of
from tests.reverse.ir.test_python import CASES
from tests.reverse.ir.tracing import TABLE, Tracer, unsound

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_DIRECTED: dict[str, Any] = tomllib.loads(
    (Path(__file__).parent / "effects.toml").read_text("utf-8")
)


@pytest.mark.parametrize("name", _DIRECTED)
def test_effects(name: str) -> None:
    case = _DIRECTED[name]
    analysis = EffectAnalysis(program_of(case["code"], ""), TABLE.get)
    found = analysis.of(f"{MODULE}:{case['function']}")
    assert found.anything == case.get("anything", False), found.why
    if not found.anything:
        assert _names(found.writes) == sorted(case["writes"])
        assert _names(found.reads) == sorted(case["reads"])
        assert sorted(found.acts) == case.get("acts", [])


def _names(locations: frozenset[Location]) -> list[str]:
    return sorted({_name(location) for location in locations})


def _name(location: Location) -> str:
    if isinstance(location, Elements):
        return "[]"
    return location.name or "*"


def _assert_sound(text: str) -> None:
    tracer = Tracer(program_of(text))
    by_form(text, tracer)
    assert tracer.seen
    assert not unsound(tracer)


@pytest.mark.parametrize("name", CASES)
def test_what_a_case_does_is_among_its_effects(name: str) -> None:
    _assert_sound(CASES[name])


@given(st.randoms(use_true_random=False))
def test_what_drawn_modules_do_is_among_their_effects(random: Random) -> None:
    text = module_text(random)
    assume(text is not None)
    assert text is not None
    assume(is_short(text))
    _assert_sound(text)
