"""`cases/NAME.left.rebeca` and `NAME.right.rebeca` differ as `NAME.txt` says, at both depths.

`edits.txt` says the same of edits by hand of generated code (tests/reverse/edits.toml).
`python -m tests.roundtrip.differences.test_cases` writes what is expected anew.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from rebsync.files import read_source
from rebsync.grammars.parser import parse_model
from rebsync.reverse.findings import Grade
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.difference import Depth, Place
from rebsync.roundtrip.diff.operands import SourcedModel, UnreadPlace
from rebsync.roundtrip.diff.report import lines
from rebsync.source import Source
from tests.reverse.laws import extracted
from tests.reverse.test_edits import BY_NAME, EDITS, LISTED, edited
from tests.reverse.test_laws import EXAMPLES, package_of

HERE = Path(__file__).parent
CASES = sorted((HERE / "cases").glob("*.left.rebeca"))
ALL_EDITS = {**EDITS, **LISTED}


def read_model(path: Path) -> SourcedModel:
    text = read_source(str(path)).text
    source = Source(path.name.replace(".left.", ".").replace(".right.", "."), text)
    parsed = parse_model(source)
    assert not parsed.diagnostics
    return SourcedModel(parsed.model, source)


def read_code(files: dict[str, str]) -> SourcedModel:
    found = extracted(files)
    unread = tuple(
        UnreadPlace(Place(f.source, f.span), f.why, f.within)
        for f in found.findings
        if f.grade is Grade.UNREADABLE
    )
    return SourcedModel(found.model, Source("code", ""), unread)


def told(case: Path) -> str:
    """The differences of a case at both depths."""
    sides = read_model(case), read_model(case.with_name(case.name.replace(".left.", ".right.")))
    texts = []
    for depth in Depth:
        found = "".join(f"{line}\n" for line in lines(compare(*sides, depth)))
        texts.append(f"--- {depth.value}\n{found}")
    return "".join(texts)


def told_of_edit(name: str) -> str:
    """The differences between the model of an example and its edited code."""
    edit = ALL_EDITS[name]
    example = BY_NAME[edit["example"]]
    model = read_model(example / f"{example.name}.rebeca")
    comparison = compare(model, read_code(edited(edit)))
    return "".join(f"{line}\n" for line in lines(comparison))


def expected_edits() -> dict[str, str]:
    """What is expected of each edit."""
    parts = (HERE / "edits.txt").read_text(encoding="utf-8").split("--- ")[1:]
    return {name: rest for name, _, rest in (part.partition("\n") for part in parts)}


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name.partition(".")[0])
def test_differences(case: Path) -> None:
    expected = case.with_name(case.name.replace(".left.rebeca", ".txt"))
    assert told(case) == expected.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ALL_EDITS)
def test_edits(name: str) -> None:
    assert told_of_edit(name) == expected_edits()[name]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.name)
def test_what_was_generated_has_no_differences(example: Path) -> None:
    model = read_model(example / f"{example.name}.rebeca")
    assert compare(model, read_code(package_of(example))).is_empty


def texts() -> Iterator[tuple[Path, str]]:
    for case in CASES:
        yield case.with_name(case.name.replace(".left.rebeca", ".txt")), told(case)
    edits = "".join(f"--- {name}\n{told_of_edit(name)}" for name in ALL_EDITS)
    yield HERE / "edits.txt", edits


if __name__ == "__main__":
    for path, text in texts():
        path.write_text(text, encoding="utf-8")
