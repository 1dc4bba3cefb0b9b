"""Who has moved since model and code were last in step: the model, the code, or both."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from enum import Enum
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import (
    Added,
    Changed,
    Comparison,
    Difference,
    Element,
    Removed,
    Renamed,
    Undetermined,
)


class Verdict(Enum):
    """How model and code stand to each other.

    APART: they differ, and who moved cannot be told, as the model of last time is missing.
    """

    IN_STEP = "in step"
    MODEL_AHEAD = "model ahead"
    CODE_AHEAD = "code ahead"
    BOTH_MOVED = "both moved"
    CONFLICT = "conflict"
    APART = "apart"
    UNDETERMINED = "undetermined"


class Mover(Enum):
    """Whose change a difference between model and code is."""

    MODEL = "model"
    CODE = "code"
    CONFLICT = "conflict"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Drift:
    """The verdict, and what is different between today's model and the code, with the mover."""

    verdict: Verdict
    differences: tuple[tuple[Difference, Mover], ...] = ()

    @property
    def conflicts(self) -> tuple[Element, ...]:
        """The elements that both have changed, each in its own way."""
        found = (d.element for d, mover in self.differences if mover is Mover.CONFLICT)
        return tuple(dict.fromkeys(found))


def judge(apart: Comparison, of_model: Comparison | None, of_code: Comparison | None) -> Drift:
    """The verdict on what is different between today's model and what the code says.

    `of_model` and `of_code` are what each has changed since last time, None if that is not known.
    """
    if of_model is None or of_code is None:
        told = tuple((d, Mover.UNKNOWN) for d in apart.differences)
        return Drift(_without_base(apart), told)
    movers = _Movers(of_model, of_code)
    told = tuple((d, movers.mover(d)) for d in apart.differences)
    if apart.is_undetermined or of_code.is_undetermined:
        return Drift(Verdict.UNDETERMINED, told)
    if apart.is_empty:
        return Drift(Verdict.IN_STEP)
    if of_code.is_empty:
        return Drift(Verdict.MODEL_AHEAD, told)
    if of_model.is_empty:
        return Drift(Verdict.CODE_AHEAD, told)
    is_conflict = any(mover is Mover.CONFLICT for _, mover in told)
    return Drift(Verdict.CONFLICT if is_conflict else Verdict.BOTH_MOVED, told)


def undetermined(drift: Drift) -> Drift:
    """The same where something is in the code that neither model nor comparison sees."""
    return replace(drift, verdict=Verdict.UNDETERMINED)


def with_changes_of_code(drift: Drift, changes: tuple[Changed, ...]) -> Drift:
    """The same with what the code is known to have changed beside all that a model says."""
    if not changes:
        return drift
    moved = {Verdict.IN_STEP: Verdict.CODE_AHEAD, Verdict.MODEL_AHEAD: Verdict.BOTH_MOVED}
    told = tuple((change, Mover.CODE) for change in changes)
    return Drift(moved.get(drift.verdict, drift.verdict), (*drift.differences, *told))


def _without_base(apart: Comparison) -> Verdict:
    if apart.is_undetermined:
        return Verdict.UNDETERMINED
    return Verdict.IN_STEP if apart.is_empty else Verdict.APART


class _Movers:
    """Tells of each difference between model and code whose it is."""

    def __init__(self, of_model: Comparison, of_code: Comparison) -> None:
        self.model, self.code = _by_element(of_model), _by_element(of_code)
        # Differences between model and code name elements as today's model does.
        self.before = {
            _renamed(d): d.element.path for d in of_model.differences if isinstance(d, Renamed)
        }
        self.conflicts = frozenset(self._conflicts())

    def mover(self, difference: Difference) -> Mover:
        """Whose change it is."""
        element = self._before(difference.element)
        by_model, by_code = _has_touched(self.model, element), _has_touched(self.code, element)
        if isinstance(difference, Renamed):  # what both have added is not one element renamed
            by_code |= Element(element.kind, _renamed(difference)) in self.code
        if element in self.conflicts or (by_model and by_code):
            return Mover.CONFLICT
        if by_model or by_code:
            return Mover.MODEL if by_model else Mover.CODE
        return Mover.CODE if not self.model else Mover.MODEL if not self.code else Mover.UNKNOWN

    def _before(self, element: Element) -> Element:
        """What an element of today's model was called last time."""
        known = self.before.get(element.path)
        if known is not None:
            return replace(element, path=known)
        head, dot, rest = element.path.partition(".")
        return replace(element, path=f"{self.before.get(head, head)}{dot}{rest}")

    def _conflicts(self) -> Iterator[Element]:
        for element in self.model.keys() & self.code.keys():
            if self.model[element] != self.code[element]:
                yield element
        for one, other in ((self.model, self.code), (self.code, self.model)):
            for element, changes in one.items():
                if any(isinstance(d, Removed) for d in changes):
                    below = [e for e in other if _is_below(e, element)]
                    yield from [element, *below] if below else []


_Changes: TypeAlias = dict[Element, set[Difference]]


def _by_element(comparison: Comparison) -> _Changes:
    """The changes of each element, wherever they are."""
    found: _Changes = {}
    for difference in comparison.differences:
        if not isinstance(difference, Undetermined):
            plain = replace(difference, left=None, right=None)
            found.setdefault(difference.element, set()).add(plain)
    return found


def _has_touched(changes: _Changes, element: Element) -> bool:
    """Whether an element is changed, or what it is in is new or gone."""
    if element in changes:
        return True
    whole = (e for e, each in changes.items() if any(isinstance(d, Added | Removed) for d in each))
    return any(_is_below(element, e) for e in whole)


def _renamed(difference: Renamed) -> str:
    """The path that an element has under its new name, which may be a whole path."""
    owner, _, _ = difference.element.path.rpartition(".")
    name = difference.name
    return f"{owner}.{name}" if owner and "." not in name else name


def _is_below(element: Element, other: Element) -> bool:
    return element.path.startswith(f"{other.path}.")
