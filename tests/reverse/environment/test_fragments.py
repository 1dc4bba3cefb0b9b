"""Environments that people write: what is answered with them, and what is wrong with them."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest

from rebsync.cli import main
from rebsync.cli.packages import read_question
from rebsync.diagnostics import RebsyncError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_HERE = Path(__file__).parent
_CASES: dict[str, dict[str, Any]] = tomllib.loads(
    (_HERE / "fragments.toml").read_text(encoding="utf-8")
)
_ASKED = [
    (name, package, question, verdict)
    for name, case in _CASES.items()
    for package in case["packages"]
    for question, verdict in case.get("ask", {}).items()
]


def _written(name: str, into: Path) -> str:
    path = into / f"{name}.rebeca"
    path.write_text(_CASES[name]["text"], encoding="utf-8")
    return str(path)


def _package(name: str) -> str:
    return str(_HERE / "cases" / name / "package")


@pytest.mark.parametrize(("name", "package", "question", "verdict"), _ASKED)
def test_what_comes_from_outside_is_what_a_file_says(
    name: str,
    package: str,
    question: str,
    verdict: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    environment = _written(name, tmp_path)
    main(["ask", _package(package), question, "--environment", environment, "--format", "json"])
    out, err = capsys.readouterr()
    found = json.loads(out)
    assert found["verdict"] == verdict, (found["reason"], err)
    assert any(f"as {environment} says" in c for c in found["caveats"])


@pytest.mark.parametrize("name", [n for n, case in _CASES.items() if "mistake" in case])
def test_what_is_wrong_with_a_file_is_said_with_its_place(name: str, tmp_path: Path) -> None:
    (package,) = _CASES[name]["packages"]
    question = _QUESTIONS.get(package, "never stopped.data")
    with pytest.raises(RebsyncError) as caught:
        read_question(_package(package), question, _written(name, tmp_path))
    (findings,) = caught.value.findings
    (mistake,) = findings.diagnostics
    place = findings.source.position(mistake.span.start)
    told = f"{place.line}:{place.column} {mistake.code} {mistake.message}; {mistake.hint or ''}"
    assert told == _CASES[name]["mistake"]


# A question that a package can be asked, where that is not the usual one.
_QUESTIONS = {
    "twins": "never left/heard.data",
    "texts_rclpy": 'never status.data == "done"',
}
