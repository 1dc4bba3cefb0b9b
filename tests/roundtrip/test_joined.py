"""How nodes are joined: who reaches whom counts, not how topics are called (joined.toml)."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Any

import pytest

from rebsync.roundtrip.diff.difference import explain
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.verdict.check import check
from tests.reverse.test_edits import BY_NAME

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

CASES: dict[str, Any] = tomllib.loads(
    Path(__file__).with_name("joined.toml").read_text(encoding="utf-8")
)


@pytest.mark.parametrize("name", CASES)
def test_who_is_joined_counts(name: str, tmp_path: Path) -> None:
    case = CASES[name]
    example = case["example"]
    shutil.copytree(BY_NAME[example], tmp_path / example)
    for path, old, new in case["edits"]:
        file = tmp_path / example / example / path
        text = file.read_text(encoding="utf-8")
        assert old in text, (path, old)
        file.write_text(text.replace(old, new), encoding="utf-8")
    (package,) = find([str(tmp_path / example)])
    found = check(package)
    assert found.drift is not None
    assert found.drift.verdict.value == case["verdict"], found.findings
    told = [f"{d.element}: {explain(d)}" for d, _ in found.drift.differences]
    assert len(told) == len(case.get("told", [])), told
    assert all(each in "\n".join(told) for each in case.get("told", [])), told
    assert all(d.left and d.right for d, _ in found.drift.differences)
    is_open = case["verdict"] == "undetermined" or case.get("is_in_no_model", False)
    assert bool(found.findings) == is_open
