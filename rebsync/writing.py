"""Replacing files whole: what was there stays until all that is new is safe."""

from __future__ import annotations

import errno
import os
import re
import secrets
import shutil
import signal
import stat
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from rebsync.files import BOM, operating_on
from rebsync.records import dataclass
from rebsync.terminal import encoded

_STAGED = re.compile(r"\..+\.[0-9a-f]{8}\.rebsync\.tmp\Z")
_ENDING = {"SIGINT", "SIGTERM", "SIGHUP"}


def replace_text(path: str, text: str) -> bool:
    """Make `text` the content of a file; False if it was so already.

    An existing file keeps its mode and byte order mark; a link is followed to the real file.
    """
    target = Path(path)
    data = encoded(text)
    with operating_on(path):
        if target.exists() and not target.is_file() and not target.is_dir():
            target.write_bytes(data)  # a device or a pipe cannot be replaced
            return True
        old = _content(target)
        if old is not None and old.startswith(BOM):
            data = BOM + data
        if old == data:
            return False
        target.parent.stat()
    _replace_all([_Replacement(target, data)])
    return True


def replace_tree(
    root: str,
    texts: Mapping[str, str],
    executable: Collection[str] = (),
    remove: Collection[str] = (),
    ready: Callable[[], None] = lambda: None,
) -> tuple[str, ...]:
    """Make files below `root` hold `texts`, and delete `remove`: all of it or nothing.

    `ready` is called at the last moment before; what it raises leaves all as it was.

    The paths are relative, with `/`. Gives those written or deleted; the others already were so.
    Files appear in the order given, and go last: so a machine that dies half-way leaves a prefix.
    """
    folder = Path(root)
    with operating_on(root):
        writes = [
            _Replacement(folder / name, encoded(text), name in executable)
            for name, text in texts.items()
            if _content(folder / name) != encoded(text)
        ]
        deletions = [_Replacement(folder / name, None) for name in remove]
        replacements = writes + [each for each in deletions if each.path.is_file()]
        if replacements and not folder.exists() and not folder.is_symlink():
            _create_tree(folder, replacements)
        else:
            _replace_all(replacements, ready)
    return tuple(each.path.relative_to(folder).as_posix() for each in replacements)


@dataclass(slots=True)
class _Replacement:
    """One file to be: its new bytes (None to delete it), and what is staged beside it."""

    path: Path
    data: bytes | None
    executable: bool = False
    staged: Path | None = None
    saved: Path | None = None
    existed: bool = False
    done: bool = False

    @property
    def real(self) -> Path:
        return self.path.resolve() if self.path.is_symlink() else self.path

    @property
    def mode(self) -> int:
        return 0o777 if self.executable else 0o666


def _content(path: Path) -> bytes | None:
    return path.read_bytes() if path.is_file() else None


def _create_tree(root: Path, replacements: list[_Replacement]) -> None:
    """A tree that is not there yet appears in one step."""
    created: list[Path] = []
    stage = _beside(root)
    try:
        _make_folder(root.parent, created)
        for each in replacements:
            path = stage / each.path.relative_to(root)
            path.parent.mkdir(parents=True, exist_ok=True)
            _write(path, each.data or b"", each.mode)
        stage.rename(root)
    except BaseException:
        shutil.rmtree(stage, ignore_errors=True)
        _undo([], created)
        raise
    _sync_directory(root.parent)


def _replace_all(
    replacements: list[_Replacement], ready: Callable[[], None] = lambda: None
) -> None:
    """Stage every file, then put all in place; on any failure the old ones come back."""
    created: list[Path] = []
    try:
        for each in replacements:
            with operating_on(str(each.path)):
                _stage(each, created)
                if len(replacements) > 1:
                    _save(each)
        with _undisturbed():
            ready()
            _put_all(replacements)
            created = []
    except BaseException:
        with _undisturbed():
            _undo(replacements, created)
        raise
    for folder in {each.real.parent for each in replacements}:
        _sync_directory(folder)


