"""Results and runs for people at a terminal: the verdict first, then why, then the figures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import takewhile
from pathlib import PurePath
from typing import TextIO

from rebsync.checker.result import Result, Verdict, Violation
from rebsync.checker.show import words
from rebsync.checker.show.flights import departures
from rebsync.checker.show.pieces import Line, columns, line, print_lines
from rebsync.checker.trace import Trace, TraceStep
from rebsync.report_text import Piece

_STYLES: dict[Verdict, str] = {
    "satisfied": "bold green",
    "violated": "bold red",
    "undetermined": "bold yellow",
}
_WRONG = "bold red"
_QUIET = "dim"
_LONG = 30  # columns of a path that is told whole with every step
_FEW = 4  # steps of a run that are told after what it has in common with the first


def print_result(result: Result, model: str, stream: TextIO, *, is_full: bool = False) -> None:
    """Writes what a verification of the model at path `model` found; as `result_lines`."""
    print_lines(result_lines(result, model, is_full=is_full), stream)


def print_trace(trace: Trace, stream: TextIO) -> None:
    """Writes a run that is no counter-example, such as a simulation's."""
    print_lines(trace_lines(trace), stream)


def result_lines(result: Result, model: str, *, is_full: bool = False) -> list[Line]:
    """The lines that show a result.

    The first run is told whole, the others only where they end, unless `is_full`.
    """
    return [
        line(Piece(model, "bold"), ": ", Piece(result.verdict, _STYLES[result.verdict])),
        *_remarks(result),
        *_properties(result),
        *_violations(result.violations, is_full=is_full),
        *_measures(result),
        *_coverage(result, model),
        *_figures(result),
    ]


def trace_lines(
    trace: Trace,
    ending: str | None = None,
    true: Sequence[Sequence[str]] = (),
    begin: int = 0,
) -> list[Line]:
    """The lines that show a run from its step `begin` on; `ending` is what is wrong at its end.

    `true` are the definitions that are true after each step.
    """
    number = max(4, *(len(str(step.number)) for step in trace.steps))
    time = max(4, *(len(str(step.time)) for step in trace.steps))
    shown = [line(Piece(f"  {'step':>{number}}  {'time':>{time}}", _QUIET))]
    for step in trace.steps[begin:]:
        wrong = step.failure is not None or (ending is not None and step is trace.steps[-1])
        repeats = trace.loop is not None and step.number > trace.loop
        gutter = Piece(">", _WRONG) if wrong else Piece("|" if repeats else " ", "yellow")
        shown += _step(step, gutter, (number, time), trace.model)
        if true and step.failure is None and true[step.number]:
            blank, names = " " * (number + time + 5), ", ".join(true[step.number])
            shown.append(line(gutter, blank, Piece(f"true: {names}", "green"), hang=number + 8))
        if step.number == trace.loop:
            shown.append(line(Piece(_loop_start(trace), "yellow"), hang=2))
    if trace.loop is not None and trace.loop != trace.steps[-1].number:
        shown.append(line(Piece(f"| back to the state after step {trace.loop}", "yellow"), hang=2))
    if ending is not None:
        shown.append(line(Piece(f"> {ending}", _WRONG), hang=2))
    return shown


def step_lines(step: TraceStep, model: str) -> list[Line]:
    """The lines that show a step of a run that is still being made."""
    return list(_step(step, Piece(" "), (4, 4), model))


def _remarks(result: Result) -> Iterator[Line]:
    if result.reason is not None:
        yield line("reason: ", result.reason, hang=2)
    for caveat in result.caveats:
        yield line(Piece("caveat: ", "bold yellow"), caveat, hang=2)


def _properties(result: Result) -> Iterator[Line]:
    if result.properties:
        yield line()
        yield line(Piece("properties", "bold"))
    wide = max((columns(name) for name, _ in result.properties), default=0)
    for name, verdict in result.properties:
        gap = " " * (wide - columns(name) + 2)
        yield line(f"  {name}{gap}", Piece(verdict, _STYLES[verdict]), hang=4)


def _violations(violations: Sequence[Violation], *, is_full: bool) -> Iterator[Line]:
    for number, violation in enumerate(violations):
        is_whole = is_full or number == 0
        yield from _violation(
            violation, 0 if is_whole else _begin(violation.trace, violations[0].trace)
        )


def _violation(violation: Violation, begin: int) -> Iterator[Line]:
    """What is wrong, and a run to it from its step `begin` on."""
    yield line()
    place = f"{violation.path}:{violation.line}: " if violation.line else ""
    yield line(
        Piece(place, "bold"),
        Piece(words.title(violation), _WRONG),
        f": {violation.message}",
        hang=2,
    )
    if violation.formula:
        yield line("  formula: ", Piece(violation.formula, "cyan"), hang=4)
    failed = any(step.failure is not None for step in violation.trace.steps)
    ending = None if failed or violation.trace.loop is not None else violation.message
    if begin:
        folded = f"  {begin} steps before are not shown: --full shows them"
        yield line(Piece(folded, _QUIET), hang=4)
    yield from trace_lines(violation.trace, ending, violation.true, begin)


