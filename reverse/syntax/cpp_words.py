"""The words of a text of C++, by which is told quickly what need not be looked for in it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property, lru_cache

from rebsync.records import dataclass

# Of a word of bytes; others, as those of letters that are not ASCII, stand between words.
_PARTS = frozenset(b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")
_SPACED = bytes(byte if byte in _PARTS else ord(" ") for byte in range(256))
_COMMENT = re.compile(rb"\s*/([/*])")


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
    head = head_of(data)
    return _words(data[:head]).union(_spaced(data[head:]))


@lru_cache(maxsize=4)
def _words(head: bytes) -> frozenset[bytes]:
    """The words of a text's head, which is the same in most files of a package."""
    return frozenset(_spaced(head))


def _spaced(data: bytes) -> list[bytes]:
    return data.translate(_SPACED).split()


def head_of(data: bytes) -> int:
    """Where the comments end that a text begins with: they say who may copy it."""
    at = 0
    while found := _COMMENT.match(data, at):
        close = b"\n" if found[1] == b"/" else b"*/"
        end = data.find(close, found.end())
        if end < 0:
            break
        at = end + len(close)
    return at


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
