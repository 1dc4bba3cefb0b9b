"""Packages that model and code have both moved away from, and commands on them in processes."""

from __future__ import annotations

import io
import os
import shutil
import sys
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path

from rebsync.cli import main
from tests.cli.test_check import MODEL

MODEL_FILE = "patrol.rebeca"
MANIFEST = "patrol/.rebsync/manifest.json"
Edits = tuple[tuple[str, str, str], ...]
Snapshot = dict[str, bytes]

_OF_MODEL = (MODEL_FILE, "% 4;", "% 5;  // mine")
_GUARD = """\
reactiveclass Guard(2) {
  knownrebecs {
    Robot robot;
  }

  Guard() {
    self.watch();
  }

  msgsrv watch() {
    robot.go(1);
    self.watch() after(5);
  }
}

main {
  Guard guard(robot1):();
"""


_TWO = MODEL.replace("main {\n", _GUARD)


@dataclass(frozen=True)
class Patrol:
    """The package in a dialect: its settings, its model, and the edits of both sides.

    `source` is the file that something happens to, `launch` the launch file.
    """

    settings: str
    source: str
    launch: str
    edits: Edits
    model: str = field(default=_TWO, repr=False)

    @property
    def comment(self) -> str:
        """What comments of the source begin with."""
        return "#" if self.source.endswith(".py") else "//"


def _patrol(dialect: str, folder: str, suffix: str, launch: str, model: str = _TWO) -> Patrol:
    """The package in a dialect; what happens is not to the class that is edited."""
    mine = "  /* mine */" if suffix == "cpp" else "  # mine"
    edits = ((f"{folder}/robot.{suffix}", "n > 3", f"n > 5{mine}"), _OF_MODEL)
    source = f"{folder}/{'guard' if model == _TWO else 'robot'}.{suffix}"
    return Patrol(f'target = "{dialect}"\n', source, launch, edits, model)


_LAUNCH = "patrol/launch/patrol.launch"
PATROLS = {
    "ros1-cpp": _patrol("ros1-cpp", "patrol/src", "cpp", _LAUNCH, MODEL),
    "ros2-cpp": _patrol("ros2-cpp", "patrol/src", "cpp", f"{_LAUNCH}.py"),
    "ros1-py": _patrol("ros1-py", "patrol/src/patrol", "py", _LAUNCH),
    "ros2-py": _patrol(
        "ros2-py", "patrol/patrol/patrol", "py", "patrol/patrol/launch/patrol.launch.py"
    ),
    "mixed": Patrol(
        'target = "ros1-cpp"\n\n[targets]\nGuard = "ros1-py"\n',
        "patrol/src/patrol/guard.py",
        _LAUNCH,
        (
            ("patrol/src/robot.cpp", "n > 3", "n > 5  /* mine */"),
            ("patrol/src/patrol/guard.py", "(When(after=5))", "(When(after=6))  # mine"),
            _OF_MODEL,
        ),
    ),
}


@dataclass(frozen=True)
class Ended:
    """How a command ended, and all that it printed."""

    status: int
    told: str


def prepare(folder: Path, patrol: Patrol) -> None:
    """Makes the package in a directory, in step, then the edits of both sides."""
    (folder / MODEL_FILE).write_text(patrol.model, encoding="utf-8")
    (folder / "rebsync.toml").write_text(patrol.settings, encoding="utf-8")
    ended = run(folder, "generate", MODEL_FILE)
    assert ended.status == 0, ended.told
    for path, old, new in patrol.edits:
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
        os.fsync = lambda fd: None  # a disk takes longer for this than all the rest
        try:
            if before is not None:
                before()
            return main(list(arguments))
        except BaseException as error:  # a process ends with this whatever it is
            told.write(f"Traceback: {error!r}")
            return 70
        finally:
            told.flush()
