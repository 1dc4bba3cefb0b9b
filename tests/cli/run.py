"""Runs the command line as a user does: another process, its streams, its exit status."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent


@dataclass(frozen=True)
class Outcome:
    """What came of a run."""

    status: int
    out: str
    err: str


def rebsync(
    *arguments: str,
    cwd: Path,
    stdin: bytes = b"",
    env: Mapping[str, str] | None = None,
    before: tuple[str, ...] = (),
) -> Outcome:
    """Run `rebsync` with these arguments in a directory; `before` is a program that starts it."""
    done = subprocess.run(
        [*before, sys.executable, "-m", "rebsync", *arguments],
        cwd=cwd,
        input=stdin,
        capture_output=True,
        env=environment() | dict(env or {}),
        check=False,
    )
    outcome = Outcome(done.returncode, done.stdout.decode(), done.stderr.decode())
    assert "Traceback" not in outcome.err, outcome.err
    return outcome


def environment() -> dict[str, str]:
    """The environment in which the checkout can be imported from anywhere."""
    return {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "error"}
