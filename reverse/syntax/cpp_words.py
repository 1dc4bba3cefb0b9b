"""The words of a text of C++, by which is told quickly what need not be looked for in it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from rebsync.records import dataclass

# Of a word of bytes; others, as those of letters that are not ASCII, stand between words.
_PARTS = frozenset(b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")
_SPACED = bytes(byte if byte in _PARTS else ord(" ") for byte in range(256))


@dataclass(frozen=True)
class Plain:
    """The bytes of a text, and its words, once they are asked for."""

    data: bytes

    @cached_property
    def words(self) -> frozenset[bytes]:
        """All words of the text: what is not among them stands nowhere in it."""
        return words_of(self.data)


def words_of(data: bytes) -> frozenset[bytes]:
    """All words of a text, those of comments and of texts in quotes too."""
    return frozenset(data.translate(_SPACED).split())


def places_of(data: bytes, word: bytes) -> Iterator[int]:
    """Where a word begins in a text, wherever it is not part of a longer one."""
    at = data.find(word) if word else -1
    while at >= 0:
        end = at + len(word)
        if (at == 0 or data[at - 1] not in _PARTS) and (
            end == len(data) or data[end] not in _PARTS
        ):
            yield at
        at = data.find(word, end)
