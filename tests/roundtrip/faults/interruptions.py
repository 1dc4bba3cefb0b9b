"""Commands stopped at one operation that writes: they die there, or the operation fails."""

from __future__ import annotations

import errno
import os
import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from tests.roundtrip.faults.package import MODEL_FILE, Ended, Snapshot, copied, run, snapshot

KILLED = 137
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT
_EVENTS = ("os.rename", "os.remove", "os.link", "os.mkdir", "os.rmdir", "os.chmod", "os.truncate")


@dataclass(frozen=True)
class Action:
    """A command that is stopped, and how it ends if it is not.

    `clear` takes away first what is to be written anew; `counts_cache` says that what is written to
    the cache counts as well, as check writes nothing else.
    """

    name: str
    arguments: tuple[str, ...]
    status: int = 0
    clear: str = ""
    counts_cache: bool = False

    def begun(self, made: Path, folder: Path) -> Path:
        """A copy of a package on which the command is to run."""
        copied(made, folder)
        if self.clear:
            shutil.rmtree(folder / self.clear)
        return folder


SYNC = Action("sync", ("sync",))
ACTIONS = (
    SYNC,
    Action("generate anew", ("generate", MODEL_FILE)),
    Action("generate", ("generate", MODEL_FILE), clear="patrol"),
    Action("check", ("check",), 1, ".cache", counts_cache=True),
)


@dataclass(frozen=True)
class Stop:
    """At which operation a command stops, and how: it is killed, or an error comes of it."""

    number: int
    is_killed: bool
    action: Action = SYNC


def stopping(folder: Path, stop: Stop) -> Callable[[], None]:
    """Makes the process in which it is called stop there. It cannot be undone."""

    def install() -> None:
        seen = 0

        def one() -> None:
            nonlocal seen
            seen += 1
            if seen != stop.number:
                return
            if stop.is_killed:
                os._exit(KILLED)
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        def hook(event: str, arguments: tuple[object, ...]) -> None:
            if _writes(folder, event, arguments, stop.action.counts_cache):
                one()

        sys.addaudithook(hook)
        os.fsync = lambda fd: one()

    return install


def _writes(folder: Path, event: str, arguments: tuple[object, ...], counts_cache: bool) -> bool:
    if event == "open":
        flags = arguments[2]
        if not (isinstance(flags, int) and flags & _WRITING):
            return False
    elif event not in _EVENTS:
        return False
    path = arguments[0]
    if not isinstance(path, str | os.PathLike):
        return False
    name = os.path.normpath(Path.cwd() / os.fspath(path))
    is_cache = name.startswith(f"{folder}/.cache")
    return name.startswith(f"{folder}/") and (counts_cache or not is_cache)


@dataclass(frozen=True)
class Tried:
    """What came of one stop: how the command ended, and what does not hold."""

    stop: Stop
    ended: Ended
    wrong: tuple[str, ...]


def whole(action: Action, made: Path, folder: Path) -> tuple[Snapshot, Ended]:
    """What a command leaves that nothing stops."""
    ended = run(action.begun(made, folder), *action.arguments)
    assert ended.status == action.status, ended.told
    return snapshot(folder), ended


def tried(made: Path, wanted: Snapshot, folder: Path, stop: Stop) -> Tried:
    """Stops a command in a copy of a package, and looks at what it has left; then runs it again."""
    action = stop.action
    old = snapshot(action.begun(made, folder))
    ended = run(folder, *action.arguments, before=stopping(folder, stop))
    left = snapshot(folder)
    wrong = []
    if not stop.is_killed and ended.status not in (action.status, KILLED):
        wrong += [] if left == old else ["an error, and something is not as it was"]
        wrong += [] if "RS805" in ended.told else [f"told: {ended.told}"]
    return Tried(stop, ended, (*wrong, *after(action, old, wanted, folder)))


def after(action: Action, old: Snapshot, wanted: Snapshot, folder: Path) -> list[str]:
    """What is wrong after a command that was stopped; the same command then makes it good."""
    wrong = _mixed(old, wanted, snapshot(folder))
    again = run(folder, *action.arguments)
    if again.status != action.status:
        return [*wrong, f"the next {action.name}: {again.status} {again.told}"]
    now = snapshot(folder)
    return wrong + [f"after the next {action.name}: {n}" for n in _differing(now, wanted)]


def _mixed(old: Snapshot, new: Snapshot, left: Snapshot) -> list[str]:
    """The files that are neither as they were nor as they are to be."""
    return [
        f"neither old nor new: {name}"
        for name in sorted({*old, *new})
        if left.get(name) not in (old.get(name), new.get(name))
    ]


def _differing(one: Snapshot, other: Snapshot) -> list[str]:
    return [name for name in sorted({*one, *other}) if one.get(name) != other.get(name)]


def operations(action: Action, made: Path, folder: Path) -> int:
    """How many operations the whole command has."""
    low, high = 0, 1024
    while high - low > 1:
        middle = (low + high) // 2
        action.begun(made, folder)
        stop = Stop(middle, True, action)
        ended = run(folder, *action.arguments, before=stopping(folder, stop))
        low, high = (middle, high) if ended.status == KILLED else (low, middle)
    return low
