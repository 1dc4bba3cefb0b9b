"""A generated program that nobody can start any more is told of, whatever its text says."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from tests.cli.test_check import MODEL

PROGRAM = Path("patrol/scripts/robot_node")


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current directory, with a model and its package in Python for ROS 1."""
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    Path("patrol.rebeca").write_text(MODEL, encoding="utf-8")
    assert main(["generate", "patrol.rebeca", "--target", "ros1-py"]) in (0, 1)
    return tmp_path


def test_a_program_that_lost_its_bit_is_told(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert PROGRAM.stat().st_mode & 0o111
    PROGRAM.chmod(0o644)
    assert main(["check"]) == 4
    assert f"{PROGRAM}: RS956 this program is not executable" in capsys.readouterr().out
    assert main(["sync"]) == 4
    PROGRAM.chmod(0o755)
    assert main(["check"]) == 0
