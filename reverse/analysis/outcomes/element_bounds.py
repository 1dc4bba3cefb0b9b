"""Whether a container has an element at an index, by what is known of its size and of the index."""

from __future__ import annotations

from rebsync.reverse.analysis.facts import (
    Facts,
    IsBelow,
    IsLess,
    IsSame,
    IsSize,
    bare,
    names_of,
    size_of,
)
from rebsync.reverse.analysis.numbers.number_ranges import NumberRanges
from rebsync.reverse.analysis.numbers.signs import Signs
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.operand_kinds import OperandKinds
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator


class ElementBounds:
    """Containers and indices in one function."""

    def __init__(self, notes: ProblemNotes, signs: Signs, kinds: OperandKinds) -> None:
        self._notes = notes
        self._signs = signs
        self._kinds = kinds
        self.range_of = NumberRanges(notes).of

    def size(self, container: e.Expression, facts: Facts) -> int:
        """How many elements a container has at least."""
        type_ = getattr(container, "type", None)
        length = type_.length if isinstance(type_, t.Array) else self._kinds.length(container)
        counted = self._notes.counts.size(container, self._notes.function.name)
        return max(size_of(facts, container), counted, length)

    def is_within(self, value: e.Index, facts: Facts) -> bool:
        """Whether an index is one of an element that is there."""
        size = self.size(value.object, facts)
        if isinstance(value.object, e.Local) and self._notes.is_parameter(value.object):
            size = max(size, self._notes.elements.get(self._notes.function.name, 0))
        if self._is_less(value, facts):
            return True
        from_end = value.from_end and not self._kinds.length(value.object)
        match bare(value.index):
            case e.Unary(Operator.NEGATE, e.Literal(int() as index)):
                return from_end and index <= size
            case e.Binary(Operator.FLOOR_MODULO, _, right) if size > 0:
                holders = names_of(facts, value.object)
                if any(IsSize(right, h) in facts for h in holders):
                    return True
            case index:
                bounds = (f.bound for f in facts if isinstance(f, IsBelow) and f.value == index)
                if any(bound <= size for bound in bounds):
                    return True
        found = self.range_of(value.index, facts)
        return found.high < size and found.low >= (-size if from_end else 0)

    def _is_less(self, value: e.Index, facts: Facts) -> bool:
        """Whether an index was found to be less than the size, and is not negative."""
        match bare(value.index):
            case e.Binary(Operator.SUBTRACT, left, e.Literal(int() as less)) if less > 0:
                is_above = self.range_of(left, facts).low >= less
                return is_above and self._is_below_size(left, value.object, facts)
            case e.Binary(
                Operator.TRUNCATING_DIVIDE | Operator.FLOOR_DIVIDE, left, e.Literal(int() as by)
            ):
                sizes = (IsSize(bare(left), h) in facts for h in names_of(facts, value.object))
                return by > 1 and any(sizes) and self.size(value.object, facts) > 0
        is_positive = self._signs.is_positive(value.index, facts)
        is_positive = is_positive or self.range_of(value.index, facts).low >= 0
        return is_positive and self._is_below_size(value.index, value.object, facts)

    def _is_below_size(self, index: e.Expression, container: e.Expression, facts: Facts) -> bool:
        indices = {index, bare(index)}
        indices |= {f.value for f in facts if isinstance(f, IsSame) and f.other in indices}
        others = {bare(f.other) for f in facts if isinstance(f, IsLess) and f.value in indices}
        return any(IsSize(o, h) in facts for o in others for h in names_of(facts, container))
