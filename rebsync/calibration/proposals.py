"""What a model would have to allow so that its verdict covers what was measured.

The rule (docs/decisions/0045 has the reasons):

* No change where no body ended later than `slack` after its model time: what nodes are late then is
  the middleware's, it does not add up, and a model has no place for it.
* Else each time that was exceeded in a body that was so late, by more than the latency of bodies
  that do nothing, gets the values up to the measured one, in whole units, rounded up.
* The model's own value stays: a node never goes on before its model time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Literal, TypeAlias

from rebsync.calibration.times import Measured, RunTimes, Sample
from rebsync.diagnostics import Edit
from rebsync.model import Assign, Binary, Choice, Conditional, Expression, IntLiteral
from rebsync.records import dataclass
from rebsync.reverse.models.building import bare

MOST = 64  # values of one choice
_CLOSE = 1e-6

State: TypeAlias = Literal["kept", "change", "impossible"]


@dataclass(frozen=True, slots=True)
class Proposal:
    """What becomes of a place: `text` in the place of `span`; else why it stays as it is."""

    measured: Measured
    state: State
    text: str = ""
    reason: str = ""

    @property
    def edit(self) -> Edit | None:
        """The change of the model's text."""
        if self.state != "change":
            return None
        return Edit(self.measured.site.span, self.text)


@dataclass(frozen=True, slots=True)
class TimedPlace:
    """A place with its expression, and whether a choice may stand there."""

    measured: Measured
    expression: Expression
    may_choose: bool


def proposals(times: RunTimes, places: Iterable[TimedPlace]) -> tuple[Proposal, ...]:
    """What is proposed for each delay and `after` of a model."""
    return tuple(_proposal(times, place) for place in places)


def _proposal(times: RunTimes, place: TimedPlace) -> Proposal:
    measured = place.measured
    if not measured.samples:
        return Proposal(measured, "kept", reason="it was not measured")
    needed = dict(_needed(times, measured.samples))
    if not needed:
        return Proposal(measured, "kept", reason=_in_time(times, measured))
    text = _allowing(place.expression, measured.site.text, needed)
    if text is None:
        return Proposal(measured, "kept", reason="the model allows it already")
    if not place.may_choose:
        reason = "only a message server can choose: write the delay in one"
        return Proposal(measured, "impossible", reason=reason)
    if max(extra for extra in needed.values()) >= MOST:
        reason = f"{MOST} values are not enough: choose a larger time unit, or a larger time"
        return Proposal(measured, "impossible", reason=reason)
    return Proposal(measured, "change", text)


def _in_time(times: RunTimes, measured: Measured) -> str:
    latest = max(sample.late for sample in measured.samples)
    if latest <= times.slack:
        return f"no body ends more than the slack after its time ({max(latest, 0.0):.2f} units)"
    return "it takes what the model says, and is late because others are"


def _needed(times: RunTimes, samples: Sequence[Sample]) -> Iterator[tuple[int, int]]:
    """For values of the model, by how many units they are exceeded."""
    if not any(_is_slow(times, sample) for sample in samples):
        return
    most: dict[int, int] = {}
    for sample in samples:
        over = sample.excess - times.latency
        if over > _CLOSE:
            most[sample.model] = max(most.get(sample.model, 0), math.ceil(over - _CLOSE))
    yield from most.items()


def _is_slow(times: RunTimes, sample: Sample) -> bool:
    """Whether a body was later than the slack, and was so by itself."""
    return sample.late > times.slack and sample.excess > times.latency + _CLOSE


# --- expressions -------------------------------------------------------------------------------


def _allowing(expression: Expression, text: str, needed: dict[int, int]) -> str | None:
    """The expression with more values; None where it has them."""
    inner = bare(expression)
    values = _literals(inner)
    if values is not None:
        wanted = {v for value, extra in needed.items() for v in range(value, value + extra + 1)}
        every = sorted({*values, *wanted})
        return None if set(values) >= wanted else f"?({', '.join(map(str, every))})"
    extra = max(needed.values())
    if isinstance(inner, Binary) and inner.operator == "+":
        choice = _literals(bare(inner.right))
        if isinstance(bare(inner.right), Choice) and choice is not None and 0 in choice:
            if set(range(extra + 1)) <= set(choice):
                return None
            start = expression.span.start
            left = text[inner.left.span.start - start : inner.left.span.end - start]
            return f"{left} + {_choice({*choice, *range(extra + 1)})}"
    simple = not isinstance(inner, Binary) or inner.operator in ("+", "-", "*", "/", "%")
    whole = text if simple and not _is_low(inner) else f"({text})"
    return f"{whole} + {_choice(range(extra + 1))}"


def _choice(values: Iterable[int]) -> str:
    return f"?({', '.join(map(str, sorted(set(values))))})"


def _literals(expression: Expression) -> list[int] | None:
    """The values of a literal, or of a choice of literals."""
    match expression:
        case IntLiteral(value):
            return [value]
        case Choice(options):
            found = [o.value for o in map(bare, options) if isinstance(o, IntLiteral)]
            return found if len(found) == len(options) else None
        case _:
            return None


def _is_low(expression: Expression) -> bool:
    """Whether an expression binds weaker than `+`, so that it needs parentheses."""
    return isinstance(expression, (Assign, Conditional))
