"""Reading texts, and what a user needs to know when the operating system refuses."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.long_numbers import MOST_DIGITS, long_number
from rebsync.source import Source, Span

STANDARD_INPUT = "-"
_LARGEST = 64 << 20
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
    """The bytes of a file, or of standard input for `-`."""
    if not path:
        raise RebsyncError.of('""', "RS801", "the name of a file is empty")
    try:
        if path != STANDARD_INPUT:
            with Path(path).open("rb") as file:
                size = os.fstat(file.fileno()).st_size
                # To ask for so much takes long: only where the size is not known.
                data = file.read() if 0 < size <= _LARGEST else file.read(_LARGEST + 1)
        elif sys.stdin is not None:
            data = sys.stdin.buffer.read(_LARGEST + 1)
        else:
            raise RebsyncError.of(path, "RS806", "standard input is closed")
    except ValueError as error:
        raise RebsyncError.of(path, "RS806", str(error)) from None
    except OSError as error:
        raise os_mistake(path, error) from None
    if len(data) > _LARGEST:
        raise RebsyncError.of(path, "RS806", f"larger than {_LARGEST >> 20} MiB, too large to read")
    return data


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
