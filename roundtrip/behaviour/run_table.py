"""A run as a table: what happens in each step, with its place in the model and in the code."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

from rebsync.checker.result import Violation
from rebsync.checker.show import words
from rebsync.checker.show.flights import departures
from rebsync.checker.trace import TraceStep
from rebsync.roundtrip.diff.correspondence import Both
from rebsync.roundtrip.diff.difference import Place

_HEAD = ("step", "time", "", "model", "code")
_SHORT = 16  # steps of a run that is told whole
_END = 8  # steps at the end of a long run that are told
_NOWHERE = Both(None, None)
_WORD = re.compile(r"\w+")


def run_table(
    violation: Violation, places: dict[int, Both], subject: str, *, is_full: bool
) -> Iterator[str]:
    """The lines that show a run, and which of its steps is the bad one.

    `places` are those of the lines of the extracted model. `subject` is the text that names what a
    property is about. Of a long run only the steps that matter are told, unless it is `is_full`.
    """
    steps = violation.trace.steps
    told = {step.number for step in steps} if is_full else _what_matters(violation, subject)
    bad = _bad_step(violation)
    rows = {s.number: _row(s, places, violation if s is bad else None) for s in steps}
    shown = [_HEAD, *(row for number, row in rows.items() if number in told)]
    wide = [max(len(row[i]) for row in shown) for i in range(5)]
    yield _laid_out(_HEAD, wide)
    for is_told, group in groupby(steps, lambda s: s.number in told):
        if is_told:
            for step in group:
                yield from _step_lines(step, rows[step.number], wide, step is bad)
                if step.number == violation.trace.loop:
                    yield "    from here on the run repeats for ever"
        else:
            left = words.counted(sum(1 for _ in group), "step")
            yield f"    {'...':>{wide[0]}}  {left} more; --full shows all"


def _what_matters(violation: Violation, subject: str) -> set[int]:
    """The steps by which a run is understood: its end, and where its last values come from.

    Those are the steps that set the variables that the property names last, what repeats, and
    what fails.
    """
    steps = violation.trace.steps
    if len(steps) <= _SHORT:
        return {step.number for step in steps}
    named = set(_WORD.findall(subject))
    last = {
        (c.rebec, c.variable): step.number
        for step in steps
        for c in step.changes
        if step.kind != "start" and {c.rebec, c.variable.partition("[")[0]} <= named
    }
    found = {steps[0].number, *last.values(), *(s.number for s in steps[-_END:])}
    found |= {step.number for step in steps if step.failure is not None}
    return found if violation.trace.loop is None else {*found, violation.trace.loop}


def _bad_step(violation: Violation) -> TraceStep | None:
    """The step after which something is wrong; None where a run is wrong that goes on for ever."""
    failed = next((s for s in violation.trace.steps if s.failure is not None), None)
    if failed is not None or violation.trace.loop is not None:
        return failed
    return violation.trace.steps[-1]


def _step_lines(
    step: TraceStep, row: tuple[str, ...], wide: list[int], is_bad: bool
) -> Iterator[str]:
    yield _laid_out(row, wide, "  > " if is_bad else "    ")
    for text in _details(step):
        yield f"    {'':{wide[0]}}  {'':{wide[1]}}    {text}"


def _laid_out(row: tuple[str, ...], wide: list[int], lead: str = "    ") -> str:
    step, time, what, model, code = row
    line = (
        f"{lead}{step:>{wide[0]}}  {time:>{wide[1]}}  {what:{wide[2]}}  {model:{wide[3]}}  {code}"
    )
    return line.rstrip()


def _row(step: TraceStep, places: dict[int, Both], bad: Violation | None) -> tuple[str, ...]:
    """A step; that after which something is wrong says in the column of the code what is."""
    both = places.get(step.line, _NOWHERE)
    model, code = (
        _shown(p) if p is not None else "-" if step.line else "" for p in (both.model, both.code)
    )
    if bad is not None:
        code = f"{code}  <-- {words.title(bad)}".lstrip()
    return (str(step.number), str(step.time), words.heading(step), model, code)


def _shown(place: Place) -> str:
    """A place from the current directory, if its path leads through that."""
    path, here = Path(place.source.path), os.getcwd()  # noqa: PTH109
    if path.is_absolute() and here in map(str, path.parents):
        return str(place).replace(str(path), os.path.relpath(path), 1)
    return str(place)


def _details(step: TraceStep) -> Iterator[str]:
    if step.choices:
        yield f"chooses {', '.join(step.choices)}"
    for message in departures(step):
        yield f"sends {words.sending(message, step.time)}"
    if step.kind != "start":
        for change in step.changes:
            whose = f"{change.rebec}." if change.rebec != step.rebec else ""
            yield f"{whose}{words.difference(change)}"
    if step.failure is not None:
        yield step.failure
