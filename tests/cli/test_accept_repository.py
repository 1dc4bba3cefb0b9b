"""`rebsync accept` among colleagues: in a real repository, from one clone to another."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.cli.run import rebsync
from tests.cli.test_check import MODEL, PROPERTY

SOURCE = "patrol/src/robot.cpp"
REASON = "the board's own table says n > 3"
VERIFY = ("check", "--verify", "--max-states", "2000", "--allow", "deadlock")


def git(folder: Path, *arguments: str) -> str:
    own = ("-c", "user.name=a", "-c", "user.email=a@b.c", "-c", "commit.gpgsign=false")
    command = ["git", *own, *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return done.stdout


def commit(folder: Path, message: str) -> None:
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "-m", message)


def replace(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text, old
    path.write_text(text.replace(old, new), encoding="utf-8")


@pytest.fixture
def clones(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    """A repository with a package in step, and a clone of it by somebody with another cache."""
    mine, theirs = tmp_path / "mine", tmp_path / "theirs"
    mine.mkdir()
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "cache"))
    (mine / "patrol.rebeca").write_text(MODEL, encoding="utf-8")
    (mine / "patrol.property").write_text(PROPERTY, encoding="utf-8")
    assert rebsync("generate", "patrol.rebeca", cwd=mine).status == 0
    git(mine, "init", "-q", "-b", "main")
    commit(mine, "package")
    git(tmp_path, "clone", "-q", "mine", "theirs")
    return mine, theirs


def checked(folder: Path, cache: str) -> tuple[int, str]:
    env = {"REBSYNC_CACHE": str(folder.parent / cache)}
    found = rebsync("check", cwd=folder, env=env)
    return found.status, found.out


def test_what_one_has_accepted_the_others_have_until_it_changes(
    clones: tuple[Path, Path],
) -> None:
    mine, theirs = clones
    replace(mine / SOURCE, "  on_ = n > 3;", "  on_ = vendor::decide(n);")
    assert checked(mine, "cache")[0] == 4
    line = (mine / SOURCE).read_text().partition("vendor")[0].count("\n") + 1
    assert rebsync("accept", f"{SOURCE}:{line}", "--reason", REASON, cwd=mine).status == 0
    assert "patrol/.rebsync/accepted.toml" in git(mine, "status", "--short", "-uall")
    commit(mine, "the board decides")

    git(theirs, "pull", "-q")
    assert checked(theirs, "other") == (0, "patrol: in step, with 1 accepted\n")

    replace(theirs / SOURCE, "vendor::decide(n)", "vendor::decide(n + 1)")
    commit(theirs, "another board")
    git(mine, "pull", "-q", str(theirs), "main")
    status, said = checked(mine, "cache")
    assert status == 4
    assert "RS941" in said and "RS945" in said


def test_a_violated_property_is_not_accepted(clones: tuple[Path, Path]) -> None:
    mine, _ = clones
    replace(mine / SOURCE, "(x_ + 1) % 4", "(x_ + 1) % 5")
    line = (mine / SOURCE).read_text().partition("% 5")[0].count("\n") + 1
    refused = rebsync("accept", f"{SOURCE}:{line}", "--reason", REASON, cwd=mine)
    assert refused.status == 2 and "RS946" in refused.err
    assert git(mine, "status", "--short") == f" M {SOURCE}\n"
    assert rebsync(*VERIFY, cwd=mine).status == 3
