"""Conflicts are told to the index of the repository of the files, and to no other."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from rebsync.cli import main
from tests.cli.test_check import MODEL, SOURCE, made, package, replace
from tests.security.hostile import NAMES, Run, everything, git, runner
from tests.security.test_git import run

__all__ = ["made", "package", "run"]  # fixtures


def test_a_repository_with_longer_ids(
    package: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Objects are known by SHA-256 there, when they are read and when conflicts are told of."""
    for name, value in NAMES.items():
        monkeypatch.setenv(name, value)
    git("init", "-q", "--object-format=sha256")
    git("add", "-A")
    git("commit", "-q", "-m", "all")
    run_ = runner(capsys, monkeypatch)
    replace(SOURCE, "n > 3", "n > 5")
    status, shown = run_("diff", "HEAD:patrol", "patrol")
    assert (status, "n > 3" in shown, "n > 5" in shown) == (1, True, True), shown
    replace("patrol.rebeca", "n > 3", "n >= 4")
    assert run_("sync")[0] == 1
    listed = [line.split() for line in git("ls-files", "-u").splitlines()]
    assert [(len(id_), stage) for _, id_, stage, _ in listed] == [(64, n) for n in "123"]
    texts = [git("cat-file", "blob", id_) for _, id_, _, _ in listed]
    assert ["n > 3" in texts[0], "n >= 4" in texts[1], "n > 5" in texts[2]] == [True] * 3
    assert "UU patrol.rebeca" in git("status", "--short")


def test_conflicts_are_told_of_in_a_directory_below_the_top(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("deep/down").mkdir(parents=True)
    Path("deep/down/guard.rebeca").write_text(MODEL)
    monkeypatch.chdir("deep/down")
    assert main(["generate", "guard.rebeca"]) == 0
    git("add", "-A")
    git("commit", "-q", "-m", "deep")
    replace("guard/src/robot.cpp", "n > 3", "n > 5")
    replace("guard.rebeca", "n > 3", "n >= 4")
    assert run("sync")[0] == 1
    assert len(git("ls-files", "-u").splitlines()) == 3


def _both_moved() -> None:
    """Model and code change the same, each in its own way."""
    replace(SOURCE, "n > 3", "n > 5")
    replace("patrol.rebeca", "n > 3", "n >= 4")


@pytest.mark.parametrize("how", ["file", "directory", "index", "objects", "commondir"])
def test_conflicts_are_not_told_to_another_repository(run: Run, tmp_path: Path, how: str) -> None:
    """An archive brings a `.git` that leads to a repository of the user with such a file."""
    victim = tmp_path / "victim"
    shutil.copytree(".", victim, symlinks=True)  # the repository of `run` itself
    own = Path(".git")
    match how:
        case "file":
            shutil.rmtree(own)
            own.write_text(f"gitdir: {victim}/.git\n")
        case "directory":
            shutil.rmtree(own)
            own.symlink_to(victim / ".git")
        case "index":
            Path(".git/index").unlink()
            Path(".git/index").symlink_to(victim / ".git/index")
        case "objects":
            shutil.rmtree(".git/objects")
            Path(".git/objects").symlink_to(victim / ".git/objects")
        case _:
            Path(".git/commondir").write_text(f"{victim}/.git\n")
    before = everything(victim)
    _both_moved()
    assert run("sync")[0] == 1
    assert "<<<<<<<" in Path("patrol.rebeca").read_text()
    assert everything(victim) == before


@pytest.mark.parametrize("kind", ["work tree", "submodule"])
def test_conflicts_are_told_in_work_trees_and_submodules(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    """There `.git` is a file that names a directory elsewhere, which names it in turn."""
    other = tmp_path / "other"
    if kind == "work tree":
        git("worktree", "add", "-q", str(other))
    else:
        git("init", "-q", str(tmp_path / "whole"))
        add = ("-c", "protocol.file.allow=always", "submodule", "add", "-q", str(Path.cwd()))
        git(*add, "part", cwd=tmp_path / "whole")
        other = tmp_path / "whole/part"
    assert (other / ".git").is_file()
    monkeypatch.chdir(other)
    _both_moved()
    assert run("sync")[0] == 1
    assert len(git("ls-files", "-u").splitlines()) == 3
