"""`rebsync conform`: is a recorded run of the system a run of the verified model?"""

from __future__ import annotations

from dataclasses import replace
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rebsync.cli.options import refuse_to_overwrite, write_output
from rebsync.cli.problem import read_problem
from rebsync.cli.status import Status, worst
from rebsync.records import dataclass

if TYPE_CHECKING:
    from rebsync.checker.problem import Problem
    from rebsync.cli.calibration import Calibrated
    from rebsync.config import Config
    from rebsync.conform.conformance import Conformance
    from rebsync.conform.matching import Subject
    from rebsync.conform.recording import Recording
    from rebsync.static.cells import CellOf

FORMATS = ("text", "json", "sarif", "github", "junit")
_REORDERED = "the messages are not in the order of their stamps, and were compared in that"
_STATUS = {
    "conforms": Status.CLEAN,
    "deviates": Status.FINDINGS,
    "violated": Status.VIOLATED,
    "undetermined": Status.UNDETERMINED,
}


@click.command("conform")
@click.argument("model", metavar="MODEL|PACKAGE")
@click.argument("recordings", metavar="RECORDING...", nargs=-1, required=True)
@click.option(
    "--property",
    "property_file",
    metavar="FILE",
    help="The properties (default: the .property file beside the model).",
)
@click.option(
    "--namespace", metavar="NAME", help="The namespace of the nodes, where several were recorded."
)
@click.option(
    "--max-states",
    type=click.IntRange(1),
    metavar="N",
    help="States to look at where a recording begins in the middle (default: 200,000), and that "
    "may be possible at one moment (default: 20,000).",
)
@click.option(
    "--from-start",
    is_flag=True,
    help="The nodes were started while it was recorded (of packages that people wrote).",
)
@click.option(
    "--slack",
    type=click.FloatRange(0, min_open=True),
    metavar="SECONDS",
    help="By how much messages may be late (of packages that people wrote; default: 0.1).",
)
@click.option("--times", is_flag=True, help="Tell what each time of the model really took.")
@click.option(
    "--calibrate", is_flag=True, help="Propose what the model must allow to cover what it took."
)
@click.option("--apply", "applies", is_flag=True, help="Write that into the model.")
@click.option("--page", metavar="FILE", help="Write a page (HTML) with the run beside the model.")
@click.option(
    "--format",
    "style",
    type=click.Choice(FORMATS),
    default="text",
    show_default=True,
    help="How to print the answer.",
)
@click.option("-o", "--output", default="-", metavar="FILE", help="Write the answer to FILE.")
@click.pass_context
def command(ctx: click.Context, /, model: str, recordings: tuple[str, ...], **_: object) -> Status:
    """Tell whether a recorded run is a run of the model.

    RECORDING is a bag of ROS 1 or ROS 2, or a log of JSON lines; several are of one run. Exit
    status: 0 it conforms, 1 it does not, 2 something cannot be read, 3 a property, or a rule of the
    model, is violated, 4 undetermined.
    """
    from rebsync.calibration.report import calibration_json
    from rebsync.cli.calibration import calibrated
    from rebsync.cli.recorded_topics import is_by_hand
    from rebsync.conform.matching import Subject, conform
    from rebsync.conform.reading import InOrderOfStamps
    from rebsync.conform.reading import recordings as opened
    from rebsync.conform.report.formats import as_text
    from rebsync.conform.search import WIDEST
    from rebsync.conform.starts import REACHED
    from rebsync.conform.topics import Topics

    given: dict[str, Any] = ctx.params
    if is_by_hand(model):
        return _topics(given)
    for option in ("from_start", "slack"):
        if given[option]:
            name = option.replace("_", "-")
            raise click.UsageError(f"--{name} is for packages that were not generated")
    problem, config, package = _problem(model, given["property_file"])
    subject = Subject.of(problem, config)
    for written in filter(None, (given["page"], given["output"])):
        for read in (subject.source.path, *recordings):
            refuse_to_overwrite(read, written)
    observable = subject.observable
    topics = Topics.of(observable)
    recording: Recording = opened(recordings, topics, observable.package, given["namespace"])
    most, keeps = given["max_states"] or REACHED, given["page"] is not None
    widest = given["max_states"] or WIDEST
    found = conform(subject, recording, most=most, keeps_run=keeps, widest=widest)
    if found.lateness.goes_back and found.verdict in ("deviates", "undetermined"):
        by_stamps = InOrderOfStamps(recording)
        again = conform(subject, by_stamps, most=most, keeps_run=keeps, widest=widest)
        if again.verdict in ("conforms", "violated") or again.compared > found.compared:
            found, recording = replace(again, notes=(*again.notes, _REORDERED)), by_stamps
    if package is not None:
        found = _with_code(found, subject, problem, package)
    proposes = given["calibrate"] or given["applies"]
    times = None
    if proposes or given["times"] or given["page"] is not None:
        applies = given["applies"] and found.verdict == "conforms"
        times = calibrated(subject, problem, recording, proposes, applies)
    if given["page"] is not None:
        write_output(given["page"], _page(found, subject, problem, recording, times))
    shown = times if proposes or given["times"] else None
    extra = list(shown.lines(subject.source.path, problem.source.text)) if shown else []
    if given["applies"] and found.verdict != "conforms":
        extra.append("nothing was written: the recorded run is none of the model")
    data = calibration_json(shown.calibration, shown.verdict) if shown else None
    text = as_text(found, subject, recording.paths, given["style"], extra, data)
    write_output(given["output"], text)
    return worst([_status(found), shown.status if shown else Status.CLEAN])


