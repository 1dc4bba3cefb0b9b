"""A sync that is stopped at one operation that writes: it dies there, or the operation fails."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from tests.roundtrip.faults.package import Ended, Snapshot, copied, run, snapshot

KILLED = 137
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT
_EVENTS = ("os.rename", "os.remove", "os.link", "os.mkdir", "os.rmdir", "os.chmod", "os.truncate")


@dataclass(frozen=True)
class Stop:
    """At which operation a sync stops, and how: it is killed, or an error comes of it."""

    number: int
    is_killed: bool


def stopping(folder: Path, stop: Stop) -> Callable[[], None]:
    """Makes the process in which it is called stop there. It cannot be undone."""

    def install() -> None:
        seen = 0
        real = os.fsync

        def one() -> None:
            nonlocal seen
            seen += 1
            if seen != stop.number:
                return
            if stop.is_killed:
                os._exit(KILLED)
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        def hook(event: str, arguments: tuple[object, ...]) -> None:
            if _writes(folder, event, arguments):
                one()

        def fsync(handle: int) -> None:
            one()
            real(handle)

        sys.addaudithook(hook)
        os.fsync = fsync  # type: ignore[assignment]

    return install


def _writes(folder: Path, event: str, arguments: tuple[object, ...]) -> bool:
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
    return name.startswith(f"{folder}/") and not name.startswith(f"{folder}/.cache")


@dataclass(frozen=True)
class Tried:
    """What came of one stop: how the sync ended, and what does not hold."""

    stop: Stop
    ended: Ended
    wrong: tuple[str, ...]


def tried(made: Path, wanted: Snapshot, folder: Path, stop: Stop) -> Tried:
    """Stops a sync in a copy of a package, and looks at what it has left; then syncs again."""
    old = snapshot(copied(made, folder))
    ended = run(folder, "sync", before=stopping(folder, stop))
    left = snapshot(folder)
    wrong = list(_mixed(old, wanted, left))
    if not stop.is_killed and ended.status not in (0, KILLED):
        wrong += [] if left == old else ["an error, and something is not as it was"]
        wrong += [] if "RS805" in ended.told else [f"told: {ended.told}"]
    again = run(folder, "sync")
    if again.status != 0:
        wrong.append(f"the next sync: {again.status} {again.told}")
    else:
        now = snapshot(folder)
        wrong += [f"after the next sync: {n}" for n in _differing(now, wanted)]
    return Tried(stop, ended, tuple(wrong))


def _mixed(old: Snapshot, new: Snapshot, left: Snapshot) -> list[str]:
    """The files that are neither as they were nor as they are to be."""
    return [
        f"neither old nor new: {name}"
        for name in sorted({*old, *new})
        if left.get(name) not in (old.get(name), new.get(name))
    ]


def _differing(one: Snapshot, other: Snapshot) -> list[str]:
    return [name for name in sorted({*one, *other}) if one.get(name) != other.get(name)]


def operations(made: Path, folder: Path) -> int:
    """How many operations a whole sync has."""
    low, high = 0, 1024
    while high - low > 1:
        middle = (low + high) // 2
        copied(made, folder)
        ended = run(folder, "sync", before=stopping(folder, Stop(middle, True)))
        low, high = (middle, high) if ended.status == KILLED else (low, middle)
    return low
