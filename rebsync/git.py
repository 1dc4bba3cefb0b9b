"""The one way in which git is run: nothing that a repository says makes it run anything else.

A repository brings its own configuration and hooks, and what it says there is not the user's: file
system monitors, hooks, filters, external differs, pagers, transports are off. Configuration of the
user and of the system holds, above all which directories are safe. A repository within the files
of another, without `.git`, is none.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from tempfile import TemporaryDirectory
from threading import Timer
from typing import IO

from rebsync.diagnostics import RebsyncError
from rebsync.git_files import refuse_special_files

_PATIENCE = 10.0  # seconds; what a configuration includes may be a pipe, which git waits for
_MOST_OF_ALL = 60.0  # seconds, for all objects of a revision
_OFF = (
    "core.fsmonitor=",
    f"core.hooksPath={os.devnull}",
    f"core.attributesFile={os.devnull}",
    "core.pager=cat",
    "core.editor=false",
    "core.askPass=false",
    "core.sshCommand=false",
    "core.alternateRefsCommand=",
    "credential.helper=",
    "diff.external=",
    "gc.auto=0",
    "gpg.program=false",
    "maintenance.auto=false",
    "merge.conflictStyle=merge",
    "protocol.allow=never",
    "safe.bareRepository=explicit",
    "submodule.recurse=false",
)
# What git is told of its configuration, and of where a repository may be.
_KEPT = ("GIT_CONFIG", "GIT_CEILING_", "GIT_DISCOVERY_", "GIT_EXEC_PATH", "GIT_NO_REPLACE_")
# Which repository a hook is run for. It counts in the current directory only.
_HERE = (
    "GIT_DIR",
    "GIT_COMMON_DIR",
    "GIT_WORK_TREE",
    "GIT_NAMESPACE",
    "GIT_OBJECT_DIRECTORY",
    "GIT_ALTERNATE_OBJECT_DIRECTORIES",
)
_SET = {
    "GIT_ALLOW_PROTOCOL": "none",
    "GIT_ASKPASS": "false",
    "GIT_NO_LAZY_FETCH": "1",
    "GIT_OPTIONAL_LOCKS": "0",
    "GIT_PAGER": "cat",
    "GIT_TERMINAL_PROMPT": "0",
}


def git(*arguments: str, folder: str | None = None, given: bytes = b"") -> bytes | None:
    """What a command of git prints, run in a directory or the current one; None where it fails.

    OSError: there is no git. RebsyncError: it does not end.
    """
    done = finished(*arguments, folder=folder, given=given)
    return done.stdout if done.returncode == 0 else None


def git_without_files(
    *arguments: str, folder: str | None = None, given: bytes = b""
) -> bytes | None:
    """As `git`, of a command on the index that is not to look at any file of the working tree.

    To see whether files have changed git runs the filters that a repository has for them.
    """
    found = git("rev-parse", "--absolute-git-dir", folder=folder)
    if not found:
        return None
    own = os.fsdecode(found.removesuffix(b"\n"))
    with TemporaryDirectory(prefix="rebsync-") as nothing:
        places = (f"--git-dir={own}", f"--work-tree={nothing}")
        return git(*places, *arguments, folder=nothing, given=given)


def finished(
    *arguments: str, folder: str | None = None, given: bytes = b""
) -> subprocess.CompletedProcess[bytes]:
    """A command of git that has ended; as `git`."""
    refuse_special_files(folder, _chosen(here=folder is None))
    try:
        return subprocess.run(
            _command(arguments),
            cwd=folder,
            env=_environment(os.environ, here=folder is None),
            input=given,
            capture_output=True,
            check=False,
            timeout=_PATIENCE,
        )
    except subprocess.TimeoutExpired:
        message = f"git has not ended within {_PATIENCE:.0f} s"
        raise RebsyncError.of(folder or ".", "RS806", message) from None


@contextmanager
def conversation(*arguments: str) -> Iterator[tuple[IO[bytes], IO[bytes]]]:
    """A command of git to write to and to read from. OSError: as `git`.

    What it gives ends when it has taken too long.
    """
    refuse_special_files(None, _chosen(here=True))
    with subprocess.Popen(
        _command(arguments),
        env=_environment(os.environ, here=True),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        late = Timer(_MOST_OF_ALL, process.kill)
        late.start()
        try:
            yield process.stdin, process.stdout
        finally:
            late.cancel()
            process.kill()
            with suppress(OSError):
                process.stdin.close()


def _chosen(*, here: bool) -> str | None:
    return os.environ.get("GIT_DIR") if here else None


def _command(arguments: tuple[str, ...]) -> list[str]:
    settings = (word for each in _OFF for word in ("-c", each))
    return ["git", "--no-pager", *settings, *arguments]


def _environment(given: Mapping[str, str], *, here: bool) -> dict[str, str]:
    """The environment for git: of its own variables only those that are the user's to set."""
    kept = {
        name: value
        for name, value in given.items()
        if not name.startswith("GIT_") or name.startswith(_KEPT) or (here and name in _HERE)
    }
    return {**kept, **_SET}
