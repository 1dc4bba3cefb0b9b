"""The text of a model that allows what was measured."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.calibration.proposals import Proposal, TimedPlace, proposals
from rebsync.calibration.sites import time_of
from rebsync.calibration.times import Measured, RunTimes
from rebsync.edits import apply_edits
from rebsync.model import Call, Constructor, MessageServer, Method, Model, walk
from rebsync.records import dataclass
from rebsync.source import Source


@dataclass(frozen=True, slots=True)
class Calibration:
    """What was measured, what is proposed, and the model's text with all of it."""

    times: RunTimes
    proposals: tuple[Proposal, ...]
    text: str

    @property
    def changes(self) -> tuple[Proposal, ...]:
        """The places that change."""
        return tuple(p for p in self.proposals if p.state == "change")

    @property
    def impossible(self) -> tuple[Proposal, ...]:
        """The places that would have to change and cannot."""
        return tuple(p for p in self.proposals if p.state == "impossible")

    @property
    def is_open(self) -> bool:
        """Whether something was measured that no change of the model covers."""
        return bool(self.impossible) or bool(self.times.slow)


def calibrate(source: Source, model: Model, times: RunTimes) -> Calibration:
    """What a model has to allow; its text keeps everything else, comments and layout as well."""
    given = [place for each in times.places for place in _place(each, model)]
    found = proposals(times, given)
    edits = [edit for proposal in found if (edit := proposal.edit) is not None]
    return Calibration(times, found, apply_edits(source.text, edits))


def _place(measured: Measured, model: Model) -> Iterator[TimedPlace]:
    """A place that can change: a deadline is a demand, and a period the sum of other times."""
    site = measured.site
    if site.kind == "deadline" or site.kind == "period":
        return
    for declared in model.classes:
        for member in walk(declared):
            if not isinstance(member, (MessageServer, Method, Constructor)):
                continue
            for call in walk(member):
                if not isinstance(call, Call) or (call.name != "delay") == (site.kind == "delay"):
                    continue
                expression = time_of(call, site.kind)
                if expression is not None and expression.span == site.span:
                    yield TimedPlace(measured, expression, isinstance(member, MessageServer))
                    return
