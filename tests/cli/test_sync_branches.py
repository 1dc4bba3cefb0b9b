"""Two branches of a real repository that both were brought in step, and are merged."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from rebsync.cli import main
from tests.cli.test_check import SOURCE, made, package, replace, snapshot
from tests.cli.test_sync import git

__all__ = ["made", "package"]  # fixtures

MANIFEST = Path("patrol/.rebsync/manifest.json")
Branch = Callable[[], None]


@pytest.fixture
def merge(package: Path, capsys: pytest.CaptureFixture[str]) -> Callable[[Branch, Branch], str]:
    """Commits what two branches do to a package, each with a sync, and merges them.

    Gives what `rebsync check` says then; the manifest is in conflict.
    """

    def run(ours: Branch, theirs: Branch) -> str:
        git("init", "-q", "-b", "ours")
        Path(".gitignore").write_text(".cache\n")
        git("add", "-A")
        git("commit", "-q", "-m", "all")
        git("checkout", "-q", "-b", "theirs")
        _committed(theirs)
        git("checkout", "-q", "ours")
        _committed(ours)
        with pytest.raises(subprocess.CalledProcessError):
            git("merge", "-q", "theirs")
        assert "<<<<<<< " in MANIFEST.read_text()
        capsys.readouterr()
        assert main(["check"]) == 2
        return capsys.readouterr().out

    return run


def _committed(branch: Branch) -> None:
    branch()
    assert main(["sync"]) == 0
    git("commit", "-q", "-a", "-m", "more")


def model_changes() -> None:
    replace("patrol.rebeca", "n > 3", "n > 2")


def code_changes() -> None:
    replace(SOURCE, "(x_ + 1) % 4", "(x_ + 1) % 9")
    replace(SOURCE, "  x_ = x0;", "  x_ = x0;  // slow")


def code_changes_too() -> None:
    replace(SOURCE, "  on_ = n > 3;", "  on_ = n > 7;  // late")


def conflicts() -> list[str]:
    return sorted(set(git("diff", "--name-only", "--diff-filter=U").split()))


@pytest.mark.parametrize("ours", [model_changes, code_changes_too])
def test_a_sync_puts_both_together(merge: Callable[[Branch, Branch], str], ours: Branch) -> None:
    told = merge(ours, code_changes)
    assert f"{MANIFEST}:" in told
    assert "RS966 a merge left a conflict here" in told
    assert "hint: `rebsync sync` puts both sides together" in told
    assert conflicts() == [str(MANIFEST)]
    before = Path(SOURCE).read_bytes(), Path("patrol.rebeca").read_bytes()
    assert main(["sync"]) == 0
    assert (Path(SOURCE).read_bytes(), Path("patrol.rebeca").read_bytes()) == before
    assert b"// slow" in before[0]
    git("commit", "-q", "-a", "-m", "merged")
    assert main(["check"]) == 0
    replace("patrol.rebeca", "% 9", "% 8")  # what was last in step is known
    assert main(["sync"]) == 0
    assert "% 8;" in Path(SOURCE).read_text()
    assert "// slow" in Path(SOURCE).read_text()


def test_a_conflict_of_the_model_comes_first(
    merge: Callable[[Branch, Branch], str], capsys: pytest.CaptureFixture[str]
) -> None:
    merge(model_changes, code_changes_too)
    assert "patrol.rebeca" in conflicts()
    before = snapshot(Path())
    assert main(["sync"]) == 2
    assert "patrol.rebeca:" in capsys.readouterr().err
    assert snapshot(Path()) == before
    for file in ("patrol.rebeca", SOURCE):
        git("checkout", "-q", "--theirs", file)
    assert main(["sync"]) == 0
    assert "n > 7" in Path("patrol.rebeca").read_text()
    assert "// late" in Path(SOURCE).read_text()
    git("commit", "-q", "-a", "-m", "merged")
    assert main(["check"]) == 0


def test_sides_that_do_not_fit_are_left_to_people(
    merge: Callable[[Branch, Branch], str], capsys: pytest.CaptureFixture[str]
) -> None:
    merge(model_changes, code_changes)
    MANIFEST.write_text(MANIFEST.read_text().replace("=======\n", "=======\n]\n"))
    before = snapshot(Path())
    assert main(["sync"]) == 2
    assert "RS966" in capsys.readouterr().err
    assert snapshot(Path()) == before
