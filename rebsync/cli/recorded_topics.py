"""`rebsync conform` on a package that people wrote: only topics are seen of what it does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rebsync.records import dataclass

if TYPE_CHECKING:
    from rebsync.conform.components.environment import Closed
    from rebsync.conform.components.heard import HeardRecordings
    from rebsync.conform.components.properties import TopicProperties
    from rebsync.conform.conformance import Conformance
    from rebsync.conform.matching import Subject
    from rebsync.model import Model
    from rebsync.reverse.files.reading import Chosen

SLACK = 0.1  # s


@dataclass(frozen=True, slots=True)
class TopicBounds:
    """What a comparison of topics may take for granted; None where the user has not said it."""

    most: int | None
    from_start: bool
    slack: float | None
    measures: bool = False  # what messages took


def is_by_hand(path: str) -> bool:
    """Whether a package, or a folder with packages, has none that was made from a model."""
    from rebsync.diagnostics import RebsyncError
    from rebsync.roundtrip.package.discovery import find

    if not Path(path).is_dir():
        return False
    try:
        return next(find((path,), None), None) is None
    except RebsyncError as error:
        return error.findings[0].diagnostics[0].code == "RS960"


@dataclass(frozen=True, slots=True)
class OpenPackage:
    """A package read together with the other ends of its topics, and its model."""

    closed: Closed
    subject: Subject
    model: Model

    @classmethod
    def of(cls, given: Chosen, topics: Sequence[str]) -> OpenPackage:
        """A package with the topics of a recording. RebsyncError: there is no node in it."""
        from rebsync.checker.problem import Problem
        from rebsync.cli.problem import analysed
        from rebsync.config import parse_config
        from rebsync.conform.components.environment import closed
        from rebsync.conform.matching import Subject
        from rebsync.diagnostics import RebsyncError
        from rebsync.printing import print_model
        from rebsync.source import Source

        package = closed(given, topics)
        model = package.extracted.model
        if not model.classes or model.main is None:
            hint = "`rebsync extract` tells what is read of it"
            raise RebsyncError.of(given.root, "RS943", "no node of a model was found here", hint)
        source = Source(given.root, print_model(model))
        analysis = analysed(source)
        subject = Subject.of(Problem(source, analysis), parse_config(package.settings))
        return cls(package, subject, analysis.model)

    def compare(
        self,
        recordings: HeardRecordings,
        bounds: TopicBounds,
        properties: TopicProperties | None = None,
    ) -> Conformance:
        """The answer for a recording. RebsyncError: it cannot be read."""
        from rebsync.conform.components.assembly import Scale, assemble
        from rebsync.conform.components.comparison import Bounds, compare
        from rebsync.conform.components.properties import Timespan
        from rebsync.conform.search import WIDEST

        slack = bounds.slack if bounds.slack is not None else SLACK
        scale = Scale(self.subject.time_unit, slack)
        program = self.subject.program
        assembly = assemble(self.closed, self.model, program, recordings, scale)
        most = bounds.most or WIDEST
        limits = Bounds(most, bounds.from_start, bounds.measures)
        found = compare(self.closed, assembly, limits)
        if properties is None:
            return found
        events = recordings.events(properties.fields())
        begin = assembly.begin
        # Of several files each has topics of its own, and another end.
        length = assembly.end * scale.unit if len(recordings.paths) == 1 else 0.0
        times = Timespan(begin, begin + length)
        evaluated = properties.evaluated(events, times, scale.unit, slack)
        notes = found.notes
        if properties.unit != 1:
            notes += (
                f"a bound of time in the properties counts in units of {properties.unit:g} s",
            )
        return replace(found, properties=evaluated, notes=notes)


def compared(
    path: str, recordings: Sequence[str], bounds: TopicBounds, property_file: str | None = None
) -> tuple[Conformance, Subject]:
    """A package compared with a recording. RebsyncError: one of them cannot be read.

    Several packages are none: of these one is to be named.
    """
    from rebsync.cli.packages import one_package, read_observed
    from rebsync.conform.components.environment import own_types
    from rebsync.conform.components.heard import HeardRecordings

    given = one_package(path)
    opened = HeardRecordings.of(recordings, own_types(given))
    package = OpenPackage.of(given, opened.topics())
    properties = read_observed(path, property_file)
    return package.compare(opened, bounds, properties), package.subject
