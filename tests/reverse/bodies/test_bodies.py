"""Bodies that people write become the servers that stand beside them (cases/NAME.expected)."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.files import read_source
from tests.reverse.bodies.reading import CASES, mistakes, read_case, told


@pytest.mark.parametrize("case", sorted(CASES.glob("*.cpp")), ids=lambda p: p.stem)
def test_bodies(case: Path) -> None:
    source = read_source(str(case))
    assert told(source) == case.with_suffix(".expected").read_text(encoding="utf-8")
    assert mistakes(read_case(source)[0]) == []
