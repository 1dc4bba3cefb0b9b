"""Databases of ROS 2 bags that are cut off (sqlite.org/fileformat2.html): the rows before the cut.

SQLite refuses a file that has fewer pages than its header says. With empty pages for those that are
missing it reads the table of messages row by row, in the order in which they were recorded, up to
the first of these. What can be read is copied, for rosbags sorts by an index that may be lost.
"""

from __future__ import annotations

import sqlite3
import struct
import tempfile
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

_MAGIC = b"SQLite format 3\0"
_PAGE_SIZE, _PAGE_COUNT = 16, 28  # where they are in the header
_BLOCK = 2**20


@contextmanager
def whole_rows(path: Path) -> Iterator[tuple[Path, bool]]:
    """A database that can be read, and whether it is only the beginning of the one at the path."""
    pages = _pages(path) if path.suffix == ".db3" and path.is_file() else None
    if pages is None:
        yield path, False
        return
    with tempfile.TemporaryDirectory(prefix="rebsync") as folder:
        cut, copy = Path(folder) / "cut.db3", Path(folder) / path.name
        if copy == cut:
            copy = Path(folder) / "copy.db3"
        _mend(path, cut, *pages)
        with closing(sqlite3.connect(cut)) as source, closing(sqlite3.connect(copy)) as target:
            _copy(source, target)
            target.commit()
        yield copy, True


def _pages(path: Path) -> tuple[int, int] | None:
    """The bytes of whole pages, and those there should be; None: it has all, or is no database."""
    with path.open("rb") as file:
        head = file.read(100)
    if len(head) < 100 or not head.startswith(_MAGIC):
        return None
    size = struct.unpack_from(">H", head, _PAGE_SIZE)[0]
    size = 65536 if size == 1 else size
    expected = struct.unpack_from(">I", head, _PAGE_COUNT)[0]
    count = path.stat().st_size // size if size else 0
    return (size * count, size * expected) if 0 < count < expected else None


def _mend(path: Path, target: Path, left: int, size: int) -> None:
    """Copies the whole pages of a database, and adds empty ones."""
    with path.open("rb") as file, target.open("wb") as copy:
        while left:
            left -= copy.write(file.read(min(_BLOCK, left)))
        copy.truncate(size)


def _copy(source: sqlite3.Connection, target: sqlite3.Connection) -> None:
    """Copies tables, of each the rows before the first that cannot be read."""
    tables = source.execute("SELECT name, sql FROM sqlite_master WHERE type = 'table'").fetchall()
    for name, sql in tables:
        if name.startswith("sqlite_"):
            continue
        target.execute(sql)
        quoted = '"' + name.replace('"', '""') + '"'
        columns = len(source.execute(f"PRAGMA table_info({quoted})").fetchall())
        insert = f"INSERT INTO {quoted} VALUES ({', '.join('?' * columns)})"
        with suppress(sqlite3.DatabaseError):
            for row in source.execute(f"SELECT * FROM {quoted} NOT INDEXED"):
                target.execute(insert, row)