def _page(
    found: Conformance,
    subject: Subject,
    problem: Problem,
    recording: Recording,
    times: Calibrated | None,
) -> str:
    """The page of an answer, with the times and the movement of the recorded run."""
    from rebsync.calibration.report import times_section
    from rebsync.conform.movement import recorded_movement
    from rebsync.conform.report.page import conformance_page, numbered

    more = [times_section(times.calibration)] if times is not None else []
    until = found.deviation.served if found.deviation is not None else None
    moved = recorded_movement(
        subject.observable,
        problem.analysis,
        _cells(problem),
        recording,
        found.lateness.zero,
        numbered(found),
        until.stamp if until is not None else inf,
    )
    return conformance_page(found, subject, recording.paths, more, moved)


@dataclass(frozen=True, slots=True)
class _Package:
    """A package that was generated: its folder, and the names of its files."""

    root: str
    files: tuple[str, ...]


def _with_code(
    found: Conformance, subject: Subject, problem: Problem, package: _Package
) -> Conformance:
    """The answer with the place in the code of what deviates."""
    from rebsync.conform.code_places import code_place

    if found.deviation is None:
        return found
    model = problem.analysis.model
    place = code_place(found.deviation, model, subject.source, package.root, package.files)
    return replace(found, deviation=replace(found.deviation, code=place))


def _problem(model: str, property_file: str | None) -> tuple[Problem, Config, _Package | None]:
    """A model by its path, or that of a package that was generated from it; with its settings."""
    from rebsync.config import config_of_record, settings_beside

    if not Path(model).is_dir():
        _, config = settings_beside(model)
        return read_problem(model, property_file), config, None
    from rebsync.roundtrip.package.discovery import find
    from rebsync.roundtrip.package.model_file import model_of
    from rebsync.roundtrip.package.record import read_record

    packages = list(find((model,), None))
    if len(packages) > 1:
        raise click.UsageError(f'there are {len(packages)} packages in "{model}": name one')
    record = read_record(packages[0].root)
    path = model_of(packages[0], record)
    config = config_of_record(record.options) or settings_beside(path)[1]
    package = _Package(packages[0].root, tuple(record.files))
    return read_problem(path, property_file), config, package


def _topics(given: dict[str, Any]) -> Status:
    """The answer for a package that people wrote."""
    from rebsync.calibration.topics import interval_lines, intervals_json
    from rebsync.cli.recorded_topics import TopicBounds, compared
    from rebsync.conform.report.formats import as_text
    from rebsync.conform.report.page import conformance_page

    for option in ("namespace", "calibrate", "applies"):
        if given[option]:
            name = {"applies": "apply"}.get(option, option)
            raise click.UsageError(f"--{name} is for models, and packages generated from them")
    for written in filter(None, (given["page"], given["output"])):
        for read in (given["model"], *given["recordings"]):
            refuse_to_overwrite(read, written)
    keeps = given["times"] or given["page"] is not None
    bounds = TopicBounds(given["max_states"], given["from_start"], given["slack"], keeps)
    found, subject = compared(given["model"], given["recordings"], bounds, given["property_file"])
    if given["page"] is not None:
        write_output(given["page"], conformance_page(found, subject, given["recordings"]))
    extra, data = [], None
    if given["times"]:
        extra, data = [*interval_lines(found.intervals)], intervals_json(found.intervals)
    text = as_text(found, subject, given["recordings"], given["style"], extra, data)
    write_output(given["output"], text)
    return _status(found)


def _cells(problem: Problem) -> dict[str, CellOf]:
    """What the settings beside a model say of the cells of robots."""
    from rebsync.config import settings_beside
    from rebsync.grammars.cells import parse_cells

    return parse_cells(*settings_beside(problem.source.path), problem.analysis)


def _status(found: Conformance) -> Status:
    statuses = [_STATUS[found.verdict]]
    for evaluated in found.properties:
        if evaluated.verdict == "violated":
            statuses.append(Status.VIOLATED)
        elif evaluated.verdict == "undetermined":
            statuses.append(Status.UNDETERMINED)
    return worst(statuses)
