"""Merges units of code, three ways: declarations by what they declare, the rest line by line."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from rebsync.records import dataclass
from rebsync.reverse.syntax.code_units import NO_UNIT, CodeUnit
from rebsync.roundtrip.merge.order import (
    Ordered,
    Token,
    UnitGroup,
    listed,
    split_gap,
    with_additions,
    with_edits,
)
from rebsync.roundtrip.merge.text import MergedText, aligned, merged_text


def merged_unit(
    ours: CodeUnit, base: CodeUnit, theirs: CodeUnit, labels: tuple[str, str]
) -> MergedText:
    """Both changes of a unit; where they touch, both sides between conflict markers."""
    if theirs.text in (base.text, ours.text):
        return MergedText(ours.text)
    if ours.text == base.text:
        return MergedText(theirs.text)
    if ours.inside and base.inside and theirs.inside:
        mine, old, new = (_KeyedUnits.of(unit.inside) for unit in (ours, base, theirs))
        return _joined(_Merge(mine, old, new, labels).parts())
    return _leaf(ours, base, theirs, labels)


def _leaf(ours: CodeUnit, base: CodeUnit, theirs: CodeUnit, labels: tuple[str, str]) -> MergedText:
    """Lines without units; the empty ones above them are no reason for a conflict."""
    (gap, mine), (old_gap, old), (new_gap, new) = (split_gap(u.text) for u in (ours, base, theirs))
    gap = new_gap if gap == old_gap else gap
    merged = merged_text(mine, old, new, labels)
    if merged.conflicts and ours.names and theirs.names:
        from rebsync.reverse.python.values.py_import_sets import merged_imports

        joined = merged_imports(mine, old, new)
        merged = merged if joined is None else MergedText(joined)
    return MergedText(gap + merged.text, merged.conflicts)


def _joined(parts: Iterable[MergedText]) -> MergedText:
    found = list(parts)
    return MergedText("".join(p.text for p in found), sum(p.conflicts for p in found))


@dataclass(frozen=True, slots=True)
class _KeyedUnits:
    """The units of a body with what tells them apart: the key, or the text of what has none."""

    tokens: tuple[Token, ...]
    by_token: dict[Token, CodeUnit]
    units: tuple[CodeUnit, ...]

    @classmethod
    def of(cls, units: Sequence[CodeUnit]) -> _KeyedUnits:
        keys = Counter(unit.key for unit in units)
        tokens = tuple(
            (u.key, "") if u.key and keys[u.key] == 1 else ("", split_gap(u.text)[1]) for u in units
        )
        return cls(tokens, {t: u for t, u in zip(tokens, units, strict=True) if t[0]}, tuple(units))


@dataclass(frozen=True, slots=True, eq=False)
class _Merge:
    """The merge of three bodies; units with a key go by it, wherever they stand."""

    ours: _KeyedUnits
    base: _KeyedUnits
    theirs: _KeyedUnits
    labels: tuple[str, str]

    def parts(self) -> Iterator[MergedText]:
        """The merged texts, one behind the other."""
        bodies = (self.ours, self.base, self.theirs)
        merged: set[Token] = set()
        for places in aligned(*(body.tokens for body in bodies)):
            ours, base, theirs = (
                UnitGroup(body.tokens[place], body.units[place])
                for body, place in zip(bodies, places, strict=True)
            )
            order = self._order(ours, base, theirs)
            if order is None:
                yield merged_text(ours.text, base.text, theirs.text, self.labels)
            elif len(base.tokens) == 1 and ours.tokens == base.tokens == theirs.tokens:
                merged |= {token for token in base.tokens if token[0]}
                yield merged_unit(ours.units[0], base.units[0], theirs.units[0], self.labels)
            else:
                for token, unit in order:
                    if token not in merged:
                        yield self._unit(token, unit)
                    merged |= {token} if token[0] else set()

    def _unit(self, token: Token, unit: CodeUnit) -> MergedText:
        """What becomes of a unit of either side, of which `unit` is one."""
        mine, old, new = (b.by_token.get(token) for b in (self.ours, self.base, self.theirs))
        if mine is not None and new is not None:
            return merged_unit(mine, old or NO_UNIT, new, self.labels)
        # what one side has left out is as the other had it
        return MergedText("") if old is not None else MergedText(unit.text)

    def _order(self, ours: UnitGroup, base: UnitGroup, theirs: UnitGroup) -> Ordered | None:
        """The units of a part in their order; None where both sides are to be compared by lines."""
        if self._is_disputed(ours, base, theirs):
            return None
        if theirs.tokens in (base.tokens, ours.tokens):
            return listed(ours)
        if ours.tokens == base.tokens:
            return listed(theirs)
        if all(key for part in (ours, base, theirs) for key, _ in part.tokens):
            return with_additions(ours, base, theirs)
        return with_edits(ours, base, theirs)

    def _is_disputed(self, ours: UnitGroup, base: UnitGroup, theirs: UnitGroup) -> bool:
        """Whether one side has changed or renamed what the other has renamed or left out."""
        for token, unit in listed(base):
            mine, new = (b.by_token.get(token) for b in (self.ours, self.theirs))
            if not token[0] or (mine is not None and new is not None):
                continue
            left = mine if mine is not None else new
            if left is not None and left.text != unit.text:
                return True
            if left is None and ours.tokens != theirs.tokens and {*ours.tokens, *theirs.tokens}:
                return True
        return False
