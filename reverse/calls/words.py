"""Where the words of a library stand in a text: told from its bytes, before any look-up."""

from __future__ import annotations

from rebsync.reverse.libraries.cpp_calls import Calls
from rebsync.reverse.syntax.cpp_words import places_of

_WHITE = frozenset(b" \t\n\r\f\v")


def words_in(calls: Calls, data: bytes, words: frozenset[bytes]) -> list[tuple[int, int, str]]:
    """The places of the words of a library in a text whose words are known, from the first.

    Start, end, and the word; of words that count only after a scope, those that stand so.
    """
    found = [(at, word) for word in calls.words & words for at in places_of(data, word)]
    for word in calls.scoped_words & words:
        found += ((at, word) for at in places_of(data, word) if _is_scoped(data, at))
    return [(at, at + len(word), word.decode()) for at, word in sorted(found)]


def _is_scoped(data: bytes, at: int) -> bool:
    """Whether a scope stands before a place: `::`, and maybe white space."""
    while at > 0 and data[at - 1] in _WHITE:
        at -= 1
    return data.endswith(b"::", 0, at)
