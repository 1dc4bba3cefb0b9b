"""Pipes and devices that git would wait for, and git that does not end."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from tests.cli.test_check import SOURCE, made, package, replace
from tests.security.hostile import Run, git, unchecked
from tests.security.test_git import run

__all__ = ["made", "package", "run"]  # fixtures


PIPES = (
    ".git",
    ".git/HEAD",
    ".git/config",
    ".git/index",
    ".git/packed-refs",
    ".git/commondir",
    ".git/refs/heads/other",
    ".git/objects/info/alternates",
    ".git/objects/pack/pack-1.idx",
    "HEAD",
    "apart/refs/heads/other",
    "apart/objects/12/3456",
)


@pytest.mark.timeout(60)
@pytest.mark.parametrize("kind", ["pipe", "link to a pipe"])
@pytest.mark.parametrize("place", PIPES)
def test_a_pipe_that_git_would_read(
    run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, place: str, kind: str
) -> None:
    """git would wait for it, until it is given up."""
    monkeypatch.setattr("subprocess.Popen", None)
    apart = Path("apart")
    shutil.copytree(".git", apart)
    if place.startswith("apart/refs"):
        shutil.rmtree(".git")
        Path(".git").write_text("gitdir: apart\n")
    elif place.startswith("apart"):
        Path(".git/objects/info/alternates").write_text("../../apart/objects\n")
    pipe = Path(place)
    if pipe.is_dir():
        shutil.rmtree(pipe)
    pipe.unlink(missing_ok=True)
    pipe.parent.mkdir(exist_ok=True)
    os.mkfifo(pipe if kind == "pipe" else tmp_path / "pipe")
    if kind != "pipe":
        pipe.symlink_to(tmp_path / "pipe")
    unchecked()
    if place == "HEAD":
        shutil.rmtree(".git")
    status, shown = run("diff", "HEAD^:patrol.rebeca", "HEAD^:patrol")
    assert (status, "RS814 this is a pipe" in shown) == (2, True), shown


@pytest.mark.timeout(60)
def test_git_that_does_not_end(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A configuration may include another: no one but git knows which."""
    os.mkfifo(tmp_path / "pipe")
    with Path(".git/config").open("a") as file:
        file.write(f"[include]\n\tpath = {tmp_path}/pipe\n")
    monkeypatch.setattr("rebsync.git._PATIENCE", 1.0)
    status, shown = run("diff", "HEAD:patrol.rebeca", "HEAD:patrol")
    assert (status, "has not ended within" in shown) == (2, True)
    replace(SOURCE, "n > 3", "n > 5")
    replace("patrol.rebeca", "n > 3", "n >= 4")
    assert run("sync")[0] == 1


@pytest.mark.timeout(60)
def test_objects_that_do_not_come(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Somebody puts a pipe in their place once all was looked at."""
    monkeypatch.setattr("rebsync.git._MOST_OF_ALL", 1.0)
    monkeypatch.setattr("rebsync.git.refuse_special_files", lambda *_: None)
    blob = git("rev-parse", "HEAD:patrol.rebeca")
    path = Path(".git/objects", blob[:2], blob[2:])
    path.unlink()
    os.mkfifo(path)
    status, shown = run("diff", "HEAD:patrol.rebeca", "HEAD:patrol")
    assert (status, "RS806" in shown) == (2, True), shown


def test_repositories_without_pipes(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    git("worktree", "add", "-q", str(tmp_path / "more"))
    git("clone", "-q", "--shared", ".", str(tmp_path / "shared"))
    for each in ("more", "shared"):
        monkeypatch.chdir(tmp_path / each)
        assert run("diff", "HEAD:patrol.rebeca", "HEAD:patrol")[0] == 0
