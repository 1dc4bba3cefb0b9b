"""What is asked of ROS, in small pieces of code whose comments say it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.source import Source
from tests.reverse.graph.notation import noted

CASES = Path(__file__).parent / "cases"
_SAID = re.compile(r"//= *(.*?) *$")


def _cases() -> list[Path]:
    """Each file is a case, and each folder."""
    return sorted(CASES.iterdir())


def _files(case: Path) -> dict[str, str]:
    paths = [case] if case.is_file() else sorted(p for p in case.rglob("*") if p.is_file())
    return {p.relative_to(CASES).as_posix(): p.read_text(encoding="utf-8") for p in paths}


def _said(files: dict[str, str]) -> list[str]:
    """The facts that comments say, those of one line split by `//=` again."""
    found = []
    for path, text in files.items():
        for number, line in enumerate(text.splitlines(), 1):
            for said in line.split("//=")[1:]:
                found.append(f"{path}:{number}: {said.strip()}")
    return found


@pytest.mark.parametrize("case", _cases(), ids=lambda p: p.stem)
def test_what_is_found_is_what_the_comments_say(case: Path) -> None:
    files = _files(case)
    code = Code.of(parse(Source(path, text)) for path, text in files.items())
    found = [
        f"{f.site.place.source.path}:{f.site.place.line}: {noted(f)}"
        for f in Asking(code).graph.facts
    ]
    assert found == _said(files)
