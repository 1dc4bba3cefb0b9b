"""Times of timers and loops in the model's unit: whole numbers, or listed."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import gcd

from rebsync.records import dataclass
from rebsync.reverse.findings import Findings, NotWhole, Unread
from rebsync.reverse.graph import Place, RateFact, Resolved, TimerFact
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.unknowns import Open


@dataclass(frozen=True, slots=True)
class Times:
    """`unit` is the length of the model's unit in seconds; `fitting` one in which all are whole."""

    unit: Fraction
    fitting: Fraction

    @staticmethod
    def of(unit: Fraction, instances: Iterable[Instance]) -> Times:
        """The times of some nodes."""
        fitting = unit
        for instance in instances:
            for fact in instance.start.unit.facts:
                period = period_of(instance, fact) if isinstance(fact, TimerFact | RateFact) else 0
                if isinstance(period, Fraction) and period > 0:
                    fitting = common_measure(fitting, period)
        return Times(unit, fitting)

    def units(
        self,
        fact: TimerFact | RateFact,
        instances: Iterable[Instance],
        findings: Findings,
        within: str,
    ) -> int | None:
        """The period in units, if it is the same whole number in all nodes; else it is listed."""
        periods = {str(p): p for i in instances for p in [period_of(i, fact)]}
        for period in periods.values():
            if isinstance(period, Open):
                why = f"the period is not known: {period.why}"
                _listed(findings, fact.site.place, why, within)
                return None
            units = period / self.unit
            if units.denominator != 1:
                why = f"{_seconds(period)} s is no multiple of the model's unit of time"
                if self.unit == 1:
                    why += ", which is a second"
                fitting = common_measure(self.fitting, period)
                hint = f"set time_unit = {_seconds(fitting)} in rebsync.toml"
                place = fact.site.place
                unread = NotWhole(place.span, why, hint, period)
                findings.unreadable(place.source, unread, within)
                return None
        if len(periods) > 1:
            why = "the period differs between the nodes of this class"
            _listed(findings, fact.site.place, why, within)
            return None
        found = next(iter(periods.values()), None)
        return int(found / self.unit) if isinstance(found, Fraction) else None


def period_of(instance: Instance, fact: TimerFact | RateFact) -> Fraction | Open:
    """The period of a timer or loop in seconds."""
    if isinstance(fact, TimerFact):
        return instance.seconds(fact.period)
    frequency: Resolved = fact.hz
    hertz = instance.seconds(frequency)
    if isinstance(hertz, Open):
        return hertz
    return 1 / hertz if hertz > 0 else Open("its frequency is 0")


def _listed(findings: Findings, place: Place, why: str, within: str) -> None:
    findings.unreadable(place.source, Unread(place.span, why), within)


def common_measure(one: Fraction, other: Fraction) -> Fraction:
    """The greatest time of which both are multiples."""
    return Fraction(
        gcd(one.numerator * other.denominator, other.numerator * one.denominator),
        one.denominator * other.denominator,
    )


def _seconds(time: Fraction) -> str:
    return f"{float(time):g}" if time.denominator != 1 else str(time.numerator)
