"""Reading what is to be verified or simulated."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rebsync.cli.options import refuse_to_overwrite
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.files import PROPERTY, STANDARD_INPUT, read_source
from rebsync.source import Source

if TYPE_CHECKING:
    from rebsync.checker.problem import Problem
    from rebsync.properties import Formula, Properties
    from rebsync.static import Analysis


def read_problem(model: str, property_file: str | None, *, untimed: bool = False) -> Problem:
    """A model and its properties: those of `property_file`, else of the file beside the model.

    Mistakes of either are RebsyncErrors; warnings are what `lint` is for.
    """
    if Path(model).suffix == PROPERTY:
        raise click.UsageError(
            f'"{model}" holds properties: name the model, and these with --property'
        )
    source = read_source(model)
    path = _beside(model) if property_file is None else property_file
    return problem_of(source, read_source(path) if path is not None else None, untimed=untimed)


def problem_of(model: Source, properties: Source | None, *, untimed: bool = False) -> Problem:
    """What the texts of a model and of its properties say. RebsyncError: they have mistakes."""
    from rebsync.checker.problem import Problem
    from rebsync.properties import Properties

    analysis = analysed(model, untimed=untimed)
    if properties is None:
        return Problem(model, analysis, Properties())
    return Problem(model, analysis, properties_of(properties, analysis), properties)


def measured(
    problem: Problem, texts: tuple[str, ...], events: tuple[tuple[str, str], ...] = ()
) -> Problem:
    """The problem with expressions, and times between two events, to be measured.

    RebsyncError: they have mistakes.
    """
    from rebsync.properties import Measure, TimeBetween

    measures = (Measure(_one_line(text), _expression(text, problem)) for text in texts)
    between = (
        TimeBetween(
            f"time from {_one_line(start)} to {_one_line(end)}",
            _expression(start, problem, is_event=True),
            _expression(end, problem, is_event=True),
        )
        for start, end in events
    )
    return replace(problem, measures=tuple(measures), between=tuple(between))


def _one_line(text: str) -> str:
    return " ".join(text.split())


def _expression(text: str, problem: Problem, *, is_event: bool = False) -> Formula:
    from rebsync.grammars.properties import parse_properties
    from rebsync.property_check import check_measure

    option = "--time-between" if is_event else "--measure"
    source = Source(option, f"property {{ define {{ measure =\n{text}\n; }} }}")
    parsed = parse_properties(source)
    refuse(source, parsed.diagnostics)
    found = parsed.properties
    if len(found.defines) != 1 or found.all:
        raise click.UsageError(f'{option} takes one expression, not "{text}"')
    value = found.defines[0].value
    checked = problem.properties, problem.analysis
    refuse(source, check_measure(value, *checked, is_event=is_event))
    return value


def with_text(problem: Problem, text: str) -> Problem:
    """The problem with another text of its model, which has no mistakes."""
    source = Source(problem.source.path, text)
    analysis = analysed(source)
    properties = problem.property_source
    if properties is None:
        return replace(problem, source=source, analysis=analysis)
    checked = properties_of(properties, analysis)
    return replace(problem, source=source, analysis=analysis, properties=checked)


def keep_what_is_read(problem: Problem, *written: str | None, replayed: str | None = None) -> None:
    """A RebsyncError when a file that will be written is one that was read."""
    properties = problem.property_source
    read = (problem.source.path, properties.path if properties else None, replayed)
    for output in filter(None, written):
        for given in filter(None, read):
            refuse_to_overwrite(given, output)


def _beside(model: str) -> str | None:
    """The property file of a model; what is there but cannot be read is a mistake later on."""
    path = Path(model).with_suffix(PROPERTY)
    return str(path) if model != STANDARD_INPUT and os.path.lexists(path) else None


def analysed(source: Source, *, untimed: bool = False) -> Analysis:
    """A model without mistakes. RebsyncError: it has some."""
    from rebsync.checker.sizes import check_sizes
    from rebsync.grammars.parser import parse_model
    from rebsync.static import analyse

    parsed = parse_model(source)
    model = parsed.model
    if "feature" in source.text:
        from rebsync.checker.features import with_features

        model = with_features(model)
    if untimed:
        from rebsync.checker.initial import with_initial

        model = with_initial(model)
    analysis = analyse(model, incomplete=not parsed.ok)
    refuse(source, (*parsed.diagnostics, *analysis.diagnostics))
    refuse(source, check_sizes(analysis))
    if untimed:
        from rebsync.checker.untimed import check_untimed

        refuse(source, check_untimed(analysis))
    return analysis


def properties_of(source: Source, analysis: Analysis) -> Properties:
    """The properties in a text, checked against a model. RebsyncError: they have mistakes."""

    from rebsync.grammars.properties import parse_properties
    from rebsync.property_check import check_properties

    parsed = parse_properties(source)
    found = check_properties(parsed.properties, analysis, incomplete=not parsed.complete)
    refuse(source, (*parsed.diagnostics, *found))
    return parsed.properties


def refuse(source: Source, found: tuple[Diagnostic, ...]) -> None:
    """A RebsyncError if there are mistakes among what was found."""
    errors = tuple(d for d in dict.fromkeys(found) if d.severity is Severity.ERROR)
    if errors:
        raise RebsyncError([Findings(source, errors)])
