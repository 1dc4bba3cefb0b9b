"""Why a component's recording is no run of it: the message that no hypothesis explains."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf
from typing import NamedTuple

from rebsync.checker.endless import EndlessBody
from rebsync.checker.program import Cell
from rebsync.model import MessageServer, Model, ReactiveClass, walk
from rebsync.roundtrip.conform.components.bodies import Publication
from rebsync.roundtrip.conform.components.component import Component, Output
from rebsync.roundtrip.conform.components.inclusion import (
    Candidate,
    Hypothesis,
    Inclusion,
    InclusionSearch,
)
from rebsync.roundtrip.conform.components.interface import shown
from rebsync.roundtrip.conform.conformance import Allowed, CodePlace, Deviation, Kind
from rebsync.source import SourceSpan

_FEW = 5


class Expected(NamedTuple):
    """A message that the model publishes next: when, on which topic, by which server."""

    low: float
    high: float
    topic: int
    sent: Publication
    server: int


class Reason(NamedTuple):
    """What is wrong, in words, with the message that is or the time at which one is not."""

    kind: Kind
    why: str
    output: Output | None
    time: float


class TopicDiagnosis:
    """A refusal, to be explained."""

    def __init__(self, component: Component, search: InclusionSearch, model: Model) -> None:
        self.component, self.search, self.model = component, search, model

    def of(self, found: Inclusion) -> Deviation:
        """The first message that is not the model's, by the hypothesis that came furthest."""
        best = max(found.dead, key=lambda dead: dead.progress)
        alike = (dead for dead in found.dead if dead.matched == best.matched)
        expected = sorted({e for dead in alike for e in self._expected(dead)}, key=_order)
        following = self._next(best)
        kind, why, output, at = self._reason(best, expected, following)
        allowed = tuple(dict.fromkeys(map(self._allowed, expected)))[:_FEW]
        topic = self._topic(expected, following)
        when = f" at {output.stamp:.3f} s" if output is not None else ""
        shown = f"{self.component.name} publishes {_shown(output)} on {topic}{when}: {why}"
        message = shown if output is not None else f"{self.component.name} on {topic}: {why}"
        time = round((at - self.component.timing.begin) / self.component.timing.unit)
        place = output.place if output is not None else None
        code = self._code({each.server for each in allowed})
        name = self.component.name
        return Deviation(
            kind, name, time, message, None, 0, allowed, code=code, message_place=place
        )

    def _code(self, servers: set[str]) -> CodePlace | None:
        """Where in the code the callback is that the model's next message comes from."""
        info = self.component.program.rebecs[self.component.rebec]
        for class_ in self.model.classes:
            if isinstance(class_, ReactiveClass) and class_.name == info.class_name:
                for member in class_.members:
                    if isinstance(member, MessageServer) and member.name in servers:
                        return _code_of(member)
        return None

    def _next(self, dead: Hypothesis) -> tuple[int, Output] | None:
        both = zip(dead.matched, self.component.outputs, strict=True)
        left = [(all_[n].stamp, k) for k, (n, all_) in enumerate(both) if n < len(all_)]
        if not left:
            return None
        topic = min(left)[1]
        return topic, self.component.outputs[topic][dead.matched[topic]]

    def _topic(self, expected: list[Expected], following: tuple[int, Output] | None) -> str:
        if following is not None and not any(e.high < following[1].stamp for e in expected):
            return self.component.topics[following[0]]
        if expected:
            return self.component.topics[expected[0].topic]
        return self.component.topics[following[0]] if following is not None else "its topics"

    def _expected(self, dead: Hypothesis) -> Iterator[Expected]:
        unit = self.component.timing.unit
        candidates = self.search.candidates(dead) or _overdue(dead)
        try:
            for candidate in candidates:
                for run in self.search.runs(dead, candidate):
                    for sent in run.published:
                        topic = self.component.by_server.get(sent.server)
                        if topic is not None:
                            elapsed = sent.after * unit
                            low, high = candidate.low + elapsed, candidate.high + elapsed
                            yield Expected(low, high, topic, sent, candidate.server)
        except EndlessBody:
            return

    def _reason(
        self, dead: Hypothesis, expected: list[Expected], following: tuple[int, Output] | None
    ) -> Reason:
        slack = self.component.timing.slack
        for each in expected:
            number = dead.matched[each.topic]
            recorded = self.component.outputs[each.topic][number : number + 2]
            if not recorded or recorded[0].stamp > each.high + 2 * slack:
                return self._missing(dead, each, recorded[0] if recorded else None)
            if following is not None and recorded[0] is not following[1]:
                continue
            if recorded[0].stamp >= each.low - slack:
                return self._unlike(dead, each, recorded)
        if following is None:
            why = "the model goes on, and nothing of it is recorded"
            return Reason("silent", why, None, dead.low)
        topic, output = following
        number = dead.matched[topic]
        if number and self.component.outputs[topic][number - 1].cells == output.cells:
            why = "it was published before, and the model publishes it once"
            return Reason("repeated", why, output, output.stamp)
        early = [e for e in expected if e.topic == topic and e.low > output.stamp]
        if early and self.search.is_output(output, early[0].sent):
            why = f"the model publishes it from {early[0].low:.3f} s on"
            return Reason("early", why, output, output.stamp)
        return Reason("unexpected", "the model publishes nothing then", output, output.stamp)

    def _missing(self, dead: Hypothesis, expected: Expected, recorded: Output | None) -> Reason:
        """Nothing was recorded when the model publishes."""
        values = self._values(expected)
        until = f"{expected.high + self.component.timing.slack:.3f} s"
        if recorded is not None and self._is(dead, expected, 0):
            late = recorded.stamp - expected.high
            if late < 0.5 * self._gap(dead, expected.topic):
                why = f"the model publishes it by {until}"
                return Reason("late", why, recorded, expected.low)
        why = f"the model publishes {values} by {until}, and no such message was recorded"
        return Reason("lost message", why, None, expected.low)

    def _gap(self, dead: Hypothesis, topic: int) -> float:
        """The time between the next two messages of a topic."""
        number, outputs = dead.matched[topic], self.component.outputs[topic]
        if number + 1 >= len(outputs):
            return inf
        return outputs[number + 1].stamp - outputs[number].stamp

    def _is(self, dead: Hypothesis, expected: Expected, further: int) -> bool:
        number = dead.matched[expected.topic] + further
        outputs = self.component.outputs[expected.topic]
        return number < len(outputs) and self.search.is_output(outputs[number], expected.sent)

    def _unlike(self, dead: Hypothesis, expected: Expected, recorded: Sequence[Output]) -> Reason:
        """Another message was recorded when the model publishes."""
        values, first = self._values(expected), recorded[0]
        number = dead.matched[expected.topic]
        kind: Kind = "wrong value"
        why = f"the model publishes {values}"
        if self._is(dead, expected, 0):
            kind = "early" if first.stamp < expected.low else "late"
            word, bound = ("from", expected.low) if kind == "early" else ("by", expected.high)
            why = f"the model publishes it {word} {bound:.3f} s"
        elif self._is(dead, expected, 1):
            before = self.component.outputs[expected.topic][number - 1] if number else None
            if before is not None and before.cells == first.cells:
                kind, why = "repeated", f"it was published before; now {values} has to be"
            else:
                kind, why = "swapped", f"{values} has to be published before, and comes after"
        return Reason(kind, why, first, min(first.stamp, expected.low))

    def _values(self, expected: Expected) -> str:
        return shown(self.component.program, expected.sent.server, expected.sent.cells)

    def _allowed(self, expected: Expected) -> Allowed:
        program, timing = self.component.program, self.component.timing
        values = self._values(expected)
        start = round((expected.low - timing.begin) / timing.unit)
        topic = self.component.topics[expected.topic]
        state = ((topic, f"{values}"),)
        server = program.servers[expected.server].name if expected.server >= 0 else "constructor"
        return Allowed(self.component.name, server, "", start, start, state, 0)


def _order(expected: Expected) -> tuple[float, float, int, tuple[Cell, ...], int, int]:
    low, high, topic, sent, server = expected
    return low, high, topic, sent.cells, sent.after, server


def _code_of(server: MessageServer) -> CodePlace | None:
    spans = (getattr(node, "span", None) for node in walk(server))
    found = next((span for span in spans if isinstance(span, SourceSpan)), None)
    if found is None:
        return None
    return CodePlace(found.source.path, found.source.position(found.start).line, found)


def _overdue(dead: Hypothesis) -> list[Candidate]:
    """What should have been served, and was not in time."""
    due = sorted(dead.pending, key=lambda p: p.high)[:1]
    return [Candidate(p.server, p.cells, p.low, p.high, p) for p in due]


def _shown(output: Output | None) -> str:
    return f"({', '.join(map(_value, output.values))})" if output is not None else "nothing"


def _value(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
