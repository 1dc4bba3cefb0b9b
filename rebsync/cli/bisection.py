"""`rebsync verify --for-all --monotone`: bisection between the values of one constant.

The user asserts that no property changes its verdict more than once from the least value to the
greatest. Both ends are searched, then the middle of each range whose ends differ.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

import click

from rebsync.cli.swept import Swept, SweptResult
from rebsync.diagnostics import Diagnostic, Findings, Severity
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from rebsync.checker.result import Verdict

Values: TypeAlias = tuple[str, ...]
_CHECKS = ""  # stands among the properties for all that is checked in every model


def in_order(parameters: Sequence[Swept]) -> list[Values]:
    """The values of the only parameter from the least on. UsageError: they have no order."""
    if len(parameters) != 1:
        raise click.UsageError("--monotone is about the values of one --for-all")
    values = parameters[0].values
    if {"true", "false"} & set(values):
        raise click.UsageError("--monotone is about numbers")
    return [(value,) for value in sorted(values, key=Fraction)]


def bisected(
    values: Sequence[Values],
    search: Callable[[Sequence[Values]], Iterator[SweptResult]],
    warn: Callable[[str], None],
) -> Iterator[SweptResult]:
    """A result for each value; those between two that are alike are taken from the assertion.

    What contradicts it is told to `warn`, and all values are searched then, as they are where a
    search does not decide a property.
    """
    known: dict[int, SweptResult] = {}
    while wanted := _next(known, len(values)):
        known.update(zip(wanted, search([values[at] for at in wanted]), strict=True))
    for message in _contradictions([known[at] for at in sorted(known)]):
        warn(message)
    below = known[0]
    for at, value in enumerate(values):
        below = known.get(at, below)
        yield below if at in known else _assumed(value, below)


def _next(known: Mapping[int, SweptResult], count: int) -> list[int]:
    """The values to be searched next, in order; none when all gaps have ends that are alike."""
    if not known:
        return sorted({0, count - 1})
    found = {at: _verdicts(known[at]) for at in sorted(known)}
    if any(_contradictions([known[at] for at in found])) or any(
        "undetermined" in each.values() for each in found.values()
    ):
        return [at for at in range(count) if at not in known]
    return [(a + b) // 2 for a, b in pairwise(found) if b - a > 1 and found[a] != found[b]]


def _verdicts(row: SweptResult) -> dict[str, Verdict]:
    return {**dict(row.properties), _CHECKS: row.checks}


def _assumed(values: Values, below: SweptResult) -> SweptResult:
    return SweptResult(
        values, below.verdict, None, (), below.properties, (), (), 0, 0.0, below.checks, True
    )


def _contradictions(rows: Sequence[SweptResult]) -> Iterator[str]:
    """A sentence for each property whose verdict changes more than once from value to value."""
    for name in _verdicts(rows[0]):
        decided = [
            (row.values[0], verdict)
            for row in rows
            if (verdict := _verdicts(row)[name]) != "undetermined"
        ]
        turns = decided[:1] + [b for a, b in pairwise(decided) if a[1] != b[1]]
        if len(turns) > 2:
            what = f'"{name}"' if name else "what is always checked"
            told = ", ".join(f"{verdict} for {value}" for value, verdict in turns[:3])
            yield f"{what} is not monotone: {told}"


def contradiction(path: str, message: str) -> Findings:
    """The warning that a sweep contradicts --monotone."""
    hint = "all values are searched"
    found = Diagnostic("RS935", NOWHERE, message, hint, severity=Severity.WARNING)
    return Findings(Source(path, ""), (found,))
