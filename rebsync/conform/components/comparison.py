"""Package x Recording -> Conformance, for packages that people wrote.

Each rebec is a component of its own. It is not compared where the model of it, or the recording,
lacks what could matter; then the answer is at best undetermined, with the list. What the model may
do and the code may not (over-approximation) makes a fit undetermined, and no refusal.
"""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from math import inf

from rebsync.conform.components.assembly import Assembly
from rebsync.conform.components.component import Component
from rebsync.conform.components.diagnosis import TopicDiagnosis
from rebsync.conform.components.environment import Closed
from rebsync.conform.components.hypotheses import Hypothesis
from rebsync.conform.components.inclusion import Inclusion, InclusionSearch
from rebsync.conform.components.middle import middle, served_before
from rebsync.conform.components.run import merged, steps_of
from rebsync.conform.conformance import Conformance, Deviation, TopicInterval
from rebsync.model import Model
from rebsync.records import dataclass
from rebsync.reverse.findings import COUNTS_ON, IN_THREADS, NOT_SENT, Finding, Grade

_BESIDE = "callbacks may have run beside each other, which the model does not have"
_ELSEWHERE = "may have been in another state when the recording began (--from-start: it was not)"
_REACHED = 2_000  # states in which a recording may begin
_FEW = 5  # findings that are named


@dataclass(frozen=True, slots=True)
class Bounds:
    """`most` states at a time; `from_start`: nodes were started while it was recorded.

    `measures`: what messages took, and a run, is in the answer.
    """

    most: int
    from_start: bool
    measures: bool = False


@dataclass(frozen=True, slots=True)
class Judged:
    """What became of one component. `open` keeps the answer from being more than undetermined."""

    compared: int
    widest: int = 1
    deviation: Deviation | None = None
    open: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    intervals: tuple[TopicInterval, ...] = ()
    way: tuple[Component, Sequence[Hypothesis]] | None = None


def compare(closed: Closed, assembly: Assembly, bounds: Bounds) -> Conformance:
    """Whether all that nodes have published is what their classes in the model publish.

    RebsyncError: a recording cannot be read.
    """
    notes, open_, judged = list(assembly.notes), list(assembly.open), []
    for component in assembly.components:
        class_ = component.program.rebecs[component.rebec].class_name
        found = _about(closed.extracted.findings, class_, closed.extracted.model)
        unread = [f for f in found if f.grade is Grade.UNREADABLE]
        if unread:
            open_.append(f"{component.name} was not compared: {_named(unread)}")
            continue
        doubt = assembly.doubts.get(component.name, "")
        judged.append(_Judge(component, found, closed.extracted.model, bounds, doubt).of())
        notes += (
            f"not recorded, and so not compared: {f.text} ({f.place})"
            for f in found
            if NOT_SENT in f.why
        )
    notes += (note for each in judged for note in each.notes)
    deviations = [each.deviation for each in judged if each.deviation is not None]
    deviations += assembly.deviations
    compared = sum(each.compared for each in judged)
    open_ += (why for each in judged for why in each.open)
    first = min(deviations, key=_stamp, default=None)
    if first is None and not open_ and not compared:
        open_.append("nothing that the nodes publish is in the recording")
    until = first.time if first is not None else inf
    verdict = "deviates" if first is not None else "undetermined" if open_ else "conforms"
    if first is not None:
        notes += open_
    return Conformance(
        verdict,  # type: ignore[arg-type]
        compared,
        assembly.recorded,
        0,
        assembly.end,
        "" if first is not None else "; ".join(open_),
        first,
        notes=tuple(dict.fromkeys(notes)),
        widest=max((each.widest for each in judged), default=1),
        intervals=tuple(interval for each in judged for interval in each.intervals),
        run=merged([steps_of(*each.way, until) for each in judged if each.way is not None]),
    )


def _stamp(deviation: Deviation) -> tuple[int, bool, str]:
    """When it was; what has a cause at that time comes after what may be the cause."""
    has_cause = deviation.kind in ("lost message", "late", "silent")
    return deviation.time, has_cause, deviation.rebec


def _about(findings: Sequence[Finding], class_: str, model: Model) -> list[Finding]:
    """The findings that may concern a class: all but those in another one."""
    others = {c.name for c in model.classes} - {class_}
    built = (f for f in findings if f.grade is not Grade.UNBUILT)
    return [f for f in built if f.within.replace("::", ".").partition(".")[0] not in others]


def _is_exact_here(finding: Finding) -> bool:
    """Whether a finding does not make the model do more than the code in a recorded run.

    Of what runs in threads the model does less; no recording is so long that a variable that
    counts on gets to the end of the model's numbers; and what is published on a topic that was not
    recorded changes nothing of what the node does.
    """
    return any(why in finding.why for why in (IN_THREADS, COUNTS_ON, NOT_SENT))


def _named(findings: Sequence[Finding]) -> str:
    shown = [f"{f.why} ({f.place})" for f in findings[:_FEW]]
    more = len(findings) - _FEW
    return ", ".join([*shown, f"and {more} more"] if more > 0 else shown)


