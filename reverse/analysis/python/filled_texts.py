"""What `%` puts into texts of Python: values in order, or those of a mapping by their names."""

from __future__ import annotations

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.numbers.magnitudes import Magnitudes
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.format_strings import (
    conversions,
    conversions_by_name,
    numbers_of,
    refuses,
)
from rebsync.reverse.analysis.python.operand_kinds import Kinds, OperandKinds
from rebsync.reverse.analysis.python.value_types import (
    ContainerType,
    OwnType,
    ValueType,
    own_type,
)
from rebsync.reverse.ir import expressions as e

_DECIMAL = frozenset("diu")  # conversions that take no infinite number
_WHOLE = frozenset("xXoc")  # conversions that take no floats


class FilledTexts:
    """The texts that one function fills in."""

    def __init__(self, notes: ProblemNotes, kinds: OperandKinds) -> None:
        self._notes = notes
        self._kinds = kinds

    def refuse(self, text: str, value: e.Expression, facts: Facts) -> bool:
        """Whether `%` may not put values into a text: too many, too few, or of another type."""
        if conversions(text) is None:
            return not self._has_names(text, value, facts)
        kinds, values = self._kinds.asked(value, facts), [value]
        if isinstance(value, e.Build) and kinds == {OwnType.TUPLE}:
            parts = [self._parts(each, facts) for each in value.elements]
            if None in parts:
                return True
            found = refuses(text, [kind for each in parts for kind in each or ()])
            counts = [len(each or ()) for each in parts]
            values = [
                v for of, n in zip(value.elements, counts, strict=True) for v in _spread(of, n)
            ]
        else:
            tuples = [t for t in self._kinds.types(value, facts) if own_type(t) is OwnType.TUPLE]
            found = any(self._puts_parts(text, each) for each in tuples)
            found |= kinds != {OwnType.TUPLE} and refuses(text, [kinds - {OwnType.TUPLE}])
        floats, name = self._notes.counts.rules.floats, self._notes.function.name
        is_float = any(floats.has(v, name) for v in numbers_of(text, values, _WHOLE))
        is_object = any(self._kinds.is_object(v, facts) for v in numbers_of(text, values))
        numbers = Magnitudes(self._notes.origins, name)
        is_finite = all(map(numbers.is_finite, numbers_of(text, values, _DECIMAL)))
        return found or is_float or is_object or not is_finite

    def _parts(self, value: e.Expression | e.Spread, facts: Facts) -> list[Kinds] | None:
        """The types of what one element of a tuple is; None: nobody knows how many these are."""
        if not isinstance(value, e.Spread):
            return [self._kinds.asked(value, facts)]
        if length := self._kinds.length(value.operand):
            element = e.Index(value.operand, e.Literal(0))
            return [self._kinds.asked(element, facts)] * length
        match [*self._kinds.types(value.operand, facts)]:
            case [ContainerType(OwnType.TUPLE, _, _, tuple() as parts)]:
                return [frozenset(map(own_type, each)) for each in parts]
            case _:
                return None

    def _puts_parts(self, text: str, type_: ValueType | None) -> bool:
        """Whether `%` may not put the parts of a tuple into a text."""
        parts = type_.parts if isinstance(type_, ContainerType) else None
        return parts is None or refuses(text, [frozenset(map(own_type, each)) for each in parts])

    def _has_names(self, text: str, value: e.Expression, facts: Facts) -> bool:
        """Whether a mapping is written here with all that a text takes from it."""
        if not isinstance(value, e.BuildMapping):
            return False
        pairs = [entry for entry in value.entries if not isinstance(entry, e.Spread)]
        known = {key.value: each for key, each in pairs if isinstance(key, e.Literal)}
        return all(
            name in known and not self.refuse(f"%{letter}", known[name], facts)
            for name, letter in conversions_by_name(text)
        )


def _spread(value: e.Expression | e.Spread, count: int) -> list[e.Expression]:
    """An element of a tuple, or each of those that it stands for."""
    if not isinstance(value, e.Spread):
        return [value]
    return [e.Index(value.operand, e.Literal(index)) for index in range(count)]
