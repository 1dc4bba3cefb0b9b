"""A package that model and code have both moved away from, and commands on it in processes."""

from __future__ import annotations

import io
import os
import shutil
import sys
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

from rebsync.cli import main
from tests.cli.test_check import MODEL

MODEL_FILE = "patrol.rebeca"
SOURCE = "patrol/src/robot.cpp"
MANIFEST = "patrol/.rebsync/manifest.json"
EDITS = ((SOURCE, "n > 3", "n > 5  /* mine */"), (MODEL_FILE, "% 4;", "% 5;  // mine"))
Snapshot = dict[str, bytes]


@dataclass(frozen=True)
class Ended:
    """How a command ended, and all that it printed."""

    status: int
    told: str


def prepare(folder: Path) -> None:
    """Makes the package in a directory, in step, then the edits of both sides."""
    (folder / MODEL_FILE).write_text(MODEL, encoding="utf-8")
    ended = run(folder, "generate", MODEL_FILE)
    assert ended.status == 0, ended.told
    for path, old, new in EDITS:
        text = (folder / path).read_text(encoding="utf-8")
        assert old in text
        (folder / path).write_text(text.replace(old, new), encoding="utf-8")
    warm(folder)


def warm(made: Path) -> None:
    """Syncs a copy in this very process, so that what is forked from it has everything loaded."""
    here, cache = Path.cwd(), os.environ.get("REBSYNC_CACHE")
    os.environ["REBSYNC_CACHE"] = str(made / ".cache")
    try:
        os.chdir(copied(made, made.parent / "warm"))
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
            assert main(["sync"]) == 0
    finally:
        os.chdir(here)
        del os.environ["REBSYNC_CACHE"]
        if cache is not None:
            os.environ["REBSYNC_CACHE"] = cache


def copied(made: Path, folder: Path) -> Path:
    """A copy to try a fault on."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(made, folder, symlinks=True)
    return folder


def snapshot(folder: Path) -> Snapshot:
    """All files but those of the cache; links as where they lead."""
    found: Snapshot = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if name.startswith((".cache", ".git/")):
            continue
        if path.is_symlink():
            found[name] = b"-> " + os.fsencode(path.readlink())
        elif path.is_file():
            found[name] = path.read_bytes()
    return found


def run(folder: Path, *arguments: str, before: Callable[[], None] | None = None) -> Ended:
    """Runs a command in a process of its own, which is quick to start: it is forked.

    `before` is called there first.
    """
    out = folder.parent / f"{folder.name}.told"
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        os._exit(_child(folder, arguments, before, out))
    _, status = os.waitpid(child, 0)
    told = out.read_text(encoding="utf-8")
    out.unlink()
    return Ended(os.waitstatus_to_exitcode(status), told)


def _child(
    folder: Path, arguments: tuple[str, ...], before: Callable[[], None] | None, out: Path
) -> int:
    with out.open("w", encoding="utf-8") as told:
        os.chdir(folder)
        os.environ["REBSYNC_CACHE"] = str(folder / ".cache")
        sys.stdout = sys.stderr = told
        try:
            if before is not None:
                before()
            return main(list(arguments))
        except BaseException as error:  # a process ends with this whatever it is
            told.write(f"Traceback: {error!r}")
            return 70
        finally:
            told.flush()
