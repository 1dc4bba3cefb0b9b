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
    from rebsync.properties import Properties
    from rebsync.static import Analysis


def read_problem(model: str, property_file: str | None, *, untimed: bool = False) -> Problem:
    """A model and its properties: those of `property_file`, else of the file beside the model.

    Mistakes of either are RebsyncErrors; warnings are what `lint` is for.
    """
    from rebsync.checker.problem import Problem
    from rebsync.properties import Properties

    if Path(model).suffix == PROPERTY:
        raise click.UsageError(
            f'"{model}" holds properties: name the model, and these with --property'
        )
    source = read_source(model)
    analysis = analysed(source, untimed=untimed)
    path = _beside(model) if property_file is None else property_file
    if path is None:
        return Problem(source, analysis, Properties())
    properties = read_source(path)
    return Problem(source, analysis, properties_of(properties, analysis), properties)


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
