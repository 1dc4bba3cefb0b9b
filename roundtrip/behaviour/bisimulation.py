"""Whether two models do the same: their state spaces are bisimilar, up to names.

What is seen of a step is who takes which message, what is sent when, how much time passes, and
the state variables that both models have.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Literal, TypeAlias

from rebsync.checker.sizes import check_sizes
from rebsync.checker.steps import Step
from rebsync.roundtrip.behaviour.transitions import (
    FAILED,
    ROOT,
    Event,
    Known,
    Observed,
    Transitions,
    words_of,
)
from rebsync.roundtrip.diff.behaviour import Behaviour, RunStep
from rebsync.roundtrip.diff.difference import Depth, Place
from rebsync.roundtrip.diff.matching import matched
from rebsync.roundtrip.diff.operands import Operand, SourcedModel, side

MOST_STATES = 20_000
_MOST_PAIRS = 20_000
_NOTHING: Observed = ()

Both: TypeAlias = tuple[Transitions, Transitions]


def compare_behaviour(
    left: SourcedModel, right: SourcedModel, most: int = MOST_STATES
) -> Behaviour:
    """Compares what two models do; `most` bounds the states of each that are looked at."""
    for given, name in ((left, "first"), (right, "second")):
        if given.unread:
            return Behaviour("undetermined", f"not all of the {name} side could be read")
    sides = side(left, Depth.EQUAL), side(right, Depth.EQUAL)
    for each, name in zip(sides, ("first", "second"), strict=True):
        if why := _why_not(each):
            return Behaviour("undetermined", f"the {name} side cannot be run: {why}")
    matching = matched(*sides)
    known: Known = {}
    both = (
        Transitions(sides[0], words_of(sides[0], matching, True), known),
        Transitions(sides[1], words_of(sides[1], matching, False), known),
    )
    reasons = [each.explore(most) for each in both]
    return _judged(both, next(filter(None, reasons), ""))


def _why_not(side_: Operand) -> str:
    if side_.model.main is None:
        return "it has no main"
    found = (*side_.analysis.errors, *check_sizes(side_.analysis))
    return found[0].message if found else ""


def _judged(both: Both, reason: str) -> Behaviour:
    states = len(both[0].states) - 1, len(both[1].states) - 1
    if not reason and _are_bisimilar(both):
        return Behaviour("same", "", states)
    found = _Search(both).run()
    if isinstance(found, Behaviour):
        return replace(found, states=states)
    if reason or found:
        return Behaviour("undetermined", reason or found, states)
    why = "both have the same runs, but what can follow is decided at other steps"
    return Behaviour("different", why, states)


# --- bisimulation -------------------------------------------------------------------------------


def _are_bisimilar(both: Both) -> bool:
    """Splits the states of both into classes until all of a class can do the same."""
    offsets = 0, len(both[0].states)
    events: dict[Event, int] = {}
    steps: list[frozenset[tuple[int, int]]] = []
    for each, offset in zip(both, offsets, strict=True):
        for state in range(len(each.states)):
            steps.append(
                frozenset(
                    (events.setdefault(event, len(events)), _shifted(target, offset))
                    for event, target, _ in each.steps(state)
                )
            )
    classes = [0] * len(steps)
    count = 1
    while True:
        known: dict[object, int] = {}
        signatures = [
            (classes[i], frozenset((e, classes[t] if t >= 0 else FAILED) for e, t in steps[i]))
            for i in range(len(steps))
        ]
        classes = [known.setdefault(signature, len(known)) for signature in signatures]
        if classes[offsets[0]] != classes[offsets[1]]:
            return False
        if len(known) == count:
            return True
        count = len(known)


def _shifted(target: int, offset: int) -> int:
    return target + offset if target >= 0 else FAILED


# --- a run that only one has --------------------------------------------------------------------

_Pair: TypeAlias = tuple[frozenset[int], frozenset[int]]


class _Search:
    """Breadth first through the runs of both: each pair holds where the same run may have led."""

    def __init__(self, both: Both) -> None:
        self.both = both
        self.observed = list(both[0].known)
        self.start: _Pair = (frozenset({ROOT}), frozenset({ROOT}))
        self.before: dict[_Pair, tuple[_Pair, Event] | None] = {self.start: None}

    def run(self) -> Behaviour | str:
        """The difference; or why there may be one that was not found, empty if there is none."""
        waiting = deque([self.start])
        cut = ""
        while waiting:
            pair = waiting.popleft()
            if not all(
                each.is_made(s) for each, of in zip(self.both, pair, strict=True) for s in of
            ):
                cut = "a bound was reached"
                continue
            enabled = self._enabled(pair)
            if enabled[0].keys() != enabled[1].keys():
                return self._difference(pair, enabled)
            for event, lefts in enabled[0].items():
                after: _Pair = (lefts - {FAILED}, enabled[1][event] - {FAILED})
                if after not in self.before and all(after):
                    self.before[after] = (pair, event)
                    waiting.append(after)
            if len(self.before) > _MOST_PAIRS:
                return "there are too many ways in which both could go on"
        return cut

    def _difference(self, pair: _Pair, enabled: Sequence[Mapping[Event, object]]) -> Behaviour:
        """A step of the right side that the left one lacks, or else the other way round."""
        lefts, rights = (
            sorted(mine.keys() - other.keys(), key=repr)
            for mine, other in (enabled, reversed(enabled))
        )
        only: Literal["left", "right"] = "right" if rights else "left"
        (event, *_), others = (rights, lefts) if rights else (lefts, rights)
        run = self._told(pair, event)
        same = [o for o in others if _acts(o) == _acts(event)]
        instead = self._told(pair, (same or others)[0])[-1] if others else None
        return Behaviour("different", only=only, run=run, instead=instead)

    def _enabled(self, pair: _Pair) -> tuple[dict[Event, frozenset[int]], ...]:
        """For each side the steps that it may make now, with where they lead."""
        found: list[dict[Event, frozenset[int]]] = []
        for each, states in zip(self.both, pair, strict=True):
            targets: dict[Event, set[int]] = {}
            for state in sorted(states):
                for event, target, _ in each.steps(state):
                    targets.setdefault(event, set()).add(target)
            found.append({event: frozenset(t) for event, t in targets.items()})
        return tuple(found)

    def _told(self, pair: _Pair, last: Event) -> tuple[RunStep, ...]:
        events: list[tuple[_Pair, Event]] = [(pair, last)]
        while (before := self.before[events[0][0]]) is not None:
            events.insert(0, before)
        told: list[RunStep] = []
        time, seen = 0, _NOTHING
        for at, event in events:
            places = [self._place(each, of, event) for each, of in zip(self.both, at, strict=True)]
            held = tuple(each for number in event.after for each in self.observed[number])
            told.append(RunStep(time, _text(event, seen, held), places[0], places[1]))
            time, seen = time + event.time, held
        return tuple(told)

    def _place(self, each: Transitions, states: frozenset[int], event: Event) -> Place | None:
        found: list[tuple[int, Step]] = [
            (s, step) for s in sorted(states) for e, _, step in each.steps(s) if e == event
        ]
        return each.place(*found[0]) if found else None


def _acts(event: Event) -> tuple[str, str, str]:
    return event.kind, event.rebec, event.server


def _text(event: Event, before: Observed, after: Observed) -> str:
    """What happens, what is sent, and what has changed."""
    match event.kind:
        case "start":
            text = "the constructors run"
        case "time":
            return (
                f"{event.time} units of time pass" if event.time != 1 else "1 unit of time passes"
            )
        case "take":
            text = f"{event.rebec} takes {event.server}({', '.join(event.arguments)})"
        case _:
            text = f"{event.rebec} goes on"
    known = set(before)
    changed = [f"{r}.{v} = {value}" for r, v, value in after if (r, v, value) not in known]
    parts = [_sent(event), ", ".join(changed) if before else ""]
    text = "; ".join([text, *filter(None, parts)])
    return f"{text}; fails: {event.failure}" if event.failure else text


def _sent(event: Event) -> str:
    texts = []
    for receiver, server, arguments, arrival, deadline in event.sent:
        after = f" after {arrival}" if arrival else ""
        due = f" deadline {deadline}" if deadline is not None else ""
        texts.append(f"{receiver}.{server}({', '.join(arguments)}){after}{due}")
    return f"sends {', '.join(texts)}" if texts else ""
