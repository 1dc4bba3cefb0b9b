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


@pytest.mark.parametrize(("now", "is_same"), [("n > 4", True), ("n >= 3", False)])
def test_what_does_the_same_is_said(
    source: Path, now: str, is_same: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    replaced(source, "n > 3", now)
    capsys.readouterr()
    assert main(["check", "--behaviour"]) == 1
    first = capsys.readouterr().out.splitlines()[0]
    assert first.endswith("; same behaviour") == is_same


def test_a_bound_proves_nothing(source: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replaced(source, "n > 3", "n > 4")
    capsys.readouterr()
    assert main(["check", "--behaviour", "--max-states", "2"]) == 1
    assert "same behaviour" not in capsys.readouterr().out


def test_what_is_proved_of_each_body_is_in_step(
    source: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    replaced(source, "n > 3", "n >= 4")
    capsys.readouterr()
    assert main(["check"]) == 0
    told = capsys.readouterr().out
    assert "patrol: in step\n" in told
    assert "RS970 msgsrv Robot.go is written otherwise than in the model" in told
    assert main(["check", "--depth", "identical"]) == 1
    assert main(["sync"]) == 0
    assert "on = n > 3;" in Path("patrol.rebeca").read_text(encoding="utf-8")
    assert "n >= 4" in source.read_text(encoding="utf-8")
    assert main(["check"]) == 0


def test_what_is_proved_does_not_hide_what_is_not(
    source: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    replaced(source, "n > 3", "n >= 4")
    replaced(source, "x_ + 1", "x_ + 2")
    capsys.readouterr()
    assert main(["check"]) == 1
    told = capsys.readouterr().out
    assert "msgsrv Robot.look" in told
    assert "the code is ahead" in told


def test_the_model_moves_on_while_the_code_is_written_otherwise(
    source: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    replaced(source, "n > 3", "n >= 4")
    replaced(Path("patrol.rebeca"), "(x + 1) % 4", "(x + 1) % 5")
    capsys.readouterr()
    assert main(["check"]) == 1
    assert "patrol: the model is ahead" in capsys.readouterr().out
    assert main(["sync"]) == 0
    assert "n >= 4" in source.read_text(encoding="utf-8")
    assert "% 5" in source.read_text(encoding="utf-8")
    assert main(["check"]) == 0


def test_a_delay_by_a_local_is_in_step(source: Path) -> None:
    replaced(source, "mailbox_.delay(1);", "const int32_t pause = 1;\n  mailbox_.delay(pause);")
    assert main(["check"]) == 0
