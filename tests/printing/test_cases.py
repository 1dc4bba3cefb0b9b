"""`cases/NAME.in.rebeca` is laid out as `cases/NAME.out.rebeca`.

`python -m tests.printing.test_cases` writes the expected files anew.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.grammars.formatting import format_text

CASES = sorted((Path(__file__).parent / "cases").glob("*.in.rebeca"))


def expected_path(case: Path) -> Path:
    """The file with the expected text of a case."""
    return case.with_name(case.name.replace(".in.", ".out."))


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name.partition(".")[0])
def test_layout(case: Path) -> None:
    text = case.read_text(encoding="utf-8")
    expected = expected_path(case).read_text(encoding="utf-8")
    assert format_text(text) == expected
    assert format_text(expected) == expected
    assert format_text(text.replace("\n", "\r\n")) == expected.replace("\n", "\r\n")


def test_a_formatted_model_is_left_alone() -> None:
    text = (Path(__file__).parent / "cases" / "already_formatted.in.rebeca").read_text()
    assert format_text(text) == text


def test_the_last_line_end_is_added() -> None:
    assert format_text("main {}") == "main {}\n"


if __name__ == "__main__":
    for each in CASES:
        expected_path(each).write_text(format_text(each.read_text()), encoding="utf-8")
