"""The user's cache: what is costly to make is kept between runs, under a seal.

An entry counts only if it was sealed with a key that lies outside the cache: a branch can bring a
whole cache with it, and a job of CI can take one over from a branch, but not the key. An entry that
is damaged, foreign, or of an older rebsync is as good as not there. All may be deleted at any time.
"""

from __future__ import annotations

import hashlib
import os
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from rebsync.cache_folder import UnsafeFolder, is_ours, private_folder
from rebsync.records import dataclass

if TYPE_CHECKING:
    from rebsync.diagnostics import Findings

KEY_VARIABLE = "REBSYNC_CACHE_KEY"
_SEAL = 32  # bytes
_HINT = "`REBSYNC_CACHE` and `XDG_STATE_HOME` choose folders; they must be outside of repositories"
_refused: dict[str, tuple[str, str]] = {}


@dataclass(frozen=True, slots=True)
class Cache:
    """A part of the cache: entries of one kind by their names, in a folder of this user alone."""

    folder: Path
    key: bytes

    def seal(self, name: str, content: bytes) -> str:
        """What only who has the key can say of an entry."""
        told = f"{self.folder.name}\0{name}\0".encode()
        return hashlib.blake2b(told + content, digest_size=_SEAL, key=self.key).hexdigest()

    def load(self, name: str) -> bytes | None:
        """The content of an entry; None unless it is there, whole, and under our seal."""
        data = read_ours(self.folder / name)
        if data is None:
            return None
        content = data[2 * _SEAL :]
        is_sealed = data[: 2 * _SEAL] == self.seal(name, content).encode()
        return content if is_sealed else None

    def store(self, name: str, content: bytes) -> None:
        """Keeps an entry for later runs, if that can be done."""
        with suppress(OSError):
            self.put(name, self.seal(name, content).encode() + content)

    def put(self, name: str, data: bytes, mode: int = 0o600) -> Path:
        """Makes a file in the folder, in one step. OSError: that cannot be done."""
        path = self.folder / name
        write_whole(path, data, mode)
        return path

    def tidy(self, most: int) -> None:
        """Lets the entries go that were made longest ago, when there are more than `most`."""
        with suppress(OSError):
            names = os.listdir(self.folder)  # noqa: PTH208
            if len(names) <= most:
                return
            times = []
            for name in names:
                with suppress(OSError):
                    times.append(((self.folder / name).stat().st_mtime_ns, name))
            for _, name in sorted(times)[: max(len(times) - most, len(times) // 2)]:
                with suppress(OSError):
                    (self.folder / name).unlink()


def open_cache(part: str) -> Cache | None:
    """A part of the cache; None if there is no place for it, or no safe one (see `refused`)."""
    try:
        place = _chosen_directory() / part
        return _opened(place, _state_directory(), os.environ.get(KEY_VARIABLE))
    except (OSError, RuntimeError, ValueError):  # RuntimeError: a user without a home
        return None


@cache
def _opened(place: Path, state: Path, told: str | None) -> Cache | None:
    """Looked at once: whoever could change the folders later could have done so before."""
    folder = _safe(place)
    key = _key(state, told) if folder is not None else None
    return Cache(folder, key) if folder and key else None


def refused() -> Findings | None:
    """Why a folder was not used that was to be the cache or to hold its key, if that was so."""
    from rebsync.diagnostics import Diagnostic, Findings, Severity
    from rebsync.source import NOWHERE, Source

    for path, (message, hint) in _refused.items():
        found = Diagnostic("RS820", NOWHERE, message, hint, severity=Severity.WARNING)
        return Findings(Source(path, ""), (found,))
    return None


def _chosen_directory() -> Path:
    if chosen := os.environ.get("REBSYNC_CACHE"):
        return Path(chosen)
    return _of_user("XDG_CACHE_HOME", "user_cache_path")


def _state_directory() -> Path:
    return _of_user("XDG_STATE_HOME", "user_state_path")


def _of_user(variable: str, kind: Literal["user_cache_path", "user_state_path"]) -> Path:
    """The folder that this user has chosen, else that of the system for such files.

    A relative path counts as not chosen. RuntimeError: this user has no folders.
    """
    chosen = Path(os.environ.get(variable, ""))
    if chosen.is_absolute():
        return chosen / "rebsync"
    import platformdirs

    found: Path = getattr(platformdirs, kind)("rebsync", appauthor=False)
    if not found.is_absolute():
        raise RuntimeError
    return found


def _safe(path: Path) -> Path | None:
    """The folder, if it is safe and can be written to."""
    try:
        folder = private_folder(path)
    except UnsafeFolder as why:
        _refused[str(path)] = (f"nothing is kept between runs: {why}", _HINT)
        return None
    return folder if os.access(folder, os.W_OK) else None


# --- the key -------------------------------------------------------------------------------------


def _key(state: Path, told: str | None) -> bytes | None:
    """The key of the user's seal: from the environment, else from a file outside the cache."""
    if told:
        if len(told) >= _SEAL:
            return hashlib.blake2b(told.encode("utf-8", "surrogateescape")).digest()
        message = f"nothing is kept between runs: the key has fewer than {_SEAL} characters"
        _refused[KEY_VARIABLE] = (message, "`openssl rand -hex 32` makes one")
        return None
    folder = _safe(state)
    if folder is None:
        return None
    path = folder / "cache.key"
    key = read_ours(path, secret=True)
    if key is None or len(key) != _SEAL:
        write_whole(path, os.urandom(_SEAL), 0o600)
        key = read_ours(path, secret=True)  # another process may have made one since
    return key


# --- files ---------------------------------------------------------------------------------------


def read_ours(path: Path, secret: bool = False) -> bytes | None:
    """The content of a file that only this user can write; and read, where it is `secret`."""
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    with suppress(OSError):
        handle = os.open(path, flags)
        with os.fdopen(handle, "rb") as file:
            found = os.fstat(handle)
            if is_ours(found) and not (secret and found.st_mode & 0o077):
                return file.read()
    return None


def write_whole(path: Path, data: bytes, mode: int) -> None:
    """Makes a file, whole or not at all. OSError: that cannot be done."""
    staged = path.with_name(f".{path.name}.{os.urandom(4).hex()}")
    try:
        handle = os.open(staged, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode)
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        staged.replace(path)
    except OSError:
        with suppress(OSError):
            staged.unlink()
        raise
