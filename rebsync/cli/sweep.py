"""`rebsync verify --for-all`: a parameter sweep, one search for each value of constants."""

from __future__ import annotations

import re
import signal
import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import product
from math import prod
from typing import TYPE_CHECKING, TypeAlias

import click

from rebsync.checker.show import words
from rebsync.cli.options import write_output
from rebsync.cli.status import STATUS_OF, Status, worst
from rebsync.cli.swept import Swept, SweptResult
from rebsync.diagnostics import RebsyncError, did_you_mean
from rebsync.source import Source
from rebsync.statements import Declarator

if TYPE_CHECKING:
    from rebsync.checker.problem import Options, Problem
    from rebsync.checker.result import Extreme, Result, Verdict

_MOST = 10_000  # searches
_PARAMETER = re.compile(r"\s*(?:env\.)?([A-Za-z_]\w*)\s*=(.*)", re.DOTALL)
_RANGE = re.compile(r"\s*(-?\d{1,18})\s*\.\.\s*(-?\d{1,18})\s*")
_VALUE = re.compile(r"-?\d{1,18}(\.\d{1,18})?|true|false")

Asked: TypeAlias = tuple[tuple[str, ...], tuple[tuple[str, str], ...]]

_interrupted = False


def parameter(text: str) -> Swept:
    """`env.NAME=5..20` or `env.NAME=1,2,5`. UsageError: it is neither."""
    named = _PARAMETER.fullmatch(text)
    if not named:
        raise click.UsageError(f'"{text}" is not of the form env.NAME=5..20 or env.NAME=1,2,5')
    name, written = named[1], named[2]
    if bounds := _RANGE.fullmatch(written):
        low, high = int(bounds[1]), int(bounds[2])
        if not 0 <= high - low < _MOST:
            raise click.UsageError(f'"{text}" is not a range of 1 to {_MOST:,} values')
        return Swept(name, tuple(map(str, range(low, high + 1))))
    values = tuple(value.strip() for value in written.split(","))
    for value in values:
        if not _VALUE.fullmatch(value):
            raise click.UsageError(f'"{value}" in "{text}" is not a number, true or false')
    return Swept(name, tuple(dict.fromkeys(values)))


def sweep(
    problem: Problem,
    asked: Asked,
    parameters: Sequence[Swept],
    options: Options,
    *,
    untimed: bool,
    monotone: bool = False,
) -> Iterator[SweptResult]:
    """The results for all combinations of values, the last parameter changing first.

    `asked` are the texts of expressions to be measured, and of pairs of events. The searches are
    made on all processors, each within the bounds of the options; `monotone`: those of a bisection.
    RebsyncError: a constant does not exist, or may not have a value.
    """
    from rebsync.cli.bisection import bisected, in_order
    from rebsync.reverse.files.parallel import in_processes

    if len({p.name for p in parameters}) < len(parameters):
        raise click.UsageError("--for-all names a constant twice")
    if prod(len(p.values) for p in parameters) > _MOST:
        raise click.UsageError(f"--for-all asks for more than {_MOST:,} searches")
    declared = [_declared(problem, parameter.name) for parameter in parameters]
    task = partial(
        _verified, problem.source, problem.property_source, asked, declared, options, untimed
    )

    def searched(every: Iterable[tuple[str, ...]]) -> Iterator[SweptResult]:
        return in_processes(iter(every), task, lambda _: problem.source.path)

    if monotone:
        return bisected(in_order(parameters), searched, partial(_warn, problem.source.path))
    return searched(product(*(parameter.values for parameter in parameters)))


def _warn(path: str, message: str) -> None:
    """Tells people what contradicts --monotone."""
    from rebsync.cli.bisection import contradiction
    from rebsync.report import print_report

    print_report([contradiction(path, message)], sys.stderr)


def _declared(problem: Problem, name: str) -> Declarator:
    """Where the value of a constant stands. RebsyncError: nowhere, or it is an array."""
    constants = problem.analysis.env
    if name not in constants:
        message, hint = f'the model has no constant "{name}"', did_you_mean(name, constants)
        raise RebsyncError.of(problem.source.path, "RS928", message, hint)
    symbol = constants[name]
    if symbol.value is None or symbol.declaration.initial is None:
        message = f'"{name}" is not a constant with one value'
        raise RebsyncError.of(problem.source.path, "RS928", message)
    return symbol.declaration


def _verified(
    model: Source,
    properties: Source | None,
    asked: Asked,
    declared: Sequence[Declarator],
    options: Options,
    untimed: bool,
    values: tuple[str, ...],
) -> SweptResult:
    """The result for some values, in a process that Ctrl-C ends cleanly, too."""
    global _interrupted
    from rebsync.checker.verify import verify
    from rebsync.cli.problem import measured, problem_of

    if _interrupted:
        return _unfinished(values)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        source = Source(model.path, with_values(model.text, declared, values))
        problem = measured(problem_of(source, properties, untimed=untimed), *asked)
        result = verify(problem, options)
    except KeyboardInterrupt:
        _interrupted = True
        return _unfinished(values)
    _interrupted = result.reason is not None and "interrupted" in result.reason
    return _row(values, result)


def with_values(text: str, declared: Sequence[Declarator], values: Sequence[str]) -> str:
    """The text of a model with other values for constants, line by line as it was."""
    changes = sorted(
        ((d.initial.span, value) for d, value in zip(declared, values, strict=True) if d.initial),
        key=lambda change: -change[0].start,
    )
    for span, value in changes:
        text = text[: span.start] + value + text[span.end :]
    return text


