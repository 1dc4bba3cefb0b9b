"""What runs in programs of both languages is among what the analyses say that may run."""

from __future__ import annotations

from contextlib import suppress
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.reverse.libraries.routines import Language
from tests.reverse.ir import cpp_running, running, test_cpp, test_python
from tests.reverse.ir.cpp_drawing import text_of
from tests.reverse.ir.drawing import module_text
from tests.reverse.ir.memory import Thrown
from tests.reverse.ir.objects import ObjectInterpreter
from tests.reverse.ir.tracing import Reach, Tracer


class CppTracer(Tracer, ObjectInterpreter):
    """Notes what runs while functions with objects and references do."""


def _missed_in_python(text: str) -> list[tuple[str, str]]:
    tracer = Tracer(running.program_of(text))
    running.by_form(text, tracer)
    return list(Reach(tracer.program, Language.PYTHON).missed(tracer))


def _missed_in_cpp(text: str) -> list[tuple[str, str]]:
    tracer = CppTracer(cpp_running.program_of(text))
    tracer.module(cpp_running.FILE)
    with suppress(Thrown):
        tracer.call("run")
    return list(Reach(tracer.program, Language.CPP).missed(tracer))


@pytest.mark.parametrize("name", test_python.CASES)
def test_what_runs_in_a_case_of_python_may_run(name: str) -> None:
    assert not _missed_in_python(test_python.CASES[name])


@given(st.randoms(use_true_random=False))
def test_what_runs_in_drawn_modules_may_run(random: Random) -> None:
    text = module_text(random)
    assume(text is not None)
    assert text is not None
    assume(running.is_short(text))
    assert not _missed_in_python(text)


@pytest.mark.parametrize("name", test_cpp.CASES)
def test_what_runs_in_a_case_of_cpp_may_run(name: str) -> None:
    assert not _missed_in_cpp(test_cpp.CASES[name])


@settings(max_examples=10, deadline=None)
@given(st.randoms(use_true_random=False))
def test_what_runs_in_drawn_texts_of_cpp_may_run(random: Random) -> None:
    assert not _missed_in_cpp(text_of(random))