def _begin(trace: Trace, first: Trace) -> int:
    """From which step on a run is told: not where it goes as the first, and its end only.

    A cycle is told whole.
    """
    pairs = zip(trace.steps, first.steps, strict=False)
    common = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
    begin = max(min(common, len(trace.steps) - 1), len(trace.steps) - _FEW)
    return begin if trace.loop is None else min(begin, trace.loop)


# --- steps -------------------------------------------------------------------------------------


def _step(step: TraceStep, gutter: Piece, wide: tuple[int, int], model: str) -> Iterator[Line]:
    """A step: its number and time, what happens, its line of the model; below, what it did."""
    number, time = wide
    lead = f" {step.number:>{number}}  {step.time:>{time}}  "
    indent = len(lead) + 1
    file = model if columns(model) <= _LONG else PurePath(model).name
    place = f"  {step.code or f'{file}:{step.line}'}" if step.line else ""
    style = _WRONG if step.failure is not None else "bold"
    yield line(
        gutter,
        Piece(lead, _QUIET),
        Piece(words.heading(step), style),
        Piece(place, _QUIET),
        hang=indent + 2,
    )
    blank = " " * (indent - 1)
    for text, text_style in _details(step):
        yield line(gutter, blank, Piece(text, text_style), hang=indent + 2)


def _details(step: TraceStep) -> Iterator[tuple[str, str]]:
    if step.choices:
        yield f"chooses {', '.join(step.choices)}", ""
    for message in departures(step):
        by = f"{message.sender} " if step.kind == "start" else ""
        yield f"{by}sends {words.sending(message, step.time)}", "cyan"
    if step.kind == "start":
        yield from ((words.values(rebec), "") for rebec in step.rebecs if rebec.variables)
    else:
        for change in step.changes:
            whose = f"{change.rebec}." if change.rebec != step.rebec else ""
            yield f"{whose}{words.difference(change)}", ""
    if step.failure is not None:
        yield step.failure, _WRONG


def _loop_start(trace: Trace) -> str:
    if trace.steps[-1].number == trace.loop:
        return "| the run stays here for ever"
    return "| from here on the run repeats for ever:"


# --- measures, coverage and figures ------------------------------------------------------------


def _measures(result: Result) -> Iterator[Line]:
    """The least and greatest values, and where the shortest runs to them end."""
    if result.measures:
        searched = "" if result.reason is None else " in what was searched"
        yield line()
        yield line(Piece(f"measures{searched}", "bold"))
    for measure in result.measures:
        yield line(f"  {measure.expression}", hang=4)
        for name, extreme in (("least", measure.least), ("greatest", measure.greatest)):
            value = (
                "none"
                if extreme is None
                else f"{words.measured(extreme):<10}  {_after(extreme.trace)}"
            )
            yield line(f"    {name:<9}{value}", hang=6)
        if measure.undefined is not None:
            yield line(Piece(f"    no value  {_after(measure.undefined)}", _WRONG), hang=6)


def _after(trace: Trace) -> str:
    last = trace.steps[-1]
    return f"after step {last.number}, time {last.until}"


def _coverage(result: Result, model: str) -> Iterator[Line]:
    coverage = result.coverage
    searched = "" if result.reason is None else " in what was searched"
    if coverage.servers or coverage.branches:
        yield line()
        yield line(Piece(f"never happened{searched}", "bold"))
    for server in coverage.servers:
        yield line(f"  {server} never runs", hang=4)
    for number, what in coverage.branches:
        yield line(f"  {model}:{number}: {what}", hang=4)
    if coverage.largest_bags:
        yield line()
        yield line(Piece("largest bags", "bold"))
    wide = max((columns(name) for name, _, _ in coverage.largest_bags), default=0)
    for name, most, capacity in coverage.largest_bags:
        yield line(f"  {name}{' ' * (wide - columns(name) + 2)}{most} of {capacity}")


def _figures(result: Result) -> Iterator[Line]:
    search = words.duration(result.search_seconds)
    temporal = result.temporal_seconds
    speed = words.rate(result.states, result.search_seconds)
    rows = {
        "states": f"{result.states:,}",
        "transitions": f"{result.transitions:,}",
        "depth": f"{result.depth:,}",
        "search": search + (f", {speed:,.0f} states/s" if speed else ""),
        "LTL and TCTL": words.duration(temporal) if temporal is not None else "",
        "build": words.duration(result.build_seconds) if result.build_seconds else "",
        "memory": words.memory(result.peak_memory_bytes),
        "engine": result.engine,
        "semantics": words.view_of(result.semantics),
    }
    yield line()
    for name, value in rows.items():
        if value:
            yield line(Piece(f"{name:<13}", _QUIET), value)
