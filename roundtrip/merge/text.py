"""Merges texts line by line, three ways, with the conflict markers of git."""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterator, Sequence
from difflib import SequenceMatcher
from posixpath import commonprefix

from rebsync.records import dataclass

_LINE = re.compile(r"[^\n]*\n|[^\n]+")
# A comment at the end of a line of C++ or Python; `a // b` of Python is none.
_BESIDE = re.compile(r"(?<=[;{},:])[ \t]*//|(?<=\S)[ \t]+#")


@dataclass(frozen=True, slots=True)
class MergedText:
    """A merged text; with `conflicts` there are as many places in it with conflict markers."""

    text: str
    conflicts: int = 0


def merged_text(ours: str, base: str, theirs: str, labels: tuple[str, str]) -> MergedText:
    """Both changes of a text; where they touch, both sides between conflict markers.

    What both left alone divides the texts into parts (diff3: Khanna, Kunal and Pierce, A formal
    investigation of diff3, 2007). Code and the comments at the ends of its lines merge apart.
    """
    lines = [_lines(text) for text in (ours, base, theirs)]
    out: list[str] = []
    conflicts = 0
    for places in aligned(*lines):
        mine, old, new = (text[place] for text, place in zip(lines, places, strict=True))
        if mine == new or new == old:
            out += mine
        elif mine == old:
            out += new
        elif (both := _merged_apart(mine, old, new)) is not None:
            out += both
        else:
            first, last = _common_ends(mine, new)
            out += mine[:first]
            out += _conflict(mine[first : len(mine) - last], new[first : len(new) - last], labels)
            out += mine[len(mine) - last :]
            conflicts += 1
    return MergedText("".join(out), conflicts)


def _lines(text: str) -> list[str]:
    """The lines of a text, each with its end; a form feed, say, ends none."""
    return _LINE.findall(text)


def _common_ends(ours: list[str], theirs: list[str]) -> tuple[int, int]:
    """How many lines two sides begin, and end, with in common."""
    first = len(commonprefix([ours, theirs]))
    return first, len(commonprefix([ours[first:][::-1], theirs[first:][::-1]]))


def decided(text: str, labels: tuple[str, str], first: bool) -> str:
    """A merged text with the first or the second side of each conflict."""
    out: list[str] = []
    side = 0
    for line in _lines(text):
        plain = line.rstrip("\r\n")
        if plain == f"<<<<<<< {labels[0]}":
            side = 1
        elif side == 1 and plain == "=======":
            side = 2
        elif side == 2 and plain == f">>>>>>> {labels[1]}":
            side = 0
        elif not side or (side == 1) is first:
            out.append(line)
    return "".join(out)


def agreed_lines(merged: MergedText, labels: tuple[str, str]) -> int:
    """How many lines of a merged text are not in conflict."""
    sides = sum(decided(merged.text, labels, first).count("\n") for first in (True, False))
    return sides - (merged.text.count("\n") - 3 * merged.conflicts)


def both_sides(ours: str, theirs: str, our_label: str, their_label: str) -> str:
    """A text with both sides wherever two texts differ."""
    first, second = _lines(ours), _lines(theirs)
    out: list[str] = []
    for tag, i, j, k, n in SequenceMatcher(None, first, second, autojunk=False).get_opcodes():
        if tag == "equal":
            out += first[i:j]
        else:
            out += _conflict(first[i:j], second[k:n], (our_label, their_label))
    return "".join(out)


def _merged_apart(ours: list[str], base: list[str], theirs: list[str]) -> list[str] | None:
    """Lines of which one side has changed the code and the other the comments at their ends."""
    if not len(ours) == len(base) == len(theirs):
        return None
    sides = [[split_comment(line) for line in side] for side in (ours, base, theirs)]
    (codes, notes), (old_codes, old_notes), (new_codes, new_notes) = (
        ([code for code, _ in side], [note for _, note in side]) for side in sides
    )
    if new_codes == old_codes and notes == old_notes:
        return [code + note for code, note in zip(codes, new_notes, strict=True)]
    if codes == old_codes and new_notes == old_notes:
        return [code + note for code, note in zip(new_codes, notes, strict=True)]
    return None


def split_comment(line: str) -> tuple[str, str]:
    """The code of a line, and the comment at its end with the space before it, or its end."""
    found = _BESIDE.search(line)
    at = found.start() if found is not None else len(line.rstrip("\r\n"))
    return line[:at], line[at:]


def aligned(
    ours: Sequence[Hashable], base: Sequence[Hashable], theirs: Sequence[Hashable]
) -> Iterator[tuple[slice, slice, slice]]:
    """Parts of three sequences that belong together: what all share, in turn with what not."""
    first, second = _places(base, ours), _places(base, theirs)
    at = (0, 0, 0)
    for element in range(len(base)):
        if element not in first or element not in second:
            continue
        to = (first[element], element, second[element])
        if to != at:
            yield _slices(at, to)
        at = (to[0] + 1, to[1] + 1, to[2] + 1)
        yield _slices(to, at)
    yield _slices(at, (len(ours), len(base), len(theirs)))


def _slices(start: tuple[int, int, int], end: tuple[int, int, int]) -> tuple[slice, slice, slice]:
    first, second, third = (slice(*each) for each in zip(start, end, strict=True))
    return first, second, third


def _places(base: Sequence[Hashable], text: Sequence[Hashable]) -> dict[int, int]:
    """For elements of the base those of the other that are the same."""
    blocks = SequenceMatcher(None, base, text, autojunk=False).get_matching_blocks()
    return {i + k: j + k for i, j, size in blocks for k in range(size)}


def _conflict(ours: list[str], theirs: list[str], labels: tuple[str, str]) -> Iterator[str]:
    end = "\r\n" if any(line.endswith("\r\n") for line in (*ours, *theirs)) else "\n"
    yield f"<<<<<<< {labels[0]}{end}"
    yield from _ended(ours, end)
    yield f"======={end}"
    yield from _ended(theirs, end)
    yield f">>>>>>> {labels[1]}{end}"


def _ended(lines: list[str], end: str) -> Iterator[str]:
    for line in lines:
        yield line if line.endswith("\n") else line + end
