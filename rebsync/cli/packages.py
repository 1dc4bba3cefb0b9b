"""Reading the code of a package as what is to be verified: extracted, and closed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rebsync.cli.problem import refuse
from rebsync.diagnostics import RebsyncError
from rebsync.files import MODEL, PROPERTY, read_source
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rebsync.checker.problem import CodePlace, Problem
    from rebsync.conform.components.properties import TopicProperties
    from rebsync.model import Model
    from rebsync.properties import Properties
    from rebsync.reverse.environment.package import ClosedPackage, EnvironmentChoice, ReadPackage
    from rebsync.reverse.files.reading import Chosen
    from rebsync.reverse.findings import Finding, Grade
    from rebsync.roundtrip.diff.difference import Place


def read_package(
    path: str, property_file: str | None, environment: str, written: str | None = None
) -> Problem:
    """The code of the package at a path as a closed model, with its properties.

    Mistakes of the properties are RebsyncErrors, as is code in which no node is found, or several
    packages. The model is written to the file `written`, if there is one.
    """
    from rebsync.reverse.environment.package import in_fitting_unit

    chosen = property_file if property_file is not None else _property_in(path)
    properties = read_source(chosen) if chosen is not None else None
    return _closed(path, in_fitting_unit(_files(path)), properties, environment, written)


def read_observed(path: str, property_file: str | None) -> TopicProperties | None:
    """The properties of a package over its topics; None where there are none.

    RebsyncError: as of `read_package`.
    """
    from rebsync.checker.lowering import lower
    from rebsync.conform.components.properties import TopicProperties
    from rebsync.reverse.environment.observation import observations
    from rebsync.reverse.environment.package import in_fitting_unit, message_types
    from rebsync.reverse.nodes.node_system import unit_of_time

    chosen = property_file if property_file is not None else _property_in(path)
    if chosen is None:
        return None
    read = in_fitting_unit(_files(path))
    problem = _closed(path, read, read_source(chosen), "none", None)
    program, formulas = lower(problem.analysis, problem.properties)
    seen = observations(read.extracted.joined, message_types(read.files))
    variables = {(r.name, slot.name) for r in program.rebecs for slot in r.state}
    observed = {(r, o.variable): o for r, o in seen if (r, o.variable) in variables}
    unit = float(unit_of_time(read.files))
    return TopicProperties(program, formulas, problem.properties, observed, unit)


def _property_in(path: str) -> str | None:
    """The property file of a folder, if there is one. RebsyncError: there are several."""
    found = sorted(map(str, Path(path).glob(f"*{PROPERTY}")))
    if len(found) > 1:
        hint = f"name it: --property {found[0]}"
        raise RebsyncError.of(path, "RS802", "several property files are here", hint)
    return found[0] if found else None


def read_question(
    path: str, question: str, environment: str, written: str | None = None
) -> Problem:
    """The same with a question as its only property. RebsyncError: it cannot be asked."""
    from rebsync.grammars.questions import parse_question
    from rebsync.reverse.environment.package import asked_of

    text = Source("the question", question)
    read, asked = asked_of(_files(path), text, parse_question(text))
    return _closed(path, read, Source("the question", asked), environment, written)


def _closed(
    path: str,
    read: ReadPackage,
    properties: Source | None,
    environment: str,
    written: str | None,
) -> Problem:
    from rebsync.reverse.environment.package import closed_package

    closed = closed_package(read, _parsed(properties), _choice(environment))
    if closed.model.main is None or not closed.model.classes:
        hint = "--format json of `rebsync extract` tells what the code asks of ROS"
        raise RebsyncError.of(path, "RS943", "no node of a model was found here", hint)
    apart = _unmatched(path) if _names_qualities(read.files) else ()
    closed = replace(closed, gaps=(*closed.gaps, *_edited(path)))
    return _problem(path, closed, properties, written, apart)


def _edited(path: str) -> Iterator[str]:
    """What is wrong with a proof about the code of a generated package: the rest is edited."""
    from rebsync.roundtrip.verdict.unmodelled import unmodelled_edits

    for found in unmodelled_edits(path):
        for each in found.diagnostics:
            line = found.source.position(each.span.start).line if each.span != NOWHERE else 1
            yield f"{_shown(found.source.path)}:{line}: {each.message}"


def _choice(environment: str) -> EnvironmentChoice:
    """The environment that an option names: `free`, `none` or a file."""
    match environment:
        case "free" | "none":
            return environment
        case path:
            return read_source(path)


def one_package(path: str) -> Chosen:
    """The package at a path, its files read. RebsyncError: there is none, or there are several."""
    from rebsync.reverse.build.workspace import in_workspace
    from rebsync.reverse.files.reading import read
    from rebsync.roundtrip.package.units import as_one, units

    found = list(units([path]))
    if len(found) != 1:
        models = sorted(map(str, Path(path).glob(f"*{MODEL}")))
        hint = f"name the model: {models[0]}" if models else None
        if found:
            hint = f"name one of them: {', '.join(_shown(each.root) for each in found)}"
        message = "several packages are here" if found else "no code is here"
        raise RebsyncError.of(path, "RS802", message, hint)
    return read(next(in_workspace([as_one(found[0])])))


def _files(path: str) -> dict[str, Source]:
    return one_package(path).files


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
    path: str,
    closed: ClosedPackage,
    properties: Source | None,
    written: str | None,
    apart: tuple[CodePlace, ...],
) -> Problem:
    from rebsync.checker.incomplete import unreadable_lines
    from rebsync.checker.problem import Problem, TextNumbers
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
    parsed = parse_model(source).model
    places = dict(code_places(source, parsed, closed.model))
    code = {line: f"{_shown(place.source.path)}:{place.line}" for line, place in places.items()}
    markers = {n: places[n] for n in unreadable_lines(source, analysis.model) if n in places}
    checked = properties_of(properties, analysis) if properties is not None else Properties()
    unread = _listed(closed, Grade.UNREADABLE, markers) + apart
    steps = _steps(source, parsed, places)
    listed = unread, _listed(closed, Grade.APPROXIMATED, steps)
    told = closed.assumptions, closed.gaps, *listed, code, TextNumbers(*closed.texts)
    return Problem(source, analysis, checked, properties, *told)


def _names_qualities(files: Mapping[str, Source]) -> bool:
    """Whether anything may set a quality of service, for which the package is read once more."""
    return any("qos" in source.text.lower() for source in files.values())


def _unmatched(path: str) -> tuple[CodePlace, ...]:
    """Subscriptions that get nothing of a publisher, as their qualities of service never match."""
    from rebsync.checker.problem import CodePlace
    from rebsync.reverse.build.workspace import in_workspace
    from rebsync.reverse.files.parallel import each
    from rebsync.reverse.files.reading import all_listings
    from rebsync.rosgraph.analysis import analysed
    from rebsync.rosgraph.reading import read_package

    packages = list(each(in_workspace(all_listings([path])), read_package))
    found = (f for f in analysed(packages, path).findings if f.code == "RS991")
    return tuple(
        CodePlace(f"{_shown(f.place.source.path)}:{f.place.line} ({f.message})", None)
        for f in found
    )


def _listed(
    closed: ClosedPackage, grade: Grade, places: Mapping[int, Place]
) -> tuple[CodePlace, ...]:
    """The findings of a grade, with those lines of the model that are the closest around each."""
    from rebsync.checker.problem import CodePlace

    found = []
    for finding in (f for f in closed.findings if f.grade is grade):
        line = finding.source.position(finding.span.start).line
        text = f"{_shown(finding.source.path)}:{line} ({finding.why})"
        found.append(CodePlace(text, _closest(finding, places) or None))
    return tuple(found)


def _steps(source: Source, model: Model, places: Mapping[int, Place]) -> dict[int, Place]:
    """Of the places by the lines of a model those of single statements."""
    from rebsync import model as m

    found = (n for n in m.walk(model) if isinstance(n, m.Statement) and not isinstance(n, m.Block))
    lines = {source.position(statement.span.start).line for statement in found}
    return {line: place for line, place in places.items() if line in lines}


def _closest(finding: Finding, places: Mapping[int, Place]) -> frozenset[int]:
    """The lines of a model whose place in the code is the narrowest that a finding lies in."""
    around = {
        line: place.span
        for line, place in places.items()
        if place.source.path == finding.source.path
        and place.span.start <= finding.span.start < place.span.end
    }
    least = min((span.end - span.start for span in around.values()), default=0)
    return frozenset(n for n, span in around.items() if span.end - span.start == least)


def _shown(path: str) -> str:
    return Path(path).as_posix()
