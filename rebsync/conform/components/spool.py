"""A sequence in a temporary file, for as many messages as a recording has.

Named tuples are written as plain ones, which takes a tenth of the time.
"""

from __future__ import annotations

import pickle
from collections.abc import Iterable, Iterator, Sequence
from tempfile import TemporaryFile
from typing import IO, Any, TypeVar, overload

T = TypeVar("T")

BLOCK = 1024  # items that are written and read together
_KEPT = 4  # blocks in memory


class Spool(Sequence[T]):
    """Items that are appended, then read by their numbers; only some blocks are in memory."""

    def __init__(self, items: Iterable[T] = ()) -> None:
        self._file: IO[bytes] | None = None
        self._offsets: list[int] = []
        self._tail: list[T] = []
        self._blocks = {0: self._tail}
        for item in items:
            self.append(item)

    def __del__(self) -> None:
        if self._file is not None:
            self._file.close()

    def append(self, item: T) -> None:
        """One more at the end."""
        self._tail.append(item)
        if len(self._tail) == BLOCK:
            if self._file is None:
                self._file = TemporaryFile()  # noqa: SIM115
            self._offsets.append(self._file.seek(0, 2))
            kind = type(item)
            rows: list[Any] = self._tail
            if hasattr(kind, "_make"):
                rows = list(map(tuple, rows))
            pickle.dump((kind, rows), self._file, pickle.HIGHEST_PROTOCOL)
            self._tail = []
            self._blocks = {len(self._offsets): self._tail}

    def __len__(self) -> int:
        return len(self._offsets) * BLOCK + len(self._tail)

    @overload
    def __getitem__(self, at: int) -> T: ...

    @overload
    def __getitem__(self, at: slice) -> list[T]: ...

    def __getitem__(self, at: int | slice) -> T | list[T]:
        if isinstance(at, slice):
            return [self[n] for n in range(*at.indices(len(self)))]
        block = self._blocks.get(at // BLOCK)
        if block is None:
            if not 0 <= at < len(self):
                return self[range(len(self))[at]]
            block = self._read(at // BLOCK)
        return block[at % BLOCK]

    def __iter__(self) -> Iterator[T]:
        return self.since(0)

    def since(self, at: int) -> Iterator[T]:
        """The items from a number on."""
        first = at // BLOCK
        for number in range(first, len(self._offsets) + 1):
            block = self._blocks.get(number)
            if block is None:
                block = self._read(number)
            for n in range(at % BLOCK if number == first else 0, len(block)):
                yield block[n]

    def _read(self, number: int) -> list[T]:
        assert self._file is not None
        self._file.seek(self._offsets[number])
        kind, rows = pickle.load(self._file)
        found: list[T] = list(map(kind._make, rows)) if hasattr(kind, "_make") else rows
        if len(self._blocks) > _KEPT:
            oldest = next(n for n in self._blocks if n < len(self._offsets))
            del self._blocks[oldest]
        self._blocks[number] = found
        return found
