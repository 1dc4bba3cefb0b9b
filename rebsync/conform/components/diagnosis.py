"""Why a component's recording is no run of it: the message that no hypothesis explains."""

from __future__ import annotations

from typing import NamedTuple

from rebsync.conform.components.alignment import (
    Alignment,
    ChannelFault,
    Expected,
    by_time,
    expected,
)
from rebsync.conform.components.component import Component, Output
from rebsync.conform.components.inclusion import Inclusion, InclusionSearch
from rebsync.conform.components.interface import shown
from rebsync.conform.components.lost_inputs import LostInput
from rebsync.conform.conformance import Allowed, CodePlace, Deviation, Kind
from rebsync.model import Call, MessageServer, Model, ReactiveClass, walk
from rebsync.source import SourceSpan

_FEW = 5


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
        best = found.furthest[-1]
        alike = [each for each in found.furthest if each.matched == best.matched]
        change = Alignment(self.search, alike).cause()
        next_ = sorted({e for last in alike for e in expected(self.search, last)}, key=by_time)
        allowed = tuple(dict.fromkeys(map(self._allowed, next_)))[:_FEW]
        if isinstance(change, LostInput):
            return self._of_input(change, allowed)
        kind, why, output, at = self._reason(change, next_[0].due if next_ else best.low)
        topic = self.component.topics[change.topic] if change is not None else "its topics"
        when = f" at {output.stamp:.3f} s" if output is not None else ""
        shown = f"{self.component.name} publishes {_shown(output)} on {topic}{when}: {why}"
        message = shown if output is not None else f"{self.component.name} on {topic}: {why}"
        time = self._time(at)
        place = output.place if output is not None else None
        code = self._code(change, {each.server for each in allowed})
        name = self.component.name
        return Deviation(
            kind, name, time, message, None, 0, allowed, code=code, message_place=place
        )

    def _of_input(self, lost: LostInput, allowed: tuple[Allowed, ...]) -> Deviation:
        """A message that the node has not got, or has got and it is not in the recording."""
        program, name = self.component.program, self.component.name
        stamp, server, cells, *_ = lost.input
        values, callback = shown(program, server, cells), program.servers[server].name
        if lost.is_recorded:
            why = f"does not do what it does after {values} at {stamp:.3f} s: it has not got it"
        else:
            why = f"does at {stamp:.3f} s what it does after {values}, and none was recorded then"
        message, code = f"{name} on {callback}: it {why}", self._code(None, {callback})
        time = self._time(stamp)
        return Deviation("lost message", name, time, message, None, 0, allowed, code=code)

    def _time(self, stamp: float) -> int:
        """A stamp in units of the model since the recording began."""
        timing = self.component.timing  # what began before the recording is told at its beginning
        return max(round((stamp - timing.begin) / timing.unit), 0)

    def _code(self, change: ChannelFault | None, next_: set[str]) -> CodePlace | None:
        """Where in the code the callback is that a message comes from.

        It is the one that the model serves; else one that it could serve next (`next_`), or
        one that publishes on the topic.
        """
        program, found = self.component.program, self.model.classes
        class_name = program.rebecs[self.component.rebec].class_name
        class_ = next(c for c in found if isinstance(c, ReactiveClass) and c.name == class_name)
        servers = [member for member in class_.members if isinstance(member, MessageServer)]
        if change is not None and change.expected is not None and change.expected.server >= 0:
            next_ = {program.servers[change.expected.server].name}
        if change is not None and not next_:
            numbers = self.component.by_server
            links = {program.servers[n].name for n in numbers if numbers[n] == change.topic}
            next_ = {
                s.name for s in servers if links & {c.name for c in walk(s) if isinstance(c, Call)}
            }
        return next((_code_of(each) for each in servers if each.name in next_), None)

    def _reason(self, change: ChannelFault | None, due: float) -> Reason:
        """What a change says in words; without one nothing came that was due."""
        slack = self.component.timing.slack
        match change:
            case ChannelFault("lost message", _, _, Expected() as each):
                until = f"{each.high + slack:.3f} s"
                why = f"the model publishes {self._values(each)} by {until}"
                return Reason(
                    "lost message", f"{why}, and no such message was recorded", None, each.due
                )
            case ChannelFault("late" | "early" as kind, _, Output() as output, Expected() as each):
                by = f"from {each.low:.3f}" if kind == "early" else f"by {each.high + slack:.3f}"
                why = f"the model publishes it {by} s"
                return Reason(kind, why, output, min(output.stamp, each.due))
            case ChannelFault(
                "swapped" | "wrong value" as kind, _, Output() as output, Expected() as each
            ):
                why = f"the model publishes {self._values(each)}"
                if kind == "swapped":
                    why = f"{self._values(each)} has to be published before, and comes after"
                return Reason(kind, why, output, output.stamp)
            case ChannelFault("repeated", _, Output() as output, _):
                why = "it was published before, and the model publishes it once"
                return Reason("repeated", why, output, output.stamp)
            case ChannelFault(_, _, Output() as output, _):
                return Reason(
                    "unexpected", "the model publishes nothing then", output, output.stamp
                )
            case _:
                why = "the model goes on, and nothing of it is recorded"
                return Reason("silent", why, None, due)

    def _values(self, each: Expected) -> str:
        return shown(self.component.program, each.sent.server, each.sent.cells)

    def _allowed(self, each: Expected) -> Allowed:
        program, values = self.component.program, self._values(each)
        start = self._time(each.due)
        topic = self.component.topics[each.topic]
        state = ((topic, f"{values}"),)
        server = program.servers[each.server].name if each.server >= 0 else "constructor"
        return Allowed(self.component.name, server, "", start, start, state, 0)


def _code_of(server: MessageServer) -> CodePlace | None:
    spans = (getattr(node, "span", None) for node in walk(server))
    found = next((span for span in spans if isinstance(span, SourceSpan)), None)
    if found is None:
        return None
    return CodePlace(found.source.path, found.source.position(found.start).line, found)


def _shown(output: Output | None) -> str:
    return f"({', '.join(map(_value, output.values))})" if output is not None else "nothing"


def _value(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
