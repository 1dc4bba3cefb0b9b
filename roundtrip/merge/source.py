"""Merges edited code three ways: line by line, and by its units where lines are in conflict."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from typing import TypeAlias

from rebsync.reverse.syntax.code_units import CodeUnit
from rebsync.roundtrip.merge.text import (
    MergedText,
    agreed_lines,
    both_sides,
    decided,
    merged_text,
    split_comment,
)

_CPP = (".cpp", ".cc", ".cxx", ".h", ".hh", ".hpp", ".hxx")
_Sides: TypeAlias = "tuple[CodeUnit, CodeUnit, CodeUnit]"
_Reader: TypeAlias = "Callable[[str], CodeUnit | None]"


def merged_source(
    path: str,
    texts: tuple[str, str, str],
    labels: tuple[str, str],
    favour: str = "markers",
) -> MergedText:
    """Both changes of a file, `texts` being ours, the base and theirs; favours as in `merged_text`.

    Code that is merged line by line without a conflict stays so, unless it does not parse then or
    says twice what neither side does: a statement that each side has moved elsewhere. What cannot
    be merged by its units either has both sides wherever they differ.
    """
    merged = _merged(path, texts, labels)
    if not merged.conflicts or favour == "markers":
        return merged
    return MergedText(decided(merged.text, labels, favour == "theirs"))


def _merged(path: str, texts: tuple[str, str, str], labels: tuple[str, str]) -> MergedText:
    by_lines = merged_text(*texts, labels)
    reader = _reader(path, texts[0]) if by_lines.text not in texts else None
    sides = _sides(texts, reader) if reader is not None else None
    if reader is None or sides is None:
        return by_lines
    if not by_lines.conflicts and _is_sound(by_lines, sides, labels, reader):
        return by_lines
    from rebsync.roundtrip.merge.units import merged_unit

    by_units = merged_unit(*sides, labels)
    agreed = [agreed_lines(merged, labels) for merged in (by_units, by_lines)]
    if by_units.conflicts and by_lines.conflicts and agreed[0] <= agreed[1]:
        return by_lines
    if _is_sound(by_units, sides, labels, reader):
        return by_units
    if by_lines.conflicts:
        return by_lines
    both = both_sides(texts[0], texts[2], *labels)
    return MergedText(both, both.count(f"<<<<<<< {labels[0]}\n"))


def _sides(texts: tuple[str, str, str], reader: _Reader) -> _Sides | None:
    """The units of three texts; None where one of them does not parse."""
    if (ours := reader(texts[0])) is None or (base := reader(texts[1])) is None:
        return None
    theirs = reader(texts[2])
    return (ours, base, theirs) if theirs is not None else None


def _reader(path: str, text: str) -> _Reader | None:
    """What finds the units of a file in its language; None for other files."""
    if path.endswith(_CPP):
        from rebsync.reverse.syntax.cpp_units import cpp_units

        return cpp_units
    if path.endswith(".py") or (text.startswith("#!") and "python" in text.partition("\n")[0]):
        from rebsync.reverse.python.values.py_units import py_units

        return py_units
    return None


def _is_whole(merged: CodeUnit | None, sides: _Sides) -> bool:
    """Whether a merged text parses, and declares nothing more often than the sides do."""
    if merged is None:
        return False
    found, ours, theirs = (Counter(_declared(unit)) for unit in (merged, sides[0], sides[2]))
    return found <= ours | theirs | Counter(found.keys())


def _declared(unit: CodeUnit, path: str = "") -> Iterator[str]:
    """The keys of all units, each with those of the units around it."""
    for each in unit.inside:
        if each.key:
            yield f"{path}/{each.key}"
            yield from _declared(each, f"{path}/{each.key}")


# --- nothing is lost, nothing is doubled --------------------------------------------------------


def _is_sound(merged: MergedText, sides: _Sides, labels: tuple[str, str], reader: _Reader) -> bool:
    """Whether a text has all of both sides, once, and parses, with either side of a conflict."""
    ours, base, theirs = (Counter(_said(side)) for side in sides)
    if not merged.conflicts:
        whole = reader(merged.text)
        return (
            _is_whole(whole, sides)
            and whole is not None
            and _has_all(Counter(_said(whole)), ours, base, theirs)
        )
    for first in (True, False):
        whole = reader(decided(merged.text, labels, first))
        if whole is None:
            return False
        here, there = (ours, theirs) if first else (theirs, ours)
        if not _has_some(Counter(_said(whole)), here, base, there):
            return False
    return True


def _said(unit: CodeUnit) -> Iterator[str]:
    """The lines of a unit that are not empty, comments at their ends apart; what is imported."""
    if unit.inside:
        for each in unit.inside:
            yield from _said(each)
    elif unit.names:
        yield from unit.names
    else:
        for line in unit.text.split("\n"):
            yield from (part.strip() for part in split_comment(line) if part.strip())


def _has_all(
    merged: Counter[str], ours: Counter[str], base: Counter[str], theirs: Counter[str]
) -> bool:
    """Whether each line is there as often as both changes together make it.

    Of what both sides add, or leave out, any number may be the same change.
    """
    for line in {*merged, *ours, *base, *theirs}:
        mine, new = ours[line] - base[line], theirs[line] - base[line]
        least, most = sorted((mine + new, max(mine, new) if mine > 0 < new else mine + new))
        if mine < 0 > new:
            most = min(mine, new)
        if not least <= merged[line] - base[line] <= most:
            return False
    return True


def _has_some(
    merged: Counter[str], here: Counter[str], base: Counter[str], there: Counter[str]
) -> bool:
    """Whether each line is there as often as one side has it, with some changes of the other."""
    for line in {*merged, *here, *base, *there}:
        change = there[line] - base[line]
        if not min(change, 0) <= merged[line] - here[line] <= max(change, 0):
            return False
    return True
