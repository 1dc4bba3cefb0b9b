"""`rebsync conform` on a package that people wrote: only topics are seen of what it does."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rebsync.records import dataclass

if TYPE_CHECKING:
    from rebsync.roundtrip.conform.conformance import Conformance
    from rebsync.roundtrip.conform.matching import Subject

SLACK = 0.1  # s


@dataclass(frozen=True, slots=True)
class TopicBounds:
    """What a comparison of topics may take for granted; None where the user has not said it."""

    most: int | None
    from_start: bool
    slack: float | None


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


def compared(
    path: str, recordings: Sequence[str], bounds: TopicBounds
) -> tuple[Conformance, Subject]:
    """A package compared with a recording. RebsyncError: one of them cannot be read."""
    from rebsync.checker.problem import Problem
    from rebsync.cli.problem import analysed
    from rebsync.config import parse_config
    from rebsync.diagnostics import RebsyncError
    from rebsync.printing import print_model
    from rebsync.reverse.files.reading import chosen
    from rebsync.roundtrip.conform.components.assembly import Scale, assemble
    from rebsync.roundtrip.conform.components.comparison import Bounds, compare
    from rebsync.roundtrip.conform.components.environment import closed, own_types
    from rebsync.roundtrip.conform.components.heard import HeardRecordings
    from rebsync.roundtrip.conform.matching import Subject
    from rebsync.roundtrip.conform.search import WIDEST
    from rebsync.source import Source

    given = chosen(path)
    opened = HeardRecordings.of(recordings, own_types(given))
    package = closed(given, opened.topics())
    if not package.extracted.model.classes or package.extracted.model.main is None:
        hint = "`rebsync extract` tells what is read of it"
        raise RebsyncError.of(path, "RS943", "no node of a model was found here", hint)
    source = Source(given.root, print_model(package.extracted.model))
    analysis = analysed(source)
    config = parse_config(package.settings)
    subject = Subject.of(Problem(source, analysis), config)
    slack = bounds.slack if bounds.slack is not None else SLACK
    scale = Scale(config.time_unit, slack)
    assembly = assemble(package, analysis.model, subject.program, opened, scale)
    most = bounds.most or WIDEST
    return compare(package, assembly, Bounds(most, bounds.from_start)), subject
