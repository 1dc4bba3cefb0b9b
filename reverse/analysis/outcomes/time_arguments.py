"""Whether numbers that become times of client libraries may be none."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias

from rebsync.intervals import Interval
from rebsync.reverse.analysis.client_times import ClientTimes
from rebsync.reverse.analysis.numbers.source_numbers import SourceNumbers
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.libraries.outcome_rules import Raises

_LAST = (1 << 31) - 1
_SECOND = 1_000_000_000  # in units of 1e-9 s
_SLOWEST = 1e-6  # of rates
OfTime: TypeAlias = Literal[
    Raises.BEFORE_START, Raises.BEYOND_SPAN, Raises.NEGATIVE_PAIR, Raises.NO_RATE
]


OF_TIMES = frozenset(
    {Raises.BEFORE_START, Raises.BEYOND_SPAN, Raises.NEGATIVE_PAIR, Raises.NO_RATE}
)


class TimeArguments:
    """The arguments of calls in one function."""

    def __init__(self, origins: Origins, function: str) -> None:
        self._times = ClientTimes(origins)
        self._numbers = SourceNumbers(origins)
        self._function = function

    def are_beyond(self, values: Sequence[e.Expression], when: OfTime) -> bool:
        """Whether a call may get numbers for which a rule says that it raises."""
        if not values or self._times.of(values[0], self._function):
            return False
        match when:
            case Raises.NEGATIVE_PAIR:
                is_pair = len(values) > 1 and self._numbers.is_number(values[1], self._function)
                return is_pair and not self._is_within(values[0], 0, _LAST)
            case Raises.NO_RATE:
                numbers = self._numbers.of(values[0], self._function)
                return not numbers or not all(n >= _SLOWEST for n in numbers)
            case Raises.BEFORE_START | Raises.BEYOND_SPAN:
                least = 0 if when is Raises.BEFORE_START else -_LAST
                if len(values) > 1 and not self._is_within(values[1], 0, _SECOND):
                    return True
                return not self._is_within(values[0], least, _LAST)

    def _is_within(self, value: e.Expression, least: int, most: int) -> bool:
        """Whether a number is between two others, by the source or by its type."""
        numbers = self._numbers.of(value, self._function)
        if numbers:
            return all(least <= n <= most for n in numbers)
        of: e.Expression = value
        while isinstance(of, e.Convert | e.AddressOf):
            of = of.operand if isinstance(of, e.Convert) else of.target
        type_ = getattr(of, "type", t.UNKNOWN)
        if not isinstance(type_, t.Integer) or type_.bits is None:
            return False
        bits = type_.bits - type_.signed
        lowest = -(1 << bits) + 1 if type_.signed else 0
        return Interval(least, most).includes(Interval(lowest, (1 << bits) - 1))