def _stage(each: _Replacement, created: list[Path]) -> None:
    real = each.real
    if real.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if real.exists() and not os.access(real, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    if each.data is None:
        return
    each.existed = real.exists()
    _make_folder(real.parent, created)
    each.staged = _beside(real)
    _write(each.staged, each.data, each.mode)
    if each.existed:
        kept = stat.S_IMODE(real.stat().st_mode)
        each.staged.chmod(kept | (kept & 0o444) >> 2 if each.executable else kept)


def _save(each: _Replacement) -> None:
    """Keep the old file under a second name until all new ones are in place."""
    real = each.real
    if real.exists():
        each.saved = _beside(real)
        try:
            each.saved.hardlink_to(real)
        except OSError:
            shutil.copy2(real, each.saved)


def _make_folder(folder: Path, created: list[Path]) -> None:
    missing = []
    while not folder.exists():
        missing.append(folder)
        folder = folder.parent
    for each in reversed(missing):
        try:
            each.mkdir()
        except FileExistsError:  # another process was quicker
            if not each.is_dir():
                raise
        else:
            created.append(each)


def _put_all(replacements: list[_Replacement]) -> None:
    for each in replacements:
        with operating_on(str(each.path)):
            _put(each)
    saved = [each.saved for each in replacements]
    for each in replacements:
        each.done, each.saved, each.staged = False, None, None
    for path in saved:
        _discard(path)


def _put(each: _Replacement) -> None:
    real = each.real
    each.done = True
    if each.staged:
        each.staged.replace(real)
    else:
        real.unlink()


def _undo(replacements: list[_Replacement], created: list[Path]) -> None:
    for each in reversed(replacements):
        if each.done and each.saved:
            with suppress(OSError):
                each.saved.replace(each.real)
        elif each.done and not each.existed and each.staged and not each.staged.exists():
            _discard(each.real)
        _discard(each.saved)
        _discard(each.staged)
    for folder in reversed(created):
        with suppress(OSError):
            folder.rmdir()


def _discard(path: Path | None) -> None:
    if path:
        with suppress(OSError):
            path.unlink()


def _beside(path: Path) -> Path:
    return path.with_name(f".{path.name[:100]}.{secrets.token_hex(4)}.rebsync.tmp")


def _write(path: Path, data: bytes, mode: int) -> None:
    """A new file, on the disk for good when this returns."""
    handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode)
    with os.fdopen(handle, "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _sync_directory(folder: Path) -> None:
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


# --- others who write, and interruptions ---------------------------------------------------------


@contextmanager
def alone_in(root: str, *files: str) -> Iterator[None]:
    """One process at a time writes the tree `root`, and `files` that may lie elsewhere.

    What a killed one left behind is taken away.
    """
    folder = Path(root)
    created: list[Path] = []
    with operating_on(root):
        _make_folder(folder.parent, created)
    folders = {os.path.realpath(path.parent) for path in (folder, *map(Path, files))}
    try:
        with ExitStack() as locks:
            for each in sorted(folders):  # in one order, so that no two wait for each other
                locks.enter_context(_locked(Path(each)))
            _clear(folder)
            for file in map(Path, files):
                _clear_beside(file.resolve())
            yield
    finally:
        _undo([], created)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Holds the folder's lock, where the system has such locks."""
    handle = None
    with suppress(OSError, ImportError):
        import fcntl

        handle = os.open(folder, os.O_RDONLY)
        fcntl.flock(handle, fcntl.LOCK_EX)
    try:
        yield
    finally:
        if handle is not None:
            os.close(handle)


def _clear(root: Path) -> None:
    with suppress(OSError):
        for stage in root.parent.glob(f".{root.name[:100]}.*.rebsync.tmp"):
            if _STAGED.match(stage.name):
                shutil.rmtree(stage, ignore_errors=True)
        for staged in root.rglob(".*.rebsync.tmp"):
            if _STAGED.match(staged.name):
                _discard(staged)


def _clear_beside(file: Path) -> None:
    with suppress(OSError):
        for staged in file.parent.glob(f".{file.name[:100]}.*.rebsync.tmp"):
            if _STAGED.match(staged.name) and staged.is_file():
                _discard(staged)


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Signals that end the command wait until the files are all old or all new."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    ending = {getattr(signal, name) for name in _ENDING}
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ending)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