def _unfinished(values: tuple[str, ...]) -> SweptResult:
    return SweptResult(
        values, "undetermined", "it was interrupted", (), (), (), (), 0, 0.0, "undetermined"
    )


def _row(values: tuple[str, ...], result: Result) -> SweptResult:
    return SweptResult(
        values,
        result.verdict,
        result.reason,
        result.caveats,
        result.properties,
        tuple((violation.kind, violation.name) for violation in result.violations),
        tuple((m.expression, _value(m.least), _value(m.greatest)) for m in result.measures),
        result.states,
        result.seconds,
        _checks(result),
    )


def _checks(result: Result) -> Verdict:
    if any(not violation.formula for violation in result.violations):
        return "violated"
    return "satisfied" if result.reason is None else "undetermined"


def _value(extreme: Extreme | None) -> int | str | None:
    if extreme is None:
        return None
    return words.NEVER if extreme.value is None else extreme.value


# --- the table -----------------------------------------------------------------------------------


def write_sweep(
    model: str, parameters: Sequence[Swept], rows: Iterator[SweptResult], style: str, output: str
) -> Status:
    """Writes the table, on standard output line by line; the status is the worst of all."""
    known: list[SweptResult] = []

    def noted() -> Iterator[SweptResult]:
        for row in rows:
            known.append(row)
            yield row

    if style == "json":
        write_output(output, sweep_json(model, parameters, noted()))
    elif style == "svg":
        write_output(output, _drawn(model, parameters, noted()))
    elif output == "-":
        for text in sweep_lines(model, parameters, noted()):
            write_output(output, text + "\n")
    else:
        write_output(output, "".join(f"{t}\n" for t in sweep_lines(model, parameters, noted())))
    return worst(STATUS_OF[row.verdict] for row in known)


def _drawn(model: str, parameters: Sequence[Swept], rows: Iterable[SweptResult]) -> str:
    from rebsync.checker.show.sweep_svg import Column, sweep_svg

    columns = [
        Column(row.values, (("verdict", row.verdict), *row.properties), row.measures, row.assumed)
        for row in rows
    ]
    return sweep_svg(model, [p.name for p in parameters], columns)


def sweep_lines(
    model: str, parameters: Sequence[Swept], rows: Iterable[SweptResult]
) -> Iterator[str]:
    """The table for people, each line when its search is done."""
    from rebsync.terminal import one_line

    wide = [max(len(p.name), *map(len, p.values)) for p in parameters]
    names = "  ".join(f"{p.name:>{w}}" for p, w in zip(parameters, wide, strict=True))
    yield one_line(f"{model}: verdicts by the values of {', '.join(p.name for p in parameters)}")
    yield ""
    yield f"  {names}  {'verdict':<12}  {'states':>12}  why"
    found: list[SweptResult] = []
    for row in rows:
        found.append(row)
        values = "  ".join(f"{v:>{w}}" for v, w in zip(row.values, wide, strict=True))
        states = "" if row.assumed else f"{row.states:,}"
        told = row.told(row.verdict)
        yield one_line(f"  {values}  {told:<12}  {states:>12}  {_why(row)}".rstrip())
    yield ""
    order = ("satisfied", "violated", "undetermined")
    every = {row.told(row.verdict): order.index(row.verdict) for row in found}
    for told in sorted(every, key=lambda told: (every[told], told)):
        count = sum(row.told(row.verdict) == told for row in found)
        yield f"{told} for {count} of {len(found)}{_which(parameters, found, told)}"
    for caveat in dict.fromkeys(caveat for row in found for caveat in row.caveats):
        yield one_line(f"caveat: {caveat}")


def _why(row: SweptResult) -> str:
    """What was measured, what is violated, and why something is undetermined."""
    why = ", ".join(dict.fromkeys(name for _, name in row.violations))
    reason = row.reason if row.reason and row.verdict != "satisfied" else ""
    ranges = ", ".join(f"{text}: {least} to {most}" for text, least, most in row.measures)
    return "; ".join(filter(None, (ranges, why, reason)))


def _which(parameters: Sequence[Swept], rows: Sequence[SweptResult], told: str) -> str:
    """The values of the only parameter of which it is told, as ranges: `: n = 5..8, 11`."""
    if len(parameters) > 1:
        return ""
    runs: list[list[str]] = []
    before = ""
    for row in rows:
        now = row.told(row.verdict)
        if now == told == before:
            runs[-1].append(row.values[0])
        elif now == told:
            runs.append([row.values[0]])
        before = now
    listed = (f"{r[0]}..{r[-1]}" if len(r) > 2 else ", ".join(r) for r in runs)
    return f": {parameters[0].name} = {', '.join(listed)}"


def sweep_json(model: str, parameters: Sequence[Swept], rows: Iterable[SweptResult]) -> str:
    """The table for other programs, described by docs/sweep.schema.json."""
    from rebsync.checker.show.data import dump, value_of

    names = [p.name for p in parameters]
    return dump(
        {
            "model": model,
            "parameters": names,
            "results": [
                {
                    "values": dict(zip(names, map(value_of, row.values), strict=True)),
                    "verdict": row.told(row.verdict),
                    "reason": row.reason,
                    "caveats": list(row.caveats),
                    "properties": {name: row.told(found) for name, found in row.properties},
                    "violations": [{"kind": kind, "name": name} for kind, name in row.violations],
                    "measures": {
                        text: {"least": least, "greatest": greatest}
                        for text, least, greatest in row.measures
                    },
                    "states": None if row.assumed else row.states,
                    "seconds": None if row.assumed else row.seconds,
                }
                for row in rows
            ],
        }
    )
