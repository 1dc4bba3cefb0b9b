"""C++ lowered to the form does what g++ makes of it: cases of `cpp_cases/*.toml`, run by both."""

from __future__ import annotations

import sys
from pathlib import Path
from random import Random

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import statements
from tests.reverse.ir.cpp_drawing import text_of
from tests.reverse.ir.cpp_running import by_form, natively, program_of

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

CASES = {
    name: str(case["code"])
    for path in sorted((Path(__file__).parent / "cpp_cases").glob("*.toml"))
    for name, case in tomllib.loads(path.read_text("utf-8")).items()
}


@pytest.fixture(scope="module")
def native(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[str]]:
    """What each case does, all of them compiled at once."""
    found = natively(list(CASES.values()), tmp_path_factory.mktemp("cpp"))
    return dict(zip(CASES, found, strict=True))


@pytest.mark.parametrize("name", CASES)
def test_the_form_does_what_cpp_does(name: str, native: dict[str, list[str]]) -> None:
    assert native[name] in (by_form(CASES[name]), by_form(CASES[name], is_reversed=True))


@pytest.mark.parametrize("name", CASES)
def test_everything_of_cpp_has_a_lowering(name: str) -> None:
    program = program_of(CASES[name])
    bodies = (program.function(f).body for f in program.functions)
    assert not [n for body in bodies for n in statements(body) if isinstance(n, s.Unsupported)]


@settings(max_examples=2, deadline=None, phases=(Phase.explicit, Phase.generate))
@given(seed=st.integers(0, 1 << 32))
def test_drawn_texts_of_cpp(seed: int, tmp_path_factory: pytest.TempPathFactory) -> None:
    texts = [text_of(Random(f"{seed} {number}")) for number in range(20)]
    unread = 0
    for text, found in zip(texts, natively(texts, tmp_path_factory.mktemp("cpp")), strict=True):
        try:
            assert found in (by_form(text), by_form(text, is_reversed=True)), text
        except NotImplementedError:  # the grammar takes a cast and parentheses for a call
            unread += 1
    assert unread <= 2
