"""What somebody edits in a week, and what check and sync say of it (week.toml)."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from rebsync.cli import main
from tests.reverse.test_edits import BY_NAME

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

CASES: dict[str, Any] = tomllib.loads(
    Path(__file__).with_name("week.toml").read_text(encoding="utf-8")
)


def edit(root: Path, case: dict[str, Any]) -> None:
    for path, text in case.get("added", []):
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text, encoding="utf-8")
    for path, old, new in case.get("edits", []):
        text = (root / path).read_text(encoding="utf-8")
        assert old in text, (path, old)
        (root / path).write_text(text.replace(old, new), encoding="utf-8")
    for old, new in case.get("moved", []):
        (root / new).parent.mkdir(parents=True, exist_ok=True)
        (root / old).rename(root / new)
    if "everywhere" in case:
        old, new = case["everywhere"]
        for file in (root / new).rglob("*"):
            if file.is_file() and ".rebsync" not in file.parts:
                text = file.read_text(encoding="utf-8")
                text = text.replace(old, new).replace(old.upper(), new.upper())
                file.write_text(text, encoding="utf-8")


@pytest.mark.parametrize("name", CASES)
def test_what_is_said(
    name: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    case = CASES[name]
    root = tmp_path / "warehouse"
    shutil.copytree(BY_NAME["warehouse"], root)
    subprocess.run(["git", "init", "-q", str(root)], check=True)
    edit(root, case)
    monkeypatch.chdir(root)
    first = main(["check"])
    out = capsys.readouterr().out
    assert out.startswith(case["shown"].lstrip("\n")), out
    assert [first, main(["sync"]), main(["check"])] == case["status"], capsys.readouterr()
