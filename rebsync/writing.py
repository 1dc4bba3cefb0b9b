"""Replacing files whole: what was there stays until all that is new is safe."""

from __future__ import annotations

import errno
import os
import re
import signal
import stat
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import BOM, RECORDS, followed, operating_on
from rebsync.folder import Folder, content_of, open_regular, opened, refuse_special
from rebsync.records import dataclass
from rebsync.terminal import encoded

STAGED = re.compile(r"\..+\.[0-9a-f]{8}\.rebsync\.tmp\Z")
_ENDING = {"SIGINT", "SIGTERM", "SIGHUP"}


def replace_text(path: str, text: str) -> bool:
    """Make `text` the content of a file; False if it was so already.

    An existing file keeps its mode and byte order mark; a link is followed to the real file, unless
    it leads out of the repository that it lies in.
    """
    data = encoded(text)
    with operating_on(path):
        if not _is_replaceable(path):
            Path(path).write_bytes(data)  # a device or a pipe cannot be replaced
            return True
        above, name = os.path.split(real_path(path))
        with Folder(above) as folder:
            each = _Replacement(path, folder.handle, name, data)
            old = _content(each)
            if old is not None and old.startswith(BOM):
                each.data = BOM + data
            if old == each.data:
                return False
            _replace_all([each])
    return True


def replace_pieces(path: str, pieces: Iterable[str]) -> None:
    """Make a text that comes in pieces the content of a file, which is never whole in memory.

    As `replace_text`, but the old content is not looked at.
    """
    data = map(encoded, pieces)
    with operating_on(path):
        if not _is_replaceable(path):
            with open(path, "wb") as file:  # noqa: PTH123
                file.writelines(data)
            return
        above, name = os.path.split(real_path(path))
        with Folder(above) as folder:
            _replace_all([_Replacement(path, folder.handle, name, b"", pieces=data)])


def _is_replaceable(path: str) -> bool:
    """Whether a path is not that of a device or a pipe, such as `/dev/stdout`, to write into.

    RebsyncError: it is, behind a link in a repository.
    """
    try:
        found = os.stat(path)  # noqa: PTH116
    except OSError:
        return True
    if stat.S_ISREG(found.st_mode) or stat.S_ISDIR(found.st_mode):
        return True
    if not path.startswith("/dev/"):
        real_path(path)
    return False


def real_path(path: str) -> str:
    """The path of the file to write for `path`, without links.

    OSError: there is no such directory. RebsyncError: a link leads out of its repository.
    """
    if os.path.islink(path):  # noqa: PTH114
        return followed(path)
    above, name = os.path.split(path)
    return f"{os.path.realpath(above or '.', strict=True).rstrip(os.sep)}{os.sep}{name}"


def told(path: str) -> str:
    """The path of a file that was written, and where it is if that is a link."""
    if not os.path.islink(path):  # noqa: PTH114
        return path
    return f"{path}, a link to {os.path.relpath(os.path.realpath(path))}"


def replace_tree(
    root: str,
    texts: Mapping[str, str],
    remove: Collection[str] = (),
    ready: Callable[[], None] = lambda: None,
    beside: Mapping[str, str] | None = None,
    real: str | None = None,
) -> tuple[str, ...]:
    """Make files below `root` hold `texts`, and delete `remove`: all of it or nothing.

    `ready` is called at the last moment before; what it raises leaves all as it was. `beside` are
    texts of files elsewhere, by their real paths. `real` is where `root` was found to be: it is no
    link by now. RebsyncError: a link is in the way.

    The paths are relative, with `/`. Gives those written or deleted; the others already were so.
    Files appear in the order given, those elsewhere first, and go last: so a machine that dies
    half-way leaves a prefix.
    """
    with operating_on(root), ExitStack() as folders:
        if not os.path.isdir(root):  # noqa: PTH112
            if texts:
                _create_tree(Path(root), texts)
            return tuple(texts)
        handle = opened(real) if real is not None else None
        tree = folders.enter_context(Folder(root, handle))
        created: list[tuple[int, str]] = []
        try:
            replacements = list(_elsewhere(beside or {}, folders))
            for name, text in texts.items():
                with operating_on(f"{root}/{name}"):
                    place = tree.place(name, created)
                data = encoded(text)
                replacements.append(_Replacement(f"{root}/{name}", *place, data, name))
            writes = [each for each in replacements if _content(each) != each.data]
            deletions = [
                _Replacement(f"{root}/{name}", *tree.place(name), None, key=name)
                for name in remove
                if tree.status(name) is not None
            ]
            _replace_all([*writes, *deletions], ready)
        except BaseException:
            _take_away(created)
            raise
    return tuple(each.key for each in (*writes, *deletions))


def _elsewhere(texts: Mapping[str, str], folders: ExitStack) -> Iterator[_Replacement]:
    for path, text in texts.items():
        above, name = os.path.split(path)
        folder = folders.enter_context(Folder(above))
        yield _Replacement(path, folder.handle, name, encoded(text), key=path)


@dataclass(slots=True)
class _Replacement:
    """One file to be: its new bytes (None to delete it) or pieces, and what is staged beside it.

    `folder` is the handle of its directory, in which all happens; `path` is for messages only.
    """

    path: str
    folder: int
    name: str
    data: bytes | None
    key: str = ""
    pieces: Iterable[bytes] = ()
    staged: str | None = None
    saved: str | None = None
    existed: bool = False
    done: bool = False

    @property
    def status(self) -> os.stat_result | None:
        """What is known of the file that is there, if one is. RebsyncError: it is a link."""
        try:
            found = os.stat(self.name, dir_fd=self.folder, follow_symlinks=False)
        except FileNotFoundError:
            return None
        if stat.S_ISLNK(found.st_mode):
            message = "this is a link, and rebsync writes through none here"
            raise RebsyncError.of(self.path, "RS813", message, "put the file itself here")
        refuse_special(self.path, found)
        return found


