"""`rebsync completion`: a real bash completes commands and options with the script."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.run import environment, rebsync


@pytest.mark.skipif(shutil.which("bash") is None, reason="bash is not installed")
@pytest.mark.parametrize(
    ("typed", "completed"),
    [
        ("rebsync ver", "verify"),
        ("rebsync lint --f", "--fix --format"),
    ],
)
def test_bash_completes(tmp_path: Path, typed: str, completed: str) -> None:
    program = tmp_path / "rebsync"
    program.write_text(f'#!/bin/sh\nexec {sys.executable} -m rebsync "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    script = rebsync("completion", "bash", cwd=tmp_path).out
    (tmp_path / "script").write_text(script, encoding="utf-8")
    words = typed.split()
    asked = f"""
        . ./script
        COMP_WORDS=({typed}); COMP_CWORD={len(words) - 1}
        _rebsync_completion rebsync; echo "${{COMPREPLY[@]}}"
    """
    done = subprocess.run(
        ["bash", "--norc", "-c", asked],
        cwd=tmp_path,
        env=environment() | {"PATH": f"{tmp_path}:{os.environ['PATH']}"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == completed


@pytest.mark.parametrize("typed", ["rebsync lint he", "rebsync verify x --property he"])
def test_paths_are_left_to_the_shell(tmp_path: Path, typed: str) -> None:
    asked = {
        "_REBSYNC_COMPLETE": "bash_complete",
        "COMP_WORDS": typed,
        "COMP_CWORD": str(typed.count(" ")),
    }
    assert rebsync(cwd=tmp_path, env=asked).out == "file,he\n"
