"""The order of units of code that both sides have added, left out or changed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from difflib import SequenceMatcher
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.syntax.code_units import CodeUnit

# What tells a unit from those around it: its key, or the text of what has none.
Token: TypeAlias = tuple[str, str]
Ordered: TypeAlias = list[tuple[Token, CodeUnit]]


@dataclass(frozen=True, slots=True)
class UnitGroup:
    """Some units of a body that stand together."""

    tokens: tuple[Token, ...]
    units: Sequence[CodeUnit]

    @property
    def text(self) -> str:
        return "".join(unit.text for unit in self.units)


def listed(part: UnitGroup) -> Ordered:
    return list(zip(part.tokens, part.units, strict=True))


def with_additions(ours: UnitGroup, base: UnitGroup, theirs: UnitGroup) -> Ordered | None:
    """What both have kept, and behind each what either has added; None where they stand apart."""
    kept = {*ours.tokens} & {*base.tokens} & {*theirs.tokens}
    mine, new = _by_kept(ours, kept), _by_kept(theirs, kept)
    if list(mine) != list(new):
        return None
    found: Ordered = []
    for before in mine:
        found += mine[before]
        for token, unit in new[before]:
            if token == before:
                continue
            is_next = bool(unit.names and found and found[-1][1].names)
            found.append((token, replace(unit, text=split_gap(unit.text)[1]) if is_next else unit))
    return found


def with_edits(ours: UnitGroup, base: UnitGroup, theirs: UnitGroup) -> Ordered | None:
    """The units of the base with the edits of both, which may touch; None where they overlap."""
    found: Ordered = []
    at, last = 0, (-1, -1)
    edits = (*_edits(base, ours), *_edits(base, theirs))
    for start, end, units in sorted(edits, key=lambda edit: edit[:2]):
        if start < at or (start, end) == last:
            return None
        found += [*listed(base)[at:start], *units]
        at, last = end, (start, end)
    return [*found, *listed(base)[at:]]


def _edits(base: UnitGroup, side: UnitGroup) -> Iterator[tuple[int, int, Ordered]]:
    """Runs of units of the base with what a side has instead; either may be empty."""
    codes = SequenceMatcher(None, base.tokens, side.tokens, autojunk=False).get_opcodes()
    for tag, start, end, first, last in codes:
        if tag != "equal":
            yield start, end, listed(side)[first:last]


def _by_kept(part: UnitGroup, kept: set[Token]) -> dict[Token | None, Ordered]:
    """The units of a part by that which both have kept, and which they stand behind."""
    found: dict[Token | None, Ordered] = {None: []}
    at: Token | None = None
    for token, unit in listed(part):
        if token in kept:
            at = token
            found[at] = []
        found[at].append((token, unit))
    return found


def split_gap(text: str) -> tuple[str, str]:
    """The empty lines with which a text begins, and the rest."""
    at = 0
    for line in text.splitlines(keepends=True):
        if line.strip():
            break
        at += len(line)
    return text[:at], text[at:]
