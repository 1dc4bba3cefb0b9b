"""Reading texts, and what a user needs to know when the operating system refuses."""

from __future__ import annotations

import errno
import os
import re
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.folder import LARGEST, Folder, content_of, open_regular, too_large
from rebsync.long_numbers import MOST_DIGITS, long_number
from rebsync.source import Source, Span
from rebsync.trees import leads_out, repository_of_link

MODEL, PROPERTY = ".rebeca", ".property"  # how the names of such files end
STANDARD_INPUT = "-"
RECORDS = ".rebsync"  # the folder of a package with what it was made from
_RECORD = re.compile(rf"((?:.*?/)?)({re.escape(RECORDS)}/.*)", re.DOTALL)
# What a shell makes of `<(command)`: pipes that are open already, and that a user has named.
_STREAM = re.compile(r"/dev/(?:stdin|fd/\d+)|/proc/self/fd/\d+")
BOM = b"\xef\xbb\xbf"
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
    """The bytes of a regular file, or of standard input for `-`.

    RebsyncError: it cannot be read, is no regular file, is a link that leads out of a repository,
    or is in a folder of records and a link is on the way to it from there.
    """
    if not path:
        raise RebsyncError.of('""', "RS801", "the name of a file is empty")
    try:
        if path != STANDARD_INPUT:
            data = content_of(_opened(path), LARGEST)
        elif sys.stdin is not None:
            data = sys.stdin.buffer.read(LARGEST + 1)
        else:
            raise RebsyncError.of(path, "RS806", "standard input is closed")
    except ValueError as error:
        raise RebsyncError.of(path, "RS806", str(error)) from None
    except OSError as error:
        raise os_mistake(path, error) from None
    if len(data) > LARGEST:
        raise too_large(path)
    return data


def source_below(root: str, name: str) -> Source | None:
    """The text of a file of a package; None where there is none.

    RebsyncError: it cannot be read, is no regular file, or is behind a link.
    """
    path = f"{root}/{name}"
    try:
        with Folder(root) as folder:
            return decode(path, content_of(folder.open(name), LARGEST))
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        raise os_mistake(path, error) from None


def names_below(root: str, name: str) -> list[str]:
    """The files of a package in and below one of its directories, by their paths in that.

    What Python has compiled there is no file of the package.
    RebsyncError: one of them is a link or no regular file, or cannot be told of.
    """
    ignored = suppress(FileNotFoundError, NotADirectoryError)
    with operating_on(f"{root}/{name}"), ignored, Folder(root) as folder:
        below = (each.removeprefix(f"{name}/") for each in folder.files(name))
        return [each for each in below if "__pycache__" not in each.split("/")]
    return []


def _opened(path: str) -> int:
    """A handle to read a file, by the name that a user, or what lies beside it, has for it."""
    if (records := _RECORD.match(path)) is not None:
        with Folder(records[1] or ".") as folder:
            return folder.open(records[2])
    if _STREAM.fullmatch(path):
        return os.open(path, os.O_RDONLY)
    found = os.stat(path, follow_symlinks=False)  # noqa: PTH116 - of many files
    if not stat.S_ISLNK(found.st_mode):
        return open_regular(path, path, found)
    above, name = os.path.split(followed(path))
    with Folder(above) as folder:
        return folder.open(name)


def followed(path: str, named: str | None = None) -> str:
    """The real path of what a link leads to.

    OSError: it leads nowhere. RebsyncError: it lies in a repository, and leads out of it; or out of
    the directory `named` by the user that it was found in, where there is no repository.
    """
    real = os.path.realpath(path, strict=True)
    if leads_out(path, real, named):
        raise leading_out(path)
    return real


def leading_out(path: str, hint: str = "put the file itself here") -> RebsyncError:
    """The mistake of a link that is not followed."""
    where = "the repository" if repository_of_link(path) else "the directory that was named"
    message = f"this link leads out of {where}, and is not followed"
    return RebsyncError.of(path, "RS813", message, hint)


def decode(path: str, data: bytes) -> Source:
    """The text that `data` encodes in UTF-8; a RebsyncError that shows the first wrong byte."""
    try:
        return _with_short_numbers(Source(path, data.removeprefix(BOM).decode("utf-8")))
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
    text = data.removeprefix(BOM).decode("utf-8", errors="replace")
    raise RebsyncError([Findings(Source(path, text), (mistake,))])


def _with_short_numbers(source: Source) -> Source:
    if (span := long_number(source.text)) is not None:
        message = f"this number has more than {MOST_DIGITS:,} digits"
        raise RebsyncError([Findings(source, (Diagnostic("RS830", span, message),))])
    return source


@contextmanager
def operating_on(path: str) -> Iterator[None]:
    """Turns what the operating system refuses into a mistake about `path`."""
    try:
        yield
    except OSError as error:
        raise os_mistake(path, error) from None
