"""What a run of a package showed: the bodies served, the messages, the log, the velocities."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

Fields: TypeAlias = Mapping[str, Any]

WARNING, ERROR = 4, 8
_BODY = ("server", "arguments", "arrival", "start", "now")
# What rospy says of a connection that it makes again.
_RETRIED = "Inbound TCP/IP connection failed"
_REPORT = re.compile(r"(\w+): ([^ .]+)\.(\w+) \((.*)\)", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Served:
    """A body that ran; times are the model's, `stamp` is the clock's, counted from time 0."""

    rebec: str
    server: str
    arguments: str
    arrival: int
    start: int
    now: int
    stamp: float
    state: Fields


@dataclass(frozen=True, slots=True)
class Heard:
    """A message on a topic."""

    topic: str
    stamp: float
    fields: Fields


@dataclass(frozen=True, slots=True)
class Logged:
    """A line of a node's log; levels are those of rosgraph_msgs/Log."""

    node: str
    level: int
    stamp: float
    text: str


@dataclass(frozen=True, slots=True)
class Report:
    """What the mailbox reports: `kind: rebec.server (facts)`."""

    kind: str
    rebec: str
    server: str
    facts: str
    stamp: float


@dataclass(frozen=True, slots=True)
class Pose:
    """A place in metres and a heading in radians."""

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0


ORIGIN = Pose()


@dataclass(frozen=True, slots=True)
class Velocity:
    """A velocity that a robot was told, from `stamp` on."""

    stamp: float
    x: float
    y: float
    turn: float


@dataclass(frozen=True, slots=True)
class Recording:
    """Everything that was heard; `late` is what came after the nodes were told to stop.

    `run_log` is the log of the run, as `rebsync conform` reads it.
    """

    served: tuple[Served, ...]
    messages: tuple[Heard, ...]
    log: tuple[Logged, ...]
    late: tuple[Heard, ...]
    output: str
    run_log: Path = Path()

    def bodies(self, rebec: str) -> tuple[Served, ...]:
        """The message servers that a rebec served, in order."""
        own = (s for s in self.served if s.rebec == rebec)
        return tuple(s for s in own if s.server != "constructor")

    def order(self, rebec: str) -> list[str]:
        """What a rebec served, as `server(arguments)@start`."""
        return [f"{s.server}({s.arguments})@{s.start}" for s in self.bodies(rebec)]

    def final(self, rebec: str) -> Fields:
        """The state variables of a rebec after its last body."""
        return [s for s in self.served if s.rebec == rebec][-1].state

    def heard(self, topic: str) -> tuple[Heard, ...]:
        """The messages on one topic."""
        return tuple(m for m in self.messages if m.topic == topic)

    def reports(self, *kinds: str) -> tuple[Report, ...]:
        """What the mailboxes reported, of the given kinds or of all."""
        found = (_report(line) for line in self.log if line.level >= WARNING)
        return tuple(r for r in found if r is not None and (not kinds or r.kind in kinds))

    def problems(self) -> tuple[str, ...]:
        """All warnings and errors in the log, as text."""
        return tuple(f"{line.node}: {line.text}" for line in self.log if line.level >= WARNING)

    def velocities(self, rebec: str, late: bool = False) -> tuple[Velocity, ...]:
        """What a robot's cmd_vel said, and, if asked for, after the nodes were told to stop."""
        heard = [*self.messages, *(self.late if late else ())]
        own = [m for m in heard if m.topic == f"/{rebec}/cmd_vel"]
        return tuple(_velocity(m.stamp, m.fields) for m in own)

    def path(self, rebec: str, start: Pose = ORIGIN) -> tuple[tuple[float, Pose], ...]:
        """Where a robot's velocities took it, with the times of the turns."""
        return integrate(self.velocities(rebec), start)


def integrate(velocities: Iterable[Velocity], start: Pose) -> tuple[tuple[float, Pose], ...]:
    """The poses at the times of the velocities, each held until the next."""
    poses: list[tuple[float, Pose]] = []
    pose, last = start, None
    for velocity in velocities:
        if last is not None:
            pose = _moved(pose, last, velocity.stamp - last.stamp)
        poses.append((velocity.stamp, pose))
        last = velocity
    return tuple(poses)


def _moved(pose: Pose, velocity: Velocity, time: float) -> Pose:
    turn = velocity.turn * time
    cosine, sine = math.cos(pose.heading + turn / 2), math.sin(pose.heading + turn / 2)
    return Pose(
        pose.x + (velocity.x * cosine - velocity.y * sine) * time,
        pose.y + (velocity.x * sine + velocity.y * cosine) * time,
        pose.heading + turn,
    )


def read_recording(path: Path, output: str) -> Recording:
    """The recorder's file as values."""
    lines = [json.loads(line) for line in path.read_text().splitlines()]
    end = next((i for i, line in enumerate(lines) if line["kind"] == "end"), None)
    if end is None:
        raise ValueError("the recorder did not get to the end")
    zero = max(lines[end]["data"]["announced"].values(), default=0.0)
    heard = [_heard(line, zero) for line in lines if line["kind"] == "message"]
    logged = [_logged(line, zero) for line in lines if line["kind"] == "log"]
    during = sum(line["kind"] == "message" for line in lines[:end])
    log = path.with_name("run.jsonl")  # what follows is after the nodes were told to stop
    log.write_text("".join(f"{line}\n" for line in path.read_text().splitlines()[:end]))
    return Recording(
        tuple(_served(m) for m in heard[:during] if set(_BODY) <= set(m.fields)),
        tuple(heard[:during]),
        tuple(log for log in logged if not log.text.startswith(_RETRIED)),
        tuple(heard[during:]),
        output,
        log,
    )


def _heard(line: Fields, zero: float) -> Heard:
    return Heard(line["topic"], round(line["stamp"] - zero, 6), line["data"])


def _logged(line: Fields, zero: float) -> Logged:
    data = line["data"]
    stamp = round(line["stamp"] - zero, 6)
    return Logged(data["node"].rsplit("/", 1)[-1], data["level"], stamp, data["text"])


def _served(message: Heard) -> Served:
    fields = message.fields
    rebec = message.topic.strip("/").rsplit("/", 1)[0]
    state = {name: value for name, value in fields.items() if name not in _BODY}
    server, arguments, arrival, start, now = (fields[name] for name in _BODY)
    return Served(rebec, server, arguments, arrival, start, now, message.stamp, state)


def _report(line: Logged) -> Report | None:
    found = _REPORT.fullmatch(line.text)
    if found is None:
        return None
    kind, rebec, server, facts = found.groups()
    return Report(kind, rebec, server, facts, line.stamp)


def _velocity(stamp: float, twist: Fields) -> Velocity:
    linear, angular = twist["linear"], twist["angular"]
    return Velocity(stamp, linear["x"], linear["y"], angular["z"])
