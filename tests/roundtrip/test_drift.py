"""What somebody edits by hand in generated code gets the right verdict (tests/reverse/*.toml)."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from rebsync.reserved import RUNTIME_HEADERS
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.package.markers import elements
from rebsync.roundtrip.verdict.check import check
from rebsync.roundtrip.verdict.drift import Verdict
from rebsync.roundtrip.verdict.result import CheckResult
from tests.reverse.test_edits import BY_NAME, EDITS, LISTED, edited

# These differ in parentheses without a meaning.
SAME = frozenset({"constants_extracted", "enumeration_in_another_header", "lambda_for_a_port"})


def test_run_time_headers_are_known() -> None:
    """The headers that are the same for every model, but for the name of the package."""
    found = set()
    for name, example in BY_NAME.items():
        for path in (example / name / "include" / name).iterdir():
            if not list(elements(path.read_text(encoding="utf-8"))):
                found.add(path.stem)
    missing = {"actions", "clients", "lifecycle", "services"}  # which no example has
    assert found == set(RUNTIME_HEADERS) - missing


def checked(example: str, files: dict[str, str], folder: Path) -> CheckResult:
    """The verdict on an example when its package has these files."""
    shutil.copytree(BY_NAME[example], folder / example)
    for path, text in files.items():
        target = folder / example / example / path
        target.parent.mkdir(exist_ok=True)
        target.write_text(text, encoding="utf-8")
    (package,) = find([str(folder / example)])
    return check(package)


def told(found: CheckResult) -> list[str]:
    return [d.message for f in found.findings for d in f.diagnostics]


@pytest.mark.parametrize("name", EDITS)
def test_edits_are_the_code_ahead(name: str, tmp_path: Path) -> None:
    edit = EDITS[name]
    found = checked(edit["example"], edited(edit), tmp_path)
    is_proved = edit.get("alike", False)
    assert all("does the same" in each for each in told(found)), told(found)
    assert bool(told(found)) is is_proved
    assert found.drift is not None
    is_same = is_proved or name in SAME or not (edit["model"] or edit.get("copied"))
    wanted = Verdict.IN_STEP if is_same else Verdict.CODE_AHEAD
    assert found.drift.verdict is wanted, found.drift.differences


@pytest.mark.parametrize("name", LISTED)
def test_what_cannot_be_told_is_undetermined(name: str, tmp_path: Path) -> None:
    edit = LISTED[name]
    found = checked(edit["example"], edited(edit), tmp_path)
    assert len(told(found)) >= len(edit["listed"])
    assert found.drift is not None
    assert found.drift.verdict is Verdict.UNDETERMINED, told(found)
