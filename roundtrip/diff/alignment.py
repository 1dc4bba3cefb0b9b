"""Aligns two sequences: what is equal belongs together, then what is alike."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from difflib import SequenceMatcher
from typing import TypeVar

_T = TypeVar("_T")

ALIKE = 0.5  # from this similarity on, two that are not equal may be a pair
_LARGEST = 4_000  # pairs of which the similarity is asked


def aligned(
    lefts: Sequence[_T], rights: Sequence[_T], similarity: Callable[[_T, _T], float]
) -> Iterator[tuple[_T | None, _T | None]]:
    """Pairs in order, with None beside what has no partner.

    Equal sequences give equal pairs only. `similarity` is from 0 to 1; less than ALIKE is no pair.
    """
    start, most = 0, min(len(lefts), len(rights))
    while start < most and lefts[start] == rights[start]:
        start += 1
    end = 0
    while end < most - start and lefts[-1 - end] == rights[-1 - end]:
        end += 1
    yield from zip(lefts[:start], rights[:start], strict=True)
    last = (len(lefts) - end, len(rights) - end)
    yield from _middle(lefts[start : last[0]], rights[start : last[1]], similarity)
    yield from zip(lefts[last[0] :], rights[last[1] :], strict=True)


def _middle(
    lefts: Sequence[_T], rights: Sequence[_T], similarity: Callable[[_T, _T], float]
) -> Iterator[tuple[_T | None, _T | None]]:
    if len(lefts) * len(rights) <= _LARGEST:
        yield from _best(lefts, rights, similarity)
        return
    numbers: dict[_T, int] = {}
    first, second = (
        [numbers.setdefault(x, len(numbers)) for x in each] for each in (lefts, rights)
    )
    matcher = SequenceMatcher(None, first, second, autojunk=False)
    for tag, i, j, k, n in matcher.get_opcodes():
        if tag == "equal" or (j - i) * (n - k) <= _LARGEST:
            yield from _best(lefts[i:j], rights[k:n], similarity)
        else:
            yield from ((left, None) for left in lefts[i:j])
            yield from ((None, right) for right in rights[k:n])


def _best(
    lefts: Sequence[_T], rights: Sequence[_T], similarity: Callable[[_T, _T], float]
) -> list[tuple[_T | None, _T | None]]:
    """The alignment with the most in common; of several the one with the earliest pairs."""
    gains = [[_gain(left, right, similarity) for right in rights] for left in lefts]
    best = [[0.0] * (len(rights) + 1) for _ in range(len(lefts) + 1)]
    for i in reversed(range(len(lefts))):
        for j in reversed(range(len(rights))):
            paired = gains[i][j] + best[i + 1][j + 1] if gains[i][j] else 0.0
            best[i][j] = max(paired, best[i + 1][j], best[i][j + 1])
    found: list[tuple[_T | None, _T | None]] = []
    i = j = 0
    while i < len(lefts) and j < len(rights):
        if gains[i][j] and best[i][j] == gains[i][j] + best[i + 1][j + 1]:
            found.append((lefts[i], rights[j]))
            i, j = i + 1, j + 1
        elif best[i][j] == best[i + 1][j]:
            found.append((lefts[i], None))
            i += 1
        else:
            found.append((None, rights[j]))
            j += 1
    found += [(left, None) for left in lefts[i:]]
    found += [(None, right) for right in rights[j:]]
    return found


def _gain(left: _T, right: _T, similarity: Callable[[_T, _T], float]) -> float:
    """What a pair adds: equal ones more than two pairs that are only alike."""
    if left == right:
        return 2.0
    alike = similarity(left, right)
    return alike if alike >= ALIKE else 0.0


def overlap(left: Counter[str], right: Counter[str]) -> float:
    """How much two bags of words have in common, from 0 to 1."""
    total = left.total() + right.total()
    return 2.0 * (left & right).total() / total if total else 1.0


def longest_increasing(numbers: Sequence[int]) -> frozenset[int]:
    """The numbers of a longest increasing subsequence of different numbers."""
    lengths: list[int] = []
    for i, number in enumerate(numbers):
        before = [lengths[k] for k in range(i) if numbers[k] < number]
        lengths.append(1 + max(before, default=0))
    kept: list[int] = []
    for i in reversed(range(len(numbers))):
        wanted = (max(lengths, default=0)) - len(kept)
        if lengths[i] == wanted and (not kept or numbers[i] < kept[-1]):
            kept.append(numbers[i])
    return frozenset(kept)