def _mode(name: str, data: bytes) -> int:
    """The mode of a new file: programs can be run, but for those that are only kept as records."""
    return 0o777 if data.startswith(b"#!") and not name.startswith(f"{RECORDS}/") else 0o666


def _content(each: _Replacement) -> bytes | None:
    with operating_on(each.path):
        found = each.status
        if found is None:
            return None
        return content_of(open_regular(each.name, each.path, found, each.folder))


def _create_tree(root: Path, texts: Mapping[str, str]) -> None:
    """A tree that is not there yet appears in one step."""
    created: list[Path] = []
    _refuse_link(root)
    try:
        make_folder(root.parent, created)
        with Folder(str(root.parent)) as above:
            stage = _beside(root.name)
            os.mkdir(stage, dir_fd=above.handle)
            try:
                with Folder(str(root), above.take(stage)) as tree:
                    for name, text in texts.items():
                        place = tree.place(name, [])
                        data = encoded(text)
                        _write(*place, (data,), _mode(name, data))
                os.rename(stage, root.name, src_dir_fd=above.handle, dst_dir_fd=above.handle)
            except BaseException:
                above.remove(stage)
                raise
            _sync_directory(above.handle)
    except BaseException:
        _undo([], created)
        raise


def _refuse_link(root: Path) -> None:
    """RebsyncError: a link that leads nowhere is where a directory is to be."""
    if root.is_symlink():
        message = "this is a link, and it leads to no directory"
        raise RebsyncError.of(str(root), "RS813", message)


def _replace_all(
    replacements: list[_Replacement], ready: Callable[[], None] = lambda: None
) -> None:
    """Stage every file, then put all in place; on any failure the old ones come back."""
    try:
        for each in replacements:
            with operating_on(each.path):
                _stage(each)
                if len(replacements) > 1:
                    _save(each)
        with _undisturbed():
            ready()
            _put_all(replacements)
    except BaseException:
        with _undisturbed():
            _undo(replacements, [])
        raise
    for folder in {each.folder for each in replacements}:
        _sync_directory(folder)


def _stage(each: _Replacement) -> None:
    found = each.status
    if found is not None and not os.access(each.name, os.W_OK, dir_fd=each.folder):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    if each.data is None:
        return
    each.existed = found is not None
    each.staged = _beside(each.name)
    kept = None
    if found is not None:
        kept = stat.S_IMODE(found.st_mode)
    data = each.pieces or (each.data,)
    _write(each.folder, each.staged, data, _mode(each.key, each.data), kept)


def _save(each: _Replacement) -> None:
    """Keep the old file under a second name until all new ones are in place."""
    found = each.status
    if found is None:
        return
    each.saved = _beside(each.name)
    at = each.folder
    try:
        os.link(each.name, each.saved, src_dir_fd=at, dst_dir_fd=at, follow_symlinks=False)
    except OSError:
        data = content_of(open_regular(each.name, each.path, found, at))
        _write(at, each.saved, (data,), 0o600, stat.S_IMODE(found.st_mode))
        os.utime(each.saved, ns=(found.st_atime_ns, found.st_mtime_ns), dir_fd=at)


def make_folder(folder: Path, created: list[Path]) -> None:
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
        with operating_on(each.path):
            _put(each)
    saved = [(each.folder, each.saved) for each in replacements]
    for each in replacements:
        each.done, each.saved, each.staged = False, None, None
    for folder, name in saved:
        _discard(folder, name)


def _put(each: _Replacement) -> None:
    each.done = True
    if each.staged:
        at = each.folder
        os.replace(each.staged, each.name, src_dir_fd=at, dst_dir_fd=at)
    else:
        os.unlink(each.name, dir_fd=each.folder)


def _undo(replacements: list[_Replacement], created: list[Path]) -> None:
    for each in reversed(replacements):
        at = each.folder
        if each.done and each.saved:
            with suppress(OSError):
                os.replace(each.saved, each.name, src_dir_fd=at, dst_dir_fd=at)
        elif each.done and not each.existed and each.staged and not _is_there(at, each.staged):
            _discard(at, each.name)
        _discard(at, each.saved)
        _discard(at, each.staged)
    for folder in reversed(created):
        with suppress(OSError):
            folder.rmdir()


def _take_away(created: list[tuple[int, str]]) -> None:
    """Takes directories away again that were made, and that nothing is in."""
    for folder, name in reversed(created):
        with suppress(OSError):
            os.rmdir(name, dir_fd=folder)


def _is_there(folder: int, name: str) -> bool:
    try:
        os.stat(name, dir_fd=folder, follow_symlinks=False)
    except OSError:
        return False
    return True


def _discard(folder: int, name: str | None) -> None:
    if name:
        with suppress(OSError):
            os.unlink(name, dir_fd=folder)


def _beside(name: str) -> str:
    return f".{name[:100]}.{os.urandom(4).hex()}.rebsync.tmp"


def _write(
    folder: int, name: str, data: Iterable[bytes], mode: int, exact: int | None = None
) -> None:
    """A new file, on the disk for good when this returns; `exact` is its mode without umask."""
    handle = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode, dir_fd=folder)
    with os.fdopen(handle, "wb") as file:
        if exact is not None:
            os.fchmod(handle, exact)
        file.writelines(data)
        file.flush()
        os.fsync(handle)


def _sync_directory(folder: int) -> None:
    with suppress(OSError):
        os.fsync(folder)


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