@dataclass(frozen=True, slots=True)
class _Judge:
    """One component with the findings about its class, and the `doubt` whether a refusal counts."""

    component: Component
    findings: Sequence[Finding]
    model: Model
    bounds: Bounds
    doubt: str

    def of(self) -> Judged:
        """What becomes of it. From its beginning on, or else from the middle of its run on."""
        in_threads = any(IN_THREADS in f.why for f in self.findings)
        component = replace(self.component, in_threads=in_threads)
        if self.bounds.from_start:
            component = component.started_while_recorded()
        search = InclusionSearch(component, self.bounds.most)
        search.keeps = self.bounds.measures
        found = search.run(search.constructed())
        if found.verdict != "refused" or self.bounds.from_start:
            return self._judged(search, found)
        starts = middle(component, min(_REACHED, self.bounds.most))
        later = InclusionSearch(component, self.bounds.most, served_before(component.timing))
        later.keeps = self.bounds.measures
        again = later.run(starts.starts)
        if again.verdict == "refused" and not starts.is_whole:
            why = f"{component.name} does not fit from its beginning on, but {_ELSEWHERE}"
            return self._open(search, found, why)
        note = f"{component.name} is compared from the middle of its run on"
        judged = self._judged(later, again)
        passed = sum(starts.starts[0].matched) if starts.starts else 0
        return replace(judged, compared=max(judged.compared - passed, 0), notes=(note,))

    def _judged(self, search: InclusionSearch, found: Inclusion) -> Judged:
        name = self.component.name
        if found.verdict == "cut":
            return Judged(0, found.widest, open=(found.reason,))
        if found.verdict == "refused":
            return self._refused(search, found)
        grades = (Grade.APPROXIMATED, Grade.ASSUMED)
        over = [f for f in self.findings if f.grade in grades and not _is_exact_here(f)]
        why = f"{name} fits, but its model may do otherwise than it: {_named(over)}"
        compared = sum(map(len, self.component.outputs))
        took: tuple[TopicInterval, ...] = ()
        way: tuple[Component, Sequence[Hypothesis]] | None = None
        if search.keeps and found.last is not None:
            way = self.component, search.way_to(found.last)
            took = _intervals(*way)
        return Judged(compared, found.widest, None, (why,) if over else (), (), took, way)

    def _refused(self, search: InclusionSearch, found: Inclusion) -> Judged:
        name = self.component.name
        if not found.furthest:
            return Judged(0, open=(f"the model of {name} cannot begin",))
        if found.failures:
            kinds = ", ".join(sorted({f.kind for f in found.failures}))
            return self._open(search, found, f"the model of {name} breaks a rule ({kinds})")
        if self.doubt:
            return self._open(search, found, f"{name} does not fit, but {self.doubt}")
        if found.raced:
            return self._open(search, found, f"{name} does not fit, but {_BESIDE}")
        way = self.component, search.way_to(found.furthest[-1])
        return Judged(_compared(found), found.widest, self._deviation(search, found), way=way)

    def _open(self, search: InclusionSearch, found: Inclusion, why: str) -> Judged:
        """Undetermined; the deviation is told nevertheless."""
        told = self._deviation(search, found).message if found.furthest else "it cannot begin"
        return Judged(_compared(found), found.widest, open=(f"{why}: {told}",))

    def _deviation(self, search: InclusionSearch, found: Inclusion) -> Deviation:
        return TopicDiagnosis(self.component, search, self.model).of(found)


def _compared(found: Inclusion) -> int:
    return sum(found.furthest[-1].matched) if found.furthest else 0


def _intervals(component: Component, run: Sequence[Hypothesis]) -> tuple[TopicInterval, ...]:
    """The times from what a server got to what it published on a topic, and from one to the next.

    The first of servers of messages from outside ("delay"), the second of servers of messages that
    the rebec sends itself, such as timers ("period").
    """
    found: dict[tuple[str, str, str], array[float]] = {}
    last: dict[tuple[int, int], float] = {}
    for before, after in pairwise(run):
        inputs = [component.inputs[n] for n in _newly_taken(before, after)]
        changed = enumerate(zip(before.matched, after.matched, strict=True))
        for topic, stamp in (
            (k, component.outputs[k][was].stamp) for k, (was, now) in changed if now > was
        ):
            if after.last < 0 or (component.kept[topic] and not before.matched[topic]):
                continue
            name = component.program.servers[after.last].name
            if inputs:
                key = name, component.topics[topic], "delay"
                found.setdefault(key, array("d")).append(stamp - inputs[0].stamp)
                continue
            before_it = last.get((after.last, topic))
            if before_it is not None:
                key = name, component.topics[topic], "period"
                found.setdefault(key, array("d")).append(stamp - before_it)
            last[after.last, topic] = stamp
    return tuple(TopicInterval(component.name, *key, seconds) for key, seconds in found.items())


def _newly_taken(before: Hypothesis, after: Hypothesis) -> list[int]:
    """The inputs that are passed in a step."""
    advanced = {*range(before.base, after.base), *after.taken}
    return sorted(advanced - before.taken)
