"""Python lowered to the form does what Python does: the cases of `cases/*.toml`, run by both."""

from __future__ import annotations

import sys
from pathlib import Path
from random import Random

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import statements
from tests.reverse.ir.drawing import module_text
from tests.reverse.ir.running import by_form, is_short, natively, program_of

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

CASES = {
    name: str(case["code"])
    for path in sorted((Path(__file__).parent / "cases").glob("*.toml"))
    for name, case in tomllib.loads(path.read_text("utf-8")).items()
}


@pytest.mark.parametrize("name", CASES)
def test_the_form_does_what_python_does(name: str) -> None:
    assert by_form(CASES[name]) == natively(CASES[name])


@pytest.mark.parametrize("name", CASES)
def test_everything_has_a_lowering(name: str) -> None:
    program = program_of(CASES[name])
    bodies = (program.function(f).body for f in program.functions)
    assert not [n for body in bodies for n in statements(body) if isinstance(n, s.Unsupported)]


@given(st.randoms(use_true_random=False))
def test_drawn_modules(random: Random) -> None:
    text = module_text(random)
    assume(text is not None)
    assert text is not None
    assume(is_short(text))
    assert by_form(text) == natively(text)
