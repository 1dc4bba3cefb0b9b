"""Runs made by hand: a recorder that keeps states, bags and times of a run consistent."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from rebsync.checker.result import Coverage, Result, Violation
from rebsync.checker.steps import Action, Semantics
from rebsync.checker.trace import Change, ShownMessage, ShownRebec, Trace, TraceStep

Values = Mapping[str, str]


@dataclass
class Recorder:
    """Records the steps of a run whose rebecs have the variables of `start`."""

    rebecs: dict[str, dict[str, str]]
    model: str = "crossing.rebeca"
    semantics: Semantics = "tts"
    now: int = 0
    steps: list[TraceStep] = field(default_factory=list)
    bags: dict[str, list[ShownMessage]] = field(default_factory=dict)
    busy: dict[str, tuple[int, int]] = field(default_factory=dict)
    serving: dict[str, ShownMessage] = field(default_factory=dict)

    def message(
        self,
        sender: str,
        receiver: str,
        server: str,
        arguments: Values,
        after: int,
        due: int | None,
    ) -> ShownMessage:
        """A message as a step sends it."""
        deadline = None if due is None else self.now + due
        values = tuple(arguments.items())
        return ShownMessage(server, values, sender, self.now + after, deadline, receiver)

    def start(self, *sent: ShownMessage, changes: Mapping[str, Values] | None = None) -> None:
        """The constructors run."""
        self._add("start", "", None, sent, changes or {}, Action(-1))

    def take(
        self,
        rebec: str,
        *sent: ShownMessage,
        changes: Values | None = None,
        delay: int | None = None,
        line: int = 10,
        choices: tuple[str, ...] = (),
        failure: str | None = None,
    ) -> None:
        """A rebec takes the first message of its bag."""
        message = self.bags[rebec][0] if failure else self.bags[rebec].pop(0)
        if delay is not None:
            self.busy[rebec] = (self.now + delay, line + 1)
            self.serving[rebec] = message
        chosen = tuple(range(len(choices)))
        action = Action(list(self.rebecs).index(rebec), 0, chosen)
        self._add(
            "take", rebec, message, sent, {rebec: changes or {}}, action, line, choices, failure
        )

    def resume(self, rebec: str, *sent: ShownMessage, changes: Values | None = None) -> None:
        """A rebec goes on after a delay."""
        _, line = self.busy.pop(rebec)
        action = Action(list(self.rebecs).index(rebec))
        message = self.serving.pop(rebec)
        self._add("resume", rebec, message, sent, {rebec: changes or {}}, action, line)

    def pass_time(self, until: int) -> None:
        """Time passes."""
        self._add("time", "", None, (), {}, Action(-1), until=until)
        self.now = until

    def trace(self, loop: int | None = None) -> Trace:
        """The run so far."""
        return Trace(self.model, self.semantics, tuple(self.steps), loop)

    def _add(
        self,
        kind: str,
        rebec: str,
        message: ShownMessage | None,
        sent: tuple[ShownMessage, ...],
        changes: Mapping[str, Values],
        action: Action,
        line: int = 0,
        choices: tuple[str, ...] = (),
        failure: str | None = None,
        until: int | None = None,
    ) -> None:
        changed = tuple(
            Change(who, name, self.rebecs[who][name], value)
            for who, values in changes.items()
            for name, value in values.items()
        )
        if failure is None:
            for each in changed:
                self.rebecs[each.rebec][each.variable] = each.after
            for each_sent in sent:
                bag = self.bags.setdefault(each_sent.receiver, [])
                bag.append(replace(each_sent, receiver=""))
                bag.sort(key=lambda m: m.arrival)
        self.steps.append(
            TraceStep(
                len(self.steps),
                kind,
                self.now,
                self.now if until is None else until,
                rebec,
                message,
                choices,
                sent,
                changed,
                line,
                self._state(),
                action,
                failure,
            )
        )

    def _state(self) -> tuple[ShownRebec, ...]:
        return tuple(
            ShownRebec(
                name,
                tuple(variables.items()),
                tuple(self.bags.get(name, ())),
                *self.busy.get(name, (None, None)),
            )
            for name, variables in self.rebecs.items()
        )


def crossing(*, failing: bool = True) -> Trace:
    """Two robots and a controller: messages at once and later, a delay, a choice, a failure."""
    run = Recorder(
        {
            "controller": {"granted": "null", "waiting[0]": "false", "waiting[1]": "false"},
            "left": {"at": "0", "speed": "0.5", "moving": "false"},
            "right": {"at": "9", "speed": "1.5", "moving": "false"},
        }
    )
    run.start(
        run.message("left", "left", "begin", {}, 0, None),
        run.message("right", "right", "begin", {}, 2, None),
        changes={"left": {"at": "1"}, "right": {"at": "8"}},
    )
    request = run.message("left", "controller", "request", {"id": "0", "urgent": "true"}, 0, 5)
    run.take("left", request, changes={"moving": "true"}, line=31, choices=("true",))
    grant = run.message("controller", "left", "grant", {}, 3, None)
    run.take("controller", grant, changes={"granted": "left", "waiting[0]": "true"}, line=12)
    run.pass_time(2)
    request = run.message("right", "controller", "request", {"id": "1", "urgent": "false"}, 1, None)
    run.take("right", request, changes={"moving": "true"}, line=31)
    run.pass_time(3)
    run.take("left", delay=4, changes={"at": "2"}, line=36)
    run.take("controller", changes={"waiting[1]": "true"}, line=12)
    run.pass_time(7)
    done = run.message("left", "controller", "request", {"id": "0", "urgent": "false"}, 0, None)
    run.resume("left", done, changes={"at": "3"})
    if failing:
        run.take("controller", line=12, failure="an assertion fails: one <at> a time")
    return run.trace()


def lasso() -> Trace:
    """Two rebecs that play ball for ever."""
    run = Recorder({"ping": {"hits": "0"}, "pong": {}}, model="ball.rebeca")
    run.start(run.message("ping", "ping", "hit", {}, 0, None))
    run.take("ping", run.message("ping", "pong", "hit", {}, 1, None), changes={"hits": "1"})
    run.pass_time(1)
    run.take("pong", run.message("pong", "ping", "hit", {}, 1, None))
    run.pass_time(2)
    run.take("ping", run.message("ping", "pong", "hit", {}, 1, None))
    run.pass_time(3)
    return run.trace(loop=2)


def long_run(rebecs: int, steps: int, seed: int = 0) -> Trace:
    """A run at random of so many rebecs and steps."""
    draw = random.Random(seed)
    names = [f"node{i}" for i in range(rebecs)]
    run = Recorder({n: {"count": "0", "mode": "idle", "far[0]": "0"} for n in names}, "net.rebeca")
    run.start(*(run.message(n, n, "wake", {}, draw.randrange(3), None) for n in names))
    while len(run.steps) <= steps:
        _one_more(run, names, draw)
    return run.trace()


def _one_more(run: Recorder, names: list[str], draw: random.Random) -> None:
    resumable = [n for n, (until, _) in run.busy.items() if until <= run.now]
    ready = [
        n
        for n in names
        if n not in run.busy and run.bags.get(n) and run.bags[n][0].arrival <= run.now
    ]
    if resumable:
        run.resume(resumable[0], changes={"mode": "idle"})
    elif ready:
        name = draw.choice(ready)
        to = draw.sample(names, draw.choice((1, 1, 1, 2)))
        values = {"from": str(draw.randrange(100)), "retry": draw.choice(("true", "false"))}
        sent = [
            run.message(name, t, draw.choice(("report", "tick")), values, draw.choice((0, 0, 3)), 9)
            for t in to
        ]
        delay = draw.choice((None, None, 2))
        changes = {"count": str(draw.randrange(1000))} if delay is None else {"mode": "driving"}
        run.take(name, *sent, changes=changes, delay=delay)
    else:
        arrivals = [bag[0].arrival for n, bag in run.bags.items() if bag and n not in run.busy]
        run.pass_time(min(arrivals + [until for until, _ in run.busy.values()]))


def violation(trace: Trace, kind: str = "assertion", name: str = "one <at> a time") -> Violation:
    """A violation that a run shows."""
    last = trace.steps[-1]
    message = last.failure or f'"{name}" does not hold'
    return Violation(kind, name, message, trace.model, last.line, trace)  # type: ignore[arg-type]


def result(*violations: Violation) -> Result:
    """The result of a verification that found these violations."""
    return Result(
        "violated" if violations else "satisfied",
        None,
        ("overflow is undecided: the model delays",) if violations else (),
        (("Safe", "satisfied"), ("OneAtATime", "violated" if violations else "satisfied")),
        violations,
        Coverage(
            ("Robot.stop",), ((14, "the condition is never true"),), (("left", 2, 5),), (21, 22)
        ),
        12345,
        23456,
        17,
        "tts",
        "interpreted",
        0.75,
        0.5,
        0.0,
        51_200_000,
    )
