"""MCAP files without their ends (mcap.dev/spec), which a recorder leaves that was killed.

rosbags reads a file from its footer on. One without is copied, up to its last whole record, with
the least footer that the format knows.
"""

from __future__ import annotations

import struct
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

_MAGIC = b"\x89MCAP0\r\n"
_BLOCK = 2**20
_FOOTER, _CHUNK, _DATA_END = 0x02, 0x06, 0x0F
_HEAD = struct.Struct("<BQ")  # of a record: kind, length of what follows
_ABOUT = struct.Struct("<QQQIIQ")  # of a chunk without compression: times, sizes, its name's length
_END = (
    _HEAD.pack(_DATA_END, 4) + bytes(4) + _HEAD.pack(_FOOTER, 20) + bytes(20) + _MAGIC
)  # without sums and without a summary


@contextmanager
def whole_records(path: Path) -> Iterator[tuple[Path, bool]]:
    """A file that can be read, and whether it is only the beginning of the one at the path."""
    end = _end_of_records(path) if path.suffix == ".mcap" and path.is_file() else None
    if end is None:
        yield path, False
        return
    with tempfile.TemporaryDirectory(prefix="rebsync") as folder:
        copy = Path(folder) / path.name
        with path.open("rb") as file, copy.open("wb") as target:
            while file.tell() < end:
                target.write(file.read(min(_BLOCK, end - file.tell())))
            target.write(_begun_chunk(file))
            target.write(_END)
        yield copy, True


def _end_of_records(path: Path) -> int | None:
    """Where the last whole record ends; None: the file has its end, or is no MCAP."""
    size = path.stat().st_size
    with path.open("rb") as file:
        if file.read(len(_MAGIC)) != _MAGIC:
            return None
        end = len(_MAGIC)
        while len(head := file.read(_HEAD.size)) == _HEAD.size:
            kind, length = _HEAD.unpack(head)
            after = file.tell() + length
            if after > size:
                return end
            if kind in (_FOOTER, _DATA_END):
                return None if _has_magic(file, size) else end
            end = file.seek(after)
        return end


def _begun_chunk(file: BinaryIO) -> bytes:
    """The whole records in a chunk that is cut off, if it is not compressed."""
    head = file.read(_HEAD.size)
    if len(head) < _HEAD.size or _HEAD.unpack(head)[0] != _CHUNK:
        return b""
    about = file.read(_ABOUT.size)
    if len(about) < _ABOUT.size or _ABOUT.unpack(about)[-2]:
        return b""
    data, end = file.read(), 0
    while end + _HEAD.size <= len(data):
        after = end + _HEAD.size + _HEAD.unpack_from(data, end)[1]
        if after > len(data):
            break
        end = after
    return data[:end]


def _has_magic(file: BinaryIO, size: int) -> bool:
    file.seek(size - len(_MAGIC))
    return file.read() == _MAGIC
