"""Model x Recording -> RunTimes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

from rebsync.calibration.measuring import Measuring, Series
from rebsync.calibration.sites import Sites, time_of
from rebsync.calibration.times import (
    Kind,
    Measured,
    RunTimes,
    Sample,
    Slow,
    TimeSite,
    quantile,
)
from rebsync.conform.lateness import Clocks
from rebsync.conform.matching import Subject
from rebsync.conform.recording import Recording, Served
from rebsync.model import Model
from rebsync.records import dataclass

_KINDS: tuple[Kind, ...] = ("delay", "after", "deadline", "period")


def measure(subject: Subject, model: Model, recording: Recording) -> RunTimes:
    """What a recording of a model's nodes took. It is read twice: for time 0, and for the rest."""
    clocks = Clocks(subject.observable.nodes, subject.time_unit)
    for event in recording.events():
        clocks.see(event)
    measuring = Measuring(subject, clocks.lateness().zero)
    for event in recording.events():
        if isinstance(event, Served):
            measuring.see(event)
    measuring.end()
    return _Result(subject, Sites(subject.source, model, subject.program), measuring).times()


@dataclass(frozen=True, slots=True)
class _Result:
    subject: Subject
    sites: Sites
    measuring: Measuring

    def times(self) -> RunTimes:
        slack = self.subject.slack / self.subject.time_unit
        latency = self._latency(slack)
        places = [
            place
            for kind, series in zip(_KINDS, self._series(), strict=True)
            for place in self._places(kind, series)
        ]
        return RunTimes(
            tuple(sorted(places, key=lambda p: (p.site.span.start, _KINDS.index(p.site.kind)))),
            tuple(self._slow(slack)),
            latency,
            slack,
            self.subject.time_unit,
            self.measuring.count,
            self.measuring.unknown,
        )

    def _series(self) -> tuple[Mapping[int, Series], ...]:
        m = self.measuring
        return m.delays, m.afters, m.deadlines, m.periods

    def _latency(self, slack: float) -> float:
        """What bodies take that take no time in the model."""
        took = sorted(
            sample.measured
            for series in self.measuring.instant.values()
            for sample in series.samples()
        )
        return min(quantile(took, 0.99), slack) if took else 0.0

    def _places(self, kind: Kind, series: Mapping[int, Series]) -> Iterable[Measured]:
        """The places of a kind: several instructions are one where a class inherits a body."""
        samples: dict[TimeSite, list[Sample]] = defaultdict(list)
        shared: dict[TimeSite, set[int]] = defaultdict(set)
        shortened: dict[TimeSite, int] = defaultdict(int)
        for pc in self._candidates(kind, series):
            site = self.sites.site(pc, kind)
            samples[site] += series[pc].samples() if pc in series else ()
            if kind == "delay":
                shortened[site] += self.measuring.shortened.get(pc, 0)
                lines = {self.sites.line(other) for other in self.measuring.together.get(pc, ())}
                shared[site] |= lines - {self.sites.line(pc)}
        for site, found in samples.items():
            others = tuple(sorted(shared[site]))
            yield Measured(site, tuple(found), others, shortened[site])

    def _candidates(self, kind: Kind, series: Mapping[int, Series]) -> Iterable[int]:
        """All places of a kind, measured or not; of periods those that were measured."""
        pcs = self.sites.pcs
        if kind == "period":
            return sorted(series)
        of_kind = pcs["delay" if kind == "delay" else "send"]
        return [pc for pc in of_kind if time_of(self.sites.call(pc), kind) is not None]

    def _slow(self, slack: float) -> Iterable[Slow]:
        """Bodies without a delay that took longer than what is nothing."""
        program = self.subject.program
        found: dict[tuple[str, int], list[Sample]] = defaultdict(list)
        for (rebec, name), series in self.measuring.instant.items():
            over = [s for s in series.samples() if s.measured > slack]
            if over:
                servers = (program.servers[n] for n in program.rebecs[rebec].dispatch if n >= 0)
                server = next(s for s in servers if s.name == name)
                line = self.subject.source.position(server.span.start).line
                found[f"{server.class_name}.{name}", line] += over
        return [Slow(body, line, tuple(samples)) for (body, line), samples in found.items()]
