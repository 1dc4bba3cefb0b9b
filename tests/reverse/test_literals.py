"""Numbers and texts as C++ writes them, against a compiler's answers."""

from __future__ import annotations

import subprocess
from fractions import Fraction
from pathlib import Path

import pytest

from rebsync.reverse.syntax.cpp_numerals import numeral, whole_number
from rebsync.reverse.syntax.cpp_texts import unescaped

WHOLE = {
    "0": 0,
    "7": 7,
    "010": 8,
    "0x1F": 31,
    "0XabcdULL": 0xABCD,
    "0b1010": 10,
    "1'000'000": 1_000_000,
    "42u": 42,
    "42LU": 42,
    "0xFFFFFFFFFFFFFFFF": (1 << 64) - 1,
    "- 5": -5,
}
REAL = {
    "1.5": Fraction(3, 2),
    ".1": Fraction(1, 10),
    "2.f": Fraction(2),
    "-24e-1": Fraction(-12, 5),
    "1E3F": Fraction(1000),
    "010.5": Fraction(21, 2),
    "0x1.8p1": Fraction(3),
    "0xAp-1": Fraction(5),
    "1.0e1L": Fraction(10),
}
TEXTS = {
    r"a\n\t\r\a\b\f\v": "a\n\t\r\a\b\f\v",
    r"\x41\101\'\"\?\\": "AA'\"?\\",
    r"\0": "\0",
    r"\u00e9\U0001F600": "\u00e9\U0001f600",
    "two \\\nlines": "two lines",
}
UNKNOWN = (r"\xe9", r"\377", r"\q", r"\u12", r"\N{DIGIT ONE}")
_SAME = """
template <unsigned N>
constexpr bool same(const char (&text)[N], const unsigned char (&bytes)[N - 1]) {
  for (unsigned i = 0; i + 1 < N; ++i) {
    if (static_cast<unsigned char>(text[i]) != bytes[i]) return false;
  }
  return true;
}
"""
NONE = ("", "08", "0x", "0b2", "5f", "1j", "1.2.3", "0x1.8", "1e999", "abc", "1llu2", "--1")


@pytest.mark.parametrize("text", WHOLE)
def test_whole_numbers(text: str) -> None:
    assert whole_number(text) == WHOLE[text]


@pytest.mark.parametrize("text", REAL)
def test_real_numbers(text: str) -> None:
    found = numeral(text)
    assert found is not None
    assert (found.whole, found.exact, found.value) == (None, REAL[text], float(REAL[text]))


@pytest.mark.parametrize("text", NONE)
def test_what_is_no_number(text: str) -> None:
    assert numeral(text) is None


@pytest.mark.parametrize("text", TEXTS)
def test_texts(text: str) -> None:
    assert unescaped(text) == TEXTS[text]


@pytest.mark.parametrize("text", UNKNOWN)
def test_texts_that_are_not_known(text: str) -> None:
    assert unescaped(text) is None


def test_a_compiler_agrees(tmp_path: Path) -> None:
    """Literals without a sign, of which a program asserts the values."""
    wholes = [
        f"static_assert({text} == {value}ULL);" for text, value in WHOLE.items() if value >= 0
    ]
    reals = [
        f"static_assert({text} == {value.numerator}.0 / {value.denominator});"
        for text, value in REAL.items()
    ]
    texts = [
        f'static_assert(same("{text}", {{{", ".join(map(str, meant.encode()))}}}));'
        for text, meant in TEXTS.items()
    ]
    file = tmp_path / "literals.cpp"
    file.write_text("\n".join([_SAME, *wholes, *reals, *texts]) + "\n")
    done = subprocess.run(["g++", "-std=c++17", "-fsyntax-only", str(file)], capture_output=True)
    assert done.returncode == 0, done.stderr.decode()
