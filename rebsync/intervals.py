"""Intervals of whole numbers: the abstract domain of Cousot and Cousot (1976).

Numbers have no bounds here, so an operator gives what it would give if nothing wrapped; whoever
knows the type of the result says what becomes of it there (`in_type`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Interval:
    """All whole numbers from `low` to `high`, both included; never empty."""

    low: int
    high: int

    def includes(self, other: Interval) -> bool:
        """Whether all numbers of another interval are in this one."""
        return self.low <= other.low and other.high <= self.high

    def join(self, other: Interval) -> Interval:
        """The least interval that includes both."""
        return Interval(min(self.low, other.low), max(self.high, other.high))

    def meet(self, other: Interval) -> Interval | None:
        """What both have; None if that is nothing."""
        low, high = max(self.low, other.low), min(self.high, other.high)
        return Interval(low, high) if low <= high else None

    def widen(self, later: Interval, thresholds: Sequence[int]) -> Interval:
        """The widening: each bound of `later` that has moved goes on to the next of `thresholds`,
        which are sorted, or stays where there is none.
        """
        low, high = later.low, later.high
        if low < self.low:
            low = max((t for t in thresholds if t <= low), default=low)
        if high > self.high:
            high = min((t for t in thresholds if t >= high), default=high)
        return Interval(low, high)

    def in_type(self, whole: Interval) -> Interval:
        """What a type whose values are `whole` makes of the numbers: any value if one may wrap."""
        return self if whole.includes(self) else whole

    @property
    def magnitude(self) -> int:
        """The greatest distance from 0."""
        return max(abs(self.low), abs(self.high))


def signed(bits: int) -> Interval:
    """The values of an integer with a sign and so many bits beside it."""
    return Interval(-(1 << bits), (1 << bits) - 1)


def unsigned(bits: int) -> Interval:
    """The values of an integer of so many bits without a sign."""
    return Interval(0, (1 << bits) - 1)


def exactly(number: int) -> Interval:
    """One number."""
    return Interval(number, number)


def around(numbers: Iterable[int]) -> Interval:
    """The least interval that includes some numbers, of which there is one at least."""
    each = list(numbers)
    return Interval(min(each), max(each))


INT32 = signed(31)
TRUTH = Interval(0, 1)
ANY = Interval(-(1 << 65), 1 << 65)  # more than any integer of 64 bits
INTEGERS = {"byte": signed(7), "short": signed(15), "int": INT32}  # the types of Timed Rebeca
_UNSIGNED = frozenset({32, 64})
_LONGEST = 64  # the distance of a shift that is followed


def of_bits(bits: int) -> Interval:
    """The values of a type of so many bits: with 32 and 64 it has no sign, else one beside them."""
    return unsigned(bits) if bits in _UNSIGNED else signed(bits)


def within_int(bits: int) -> Interval:
    """The values of such a type that the model's `int` holds."""
    return INT32.meet(of_bits(bits)) or INT32


def of_unary(operator: str, of: Interval) -> Interval:
    """What `-`, `+`, `~` or `!` gives."""
    match operator:
        case "-":
            return Interval(-of.high, -of.low)
        case "~":
            return Interval(~of.high, ~of.low)
        case "+":
            return of
        case "!":
            return TRUTH
        case _:
            return ANY


def of_binary(operator: str, left: Interval, right: Interval) -> Interval:
    """What an operator gives; `/` and `%` truncate, as those of C++ and Timed Rebeca do."""
    match operator:
        case "+":
            return Interval(left.low + right.low, left.high + right.high)
        case "-":
            return Interval(left.low - right.high, left.high - right.low)
        case "*":
            return around(a * b for a in (left.low, left.high) for b in (right.low, right.high))
        case "/":
            most = left.magnitude
            return Interval(-most if left.low < 0 or right.low < 0 else 0, most)
        case "%":
            most = min(left.magnitude, max(0, right.magnitude - 1))
            return Interval(-most if left.low < 0 else 0, most if left.high > 0 else 0)
        case "<<" | ">>":
            return _shifted(operator, left, right)
        case "&" if left.low >= 0 or right.low >= 0:
            return Interval(0, min(side.high for side in (left, right) if side.low >= 0))
        case "&" | "|" | "^":
            return _of_bits(left, right)
        case _:
            return ANY


def _shifted(operator: str, left: Interval, right: Interval) -> Interval:
    if right.low < 0 or (operator == "<<" and right.high > _LONGEST):
        return ANY
    if operator == ">>":
        return Interval(min(left.low, 0), max(left.high, 0))
    return around(a << b for a in (left.low, left.high) for b in (right.low, right.high))


def _of_bits(left: Interval, right: Interval) -> Interval:
    """No more bits than the longer operand has."""
    ends = (left.low, left.high, right.low, right.high)
    length = max(max(end, ~end).bit_length() for end in ends)
    return unsigned(length) if min(ends) >= 0 else signed(length)


def compared(left: Interval, operator: str, right: Interval) -> Interval | None:
    """The numbers of `left` of which `left operator right` can be true; None if there are none."""
    match operator:
        case "<":
            return left.meet(Interval(left.low, right.high - 1)) if left.low < right.high else None
        case "<=":
            return left.meet(Interval(left.low, right.high)) if left.low <= right.high else None
        case ">":
            return left.meet(Interval(right.low + 1, left.high)) if left.high > right.low else None
        case ">=":
            return left.meet(Interval(right.low, left.high)) if left.high >= right.low else None
        case "==":
            return left.meet(right)
        case "!=" if right.low == right.high:
            return _without(left, right.low)
        case _:
            return left


def _without(of: Interval, number: int) -> Interval | None:
    low, high = of.low + (of.low == number), of.high - (of.high == number)
    return Interval(low, high) if low <= high else None
