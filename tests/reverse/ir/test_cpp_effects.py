"""What texts of C++ do when they run is among the effects of their functions."""

from __future__ import annotations

from contextlib import suppress
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync.reverse.analysis.library_effects import RECEIVER, LibraryEffect
from rebsync.reverse.ir.program import Program
from tests.reverse.ir.cpp_drawing import text_of
from tests.reverse.ir.cpp_running import FILE, program_of
from tests.reverse.ir.memory import Thrown
from tests.reverse.ir.objects import ObjectInterpreter
from tests.reverse.ir.standard_library import FUNCTIONS, METHODS
from tests.reverse.ir.test_cpp import CASES
from tests.reverse.ir.tracing import Tracer, unsound

_CHANGES = LibraryEffect(frozenset({RECEIVER}), calls=False)
_TABLE: dict[str, LibraryEffect] = {
    "note": LibraryEffect(acts=True, calls=False),
    **dict.fromkeys(FUNCTIONS, LibraryEffect(calls=False)),
    **dict.fromkeys(METHODS, _CHANGES),
    **{f"std::string::{name}": _CHANGES for name in ("push_back", "clear")},
}


class CppTracer(Tracer, ObjectInterpreter):
    """Notes what happens while functions with objects and references run."""


def _assert_sound(program: Program) -> CppTracer:
    tracer = CppTracer(program)
    tracer.module(FILE)
    with suppress(Thrown):
        tracer.call("run")
    assert not unsound(tracer, _TABLE.get)
    return tracer


@pytest.mark.parametrize("name", CASES)
def test_what_a_case_of_cpp_does_is_among_its_effects(name: str) -> None:
    _assert_sound(program_of(CASES[name]))


@settings(max_examples=10, deadline=None)
@given(st.randoms(use_true_random=False))
def test_what_drawn_texts_of_cpp_do_is_among_their_effects(random: Random) -> None:
    assert _assert_sound(program_of(text_of(random))).seen
