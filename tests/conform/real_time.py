"""Runs of packages that people wrote as they go in real time, by their models.

Nodes start when they like, messages and timers are late by something; a log has what was on topics.
"""

from __future__ import annotations

import heapq
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import Any

from rebsync.checker.program import Program
from rebsync.cli.recorded_topics import OpenPackage
from rebsync.conform.components.bodies import BodyRun, ComponentBodies
from rebsync.conform.components.environment import CLASS
from rebsync.conform.components.interface import Interface, interfaces
from rebsync.reverse.files.reading import chosen

UNIT = 0.001
Log = list[dict[str, Any]]


@dataclass(frozen=True)
class Package:
    """A package with the topics that are of interest."""

    opened: OpenPackage
    program: Program
    interfaces: tuple[Interface, ...]
    topics: Mapping[str, str]  # by the environment's servers

    @classmethod
    def of(cls, path: Path, topics: Sequence[str]) -> Package:
        """Reads it."""
        opened = OpenPackage.of(chosen(str(path)), topics)
        links = opened.closed.links
        names = {name: link.topic for name, link in links.items()}
        return cls(opened, opened.subject.program, interfaces(opened.model, links), names)


@dataclass
class Run:
    """One run; `outside` are messages from outside: time, topic, value."""

    package: Package
    random: Random
    latency: float
    end: float
    log: Log = field(default_factory=list)
    _queue: list[tuple[float, int, int, tuple[int, ...]]] = field(default_factory=list)

    def simulate(self, outside: Sequence[tuple[float, str, int]]) -> Log:
        """What was recorded."""
        program = self.package.program
        environment = next(n for n, r in enumerate(program.rebecs) if r.class_name == CLASS)
        nodes = [n for n in range(len(program.rebecs)) if n != environment]
        bodies = {n: ComponentBodies(program, n, environment) for n in nodes}
        state: dict[int, tuple[int, ...]] = {}
        free: dict[int, float] = {}
        for node in nodes:
            begun = 99.5 + self.random.uniform(0, 0.4)
            run = self.random.choice(bodies[node].constructed())
            state[node], free[node] = run.variables, begun
            self._done(node, run, begun)
        for time, topic, value in outside:
            self._publish(100 + time, topic, (value,), "/outside")
        while self._queue:
            time, node, server, cells = heapq.heappop(self._queue)
            if time > self.end:
                break
            if free[node] > time:
                self._push(free[node] + 1e-4, node, server, cells)
                continue
            run = self.random.choice(bodies[node].runs(state[node], server, cells))
            state[node], free[node] = run.variables, time + run.busy * UNIT
            self._done(node, run, time)
        return sorted(self.log, key=lambda message: message["stamp"])

    def _done(self, node: int, run: BodyRun, time: float) -> None:
        names = [s.name for s in self.package.program.servers]
        for sent in run.published:
            topic = self.package.topics[names[sent.server]]
            name = f"/{self.package.program.rebecs[node].name}"
            self._publish(time + sent.after * UNIT, topic, sent.cells, name)
        for post in run.posted:
            late = self.random.uniform(0, self.latency)
            self._push(time + post.after * UNIT + late, node, post.server, post.cells)

    def _publish(self, time: float, topic: str, cells: tuple[int, ...], node: str) -> None:
        stamp = time + self.random.uniform(0, self.latency)
        kind = bool if topic in ("/heat", "/reset", "/alarm", "/open") else int
        data = {"data": kind(cells[0])}
        if stamp <= self.end:
            self.log.append({"topic": topic, "stamp": stamp, "data": data, "node": node})
        program = self.package.program
        names = [rebec.name for rebec in program.rebecs]
        for each in self.package.interfaces:
            for received in each.received:
                if self.package.topics[received.link] == topic:
                    rebec = names.index(each.rebec)
                    dispatch = (n for n in program.rebecs[rebec].dispatch if n >= 0)
                    servers = {program.servers[n].name: n for n in dispatch}
                    late = self.random.uniform(0, self.latency)
                    self._push(time + late, rebec, servers[received.server], cells)

    def _push(self, time: float, node: int, server: int, cells: tuple[int, ...]) -> None:
        heapq.heappush(self._queue, (time, node, server, cells))


def write(log: Log, path: Path) -> Path:
    """A log as lines of JSON."""
    path.write_text("".join(f"{json.dumps(line)}\n" for line in log))
    return path
