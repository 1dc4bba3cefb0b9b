"""The least and greatest values that a search has seen, with runs to them."""

from __future__ import annotations

from collections.abc import Callable

from rebsync.checker.exploration import Extremes
from rebsync.checker.result import Extreme, MeasureRange
from rebsync.checker.trace import Trace
from rebsync.properties import Measure


def measure_ranges(
    measures: tuple[Measure, ...], found: tuple[Extremes, ...], run_to: Callable[[int], Trace]
) -> tuple[MeasureRange, ...]:
    """The ranges of measures; `run_to` gives a shortest run to a state."""

    def extreme(value: int, state: int) -> Extreme | None:
        return Extreme(value, run_to(state)) if state >= 0 else None

    return tuple(
        MeasureRange(
            measure.text,
            extreme(known.least, known.least_state),
            extreme(known.greatest, known.greatest_state),
            run_to(known.undefined) if known.undefined >= 0 else None,
        )
        for measure, known in zip(measures, found, strict=True)
    )


def unmeasured(measures: tuple[Measure, ...]) -> tuple[MeasureRange, ...]:
    """The ranges when no state was seen."""
    return tuple(MeasureRange(measure.text, None, None, None) for measure in measures)
