"""`rebsync check --behaviour`: drift that does the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from tests.cli.test_accept import CPP, replaced
from tests.cli.test_check import MODEL


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    Path("patrol.rebeca").write_text(MODEL, encoding="utf-8")
    assert main(["generate", "patrol.rebeca"]) in (0, 1)
    return Path(CPP)


@pytest.mark.parametrize(("now", "is_same"), [("n >= 4", True), ("n >= 3", False)])
def test_what_does_the_same_is_said(
    source: Path, now: str, is_same: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    replaced(source, "n > 3", now)
    capsys.readouterr()
    assert main(["check", "--behaviour"]) == 1
    first = capsys.readouterr().out.splitlines()[0]
    assert first.endswith("; same behaviour") == is_same


def test_a_bound_proves_nothing(source: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replaced(source, "n > 3", "n >= 4")
    capsys.readouterr()
    assert main(["check", "--behaviour", "--max-states", "2"]) == 1
    assert "same behaviour" not in capsys.readouterr().out
