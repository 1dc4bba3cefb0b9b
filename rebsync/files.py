"""Reading texts and replacing files whole: what was there stays until the new text is safe."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
import stat
import sys
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.source import Source, Span

STANDARD_INPUT = "-"
_BOM = b"\xef\xbb\xbf"
_CODES = {
    errno.ENOENT: ("RS801", "no such file or directory"),
    errno.EISDIR: ("RS802", "this is a directory, not a file"),
    errno.ENOTDIR: ("RS802", "a part of this path is a file, not a directory"),
    errno.EEXIST: ("RS802", "there is something else of this name"),
    errno.EACCES: ("RS803", "permission denied"),
    errno.EPERM: ("RS803", "permission denied"),
    errno.EROFS: ("RS803", "the file system is read-only"),
    errno.ENOSPC: ("RS805", "no space left on the disk"),
    errno.EDQUOT: ("RS805", "the disk quota is used up"),
}


def os_mistake(path: str, error: OSError) -> RebsyncError:
    """What a user needs to know of a failed operation on `path`."""
    code, message = _CODES.get(error.errno or 0, ("RS806", error.strerror or str(error)))
    return RebsyncError.of(path, code, message)


def read_source(path: str) -> Source:
    """The text of a file, or of standard input for `-`; a byte order mark is left out."""
    return decode(path, read_bytes(path))


def read_bytes(path: str) -> bytes:
    """The bytes of a file, or of standard input for `-`."""
    try:
        if path == STANDARD_INPUT:
            return sys.stdin.buffer.read()
        return Path(path).read_bytes()
    except ValueError as error:
        raise RebsyncError.of(path, "RS806", str(error)) from None
    except OSError as error:
        raise os_mistake(path, error) from None


def decode(path: str, data: bytes) -> Source:
    """The text that `data` encodes in UTF-8; a RebsyncError that shows the first wrong byte."""
    try:
        return Source(path, data.removeprefix(_BOM).decode("utf-8"))
    except UnicodeDecodeError as error:
        place = len(error.object[: error.start].decode("utf-8"))
        bad = error.object[error.start]
    mistake = Diagnostic(
        "RS804",
        Span(place, place + 1),
        f"this is not UTF-8: byte 0x{bad:02x}",
        "the file looks like UTF-16; save it as UTF-8"
        if data[:2] in (b"\xff\xfe", b"\xfe\xff")
        else "save the file as UTF-8",
    )
    text = data.removeprefix(_BOM).decode("utf-8", errors="replace")
    raise RebsyncError([Findings(Source(path, text), (mistake,))])


def replace_text(path: str, text: str) -> bool:
    """Make `text` the content of a file; False if it was so already.

    An existing file keeps its mode and byte order mark; a link is followed to the real file.
    """
    target = Path(path)
    data = text.encode("utf-8")
    with _operating_on(path):
        if target.exists() and not target.is_file() and not target.is_dir():
            target.write_bytes(data)  # a device or a pipe cannot be replaced
            return True
        old = _content(target)
        if old is not None and old.startswith(_BOM):
            data = _BOM + data
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
) -> tuple[str, ...]:
    """Make files below `root` hold `texts`, and delete `remove`: all of it or nothing.

    The paths are relative, with `/`. Gives those written or deleted; the others already were so.
    """
    folder = Path(root)
    with _operating_on(root):
        writes = [
            _Replacement(folder / name, text.encode("utf-8"), name in executable)
            for name, text in sorted(texts.items())
            if _content(folder / name) != text.encode("utf-8")
        ]
        deletions = [_Replacement(folder / name, None) for name in sorted(remove)]
        replacements = writes + [each for each in deletions if each.path.is_file()]
        if replacements and not folder.exists() and not folder.is_symlink():
            _create_tree(folder, replacements)
        else:
            _replace_all(replacements)
    return tuple(each.path.relative_to(folder).as_posix() for each in replacements)


@dataclass(slots=True)
class _Replacement:
    """One file to be: its new bytes (None to delete it), and what is staged beside it."""

    path: Path
    data: bytes | None
    executable: bool = False
    staged: Path | None = None
    saved: Path | None = None
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


def _replace_all(replacements: list[_Replacement]) -> None:
    """Stage every file, then put all in place; on any failure the old ones come back."""
    created: list[Path] = []
    try:
        for each in replacements:
            with _operating_on(str(each.path)):
                _stage(each, created)
                if len(replacements) > 1:
                    _save(each)
        for each in replacements:
            with _operating_on(str(each.path)):
                _put(each)
    except BaseException:
        _undo(replacements, created)
        raise
    for each in replacements:
        _discard(each.saved)
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
    _make_folder(real.parent, created)
    each.staged = _beside(real)
    _write(each.staged, each.data, each.mode)
    if real.exists():
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
        each.mkdir()
        created.append(each)


def _put(each: _Replacement) -> None:
    real = each.real
    each.done = True
    if each.staged:
        each.staged.replace(real)
    else:
        real.unlink()


def _undo(replacements: list[_Replacement], created: list[Path]) -> None:
    for each in replacements:
        if each.done and each.saved:
            with suppress(OSError):
                each.saved.replace(each.real)
        elif each.done and each.staged and not each.staged.exists():
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
    return path.with_name(f".{path.name[:100]}.{secrets.token_hex(4)}.tmp")


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


@contextmanager
def _operating_on(path: str) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise os_mistake(path, error) from None
