"""Directories and repositories that mean harm, and what their victim has beside them."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from rebsync import git_files
from rebsync.cli import main
from rebsync.trees import repository

Run = Callable[..., tuple[int, str]]
NAMES = {
    "GIT_CONFIG_GLOBAL": os.devnull,
    "GIT_CONFIG_SYSTEM": os.devnull,
    "GIT_AUTHOR_NAME": "a",
    "GIT_AUTHOR_EMAIL": "a@example.org",
    "GIT_COMMITTER_NAME": "a",
    "GIT_COMMITTER_EMAIL": "a@example.org",
}


def git(*arguments: str, given: bytes = b"", cwd: Path | None = None) -> str:
    """What git prints, with nothing of this machine's settings."""
    done = subprocess.run(
        ["git", *arguments],
        cwd=cwd,
        env=os.environ | NAMES,
        input=given,
        capture_output=True,
        check=True,
    )
    unchecked()
    return done.stdout.decode().strip()


def unchecked() -> None:
    """Nothing of repositories is known any more."""
    repository.cache_clear()
    git_files._refuse.cache_clear()


def everything(folder: Path) -> dict[str, bytes]:
    """All that is in a directory but for caches: files with their content, links, directories."""
    found: dict[str, bytes] = {}
    for path in sorted(folder.rglob("*")):
        if ".cache" in path.parts:
            continue
        if path.is_symlink():
            found[str(path)] = b"-> " + os.fsencode(path.readlink())
        else:
            found[str(path)] = path.read_bytes() if path.is_file() else b"/"
    return found


def runner(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs a command in-process; gives the exit status and all that is printed."""
    monkeypatch.setenv("REBSYNC_CACHE", str(Path("../.cache").absolute()))

    def run(*arguments: str) -> tuple[int, str]:
        capsys.readouterr()
        status = main(list(arguments))
        shown = capsys.readouterr()
        return status, shown.out + shown.err

    return run
