"""Reading the code of a package as what is to be verified: extracted, and closed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rebsync.cli.paths import MODEL, PROPERTY
from rebsync.cli.problem import refuse
from rebsync.diagnostics import RebsyncError
from rebsync.files import read_source
from rebsync.source import Source

if TYPE_CHECKING:
    from rebsync.checker.problem import Problem
    from rebsync.properties import Properties
    from rebsync.reverse.environment.package import ClosedPackage, EnvironmentChoice, ReadPackage
    from rebsync.reverse.findings import Grade


def read_package(
    path: str, property_file: str | None, choice: EnvironmentChoice, written: str | None = None
) -> Problem:
    """The code of the package at a path as a closed model, with its properties.

    Mistakes of the properties are RebsyncErrors, as is code in which no node is found, or several
    packages. The model is written to the file `written`, if there is one.
    """
    from rebsync.reverse.environment.package import in_fitting_unit

    chosen = property_file if property_file is not None else _property_in(path)
    properties = read_source(chosen) if chosen is not None else None
    return _closed(path, in_fitting_unit(_files(path)), properties, choice, written)


def _property_in(path: str) -> str | None:
    """The property file of a folder, if there is one. RebsyncError: there are several."""
    found = sorted(map(str, Path(path).glob(f"*{PROPERTY}")))
    if len(found) > 1:
        hint = f"name it: --property {found[0]}"
        raise RebsyncError.of(path, "RS802", "several property files are here", hint)
    return found[0] if found else None


def read_question(
    path: str, question: str, choice: EnvironmentChoice, written: str | None = None
) -> Problem:
    """The same with a question as its only property. RebsyncError: it cannot be asked."""
    from rebsync.grammars.questions import parse_question
    from rebsync.reverse.environment.package import asked_of

    text = Source("the question", question)
    read, asked = asked_of(_files(path), text, parse_question(text))
    return _closed(path, read, Source("the question", asked), choice, written)


def _closed(
    path: str,
    read: ReadPackage,
    properties: Source | None,
    choice: EnvironmentChoice,
    written: str | None,
) -> Problem:
    from rebsync.reverse.environment.package import closed_package

    closed = closed_package(read, _parsed(properties), choice)
    if closed.model.main is None or not closed.model.classes:
        hint = "--format json of `rebsync extract` tells what the code asks of ROS"
        raise RebsyncError.of(path, "RS943", "no node of a model was found here", hint)
    return _problem(path, closed, properties, written)


def _files(path: str) -> dict[str, Source]:
    from rebsync.reverse.files.reading import read
    from rebsync.roundtrip.package.units import as_one, units

    found = list(units([path]))
    if len(found) != 1:
        models = sorted(map(str, Path(path).glob(f"*{MODEL}")))
        hint = "name one of them" if found else f"name the model: {models[0]}" if models else None
        message = "several packages are here" if found else "no code is here"
        raise RebsyncError.of(path, "RS802", message, hint)
    return read(as_one(found[0])).files


def _parsed(source: Source | None) -> Properties:
    """The properties of a file, as far as they can be told without a model."""
    from rebsync.properties import Properties

    if source is None:
        return Properties()
    from rebsync.grammars.properties import parse_properties

    parsed = parse_properties(source)
    refuse(source, parsed.diagnostics)
    return parsed.properties


def _problem(
    path: str, closed: ClosedPackage, properties: Source | None, written: str | None
) -> Problem:
    from rebsync.checker.problem import Problem
    from rebsync.cli.problem import analysed, properties_of
    from rebsync.grammars.parser import parse_model
    from rebsync.printing import print_model
    from rebsync.properties import Properties
    from rebsync.reverse.findings import Grade
    from rebsync.roundtrip.diff.correspondence import code_places

    text = print_model(closed.model)
    if written is not None:
        from rebsync.cli.options import write_output

        write_output(written, text)
    source = Source(written or f"{path} as a model", text)
    try:
        analysis = analysed(source)
    except RebsyncError as error:
        found = error.findings[0].errors[0].message
        hint = "--model FILE writes it" if written is None else None
        message = f"what the code says is no whole model: {found}"
        raise RebsyncError.of(path, "RS943", message, hint) from None
    places = code_places(source, parse_model(source).model, closed.model)
    code = {line: f"{_shown(place.source.path)}:{place.line}" for line, place in places}
    checked = properties_of(properties, analysis) if properties is not None else Properties()
    listed = _listed(closed, Grade.UNREADABLE), _listed(closed, Grade.APPROXIMATED)
    told = closed.assumptions, closed.gaps, *listed, code
    return Problem(source, analysis, checked, properties, *told)


def _listed(closed: ClosedPackage, grade: Grade) -> tuple[str, ...]:
    """The findings of a grade, each with its place."""
    found = (f for f in closed.findings if f.grade is grade)
    lines = ((f, f.source.position(f.span.start).line) for f in found)
    return tuple(f"{_shown(f.source.path)}:{line} ({f.why})" for f, line in lines)


def _shown(path: str) -> str:
    return Path(path).as_posix()
