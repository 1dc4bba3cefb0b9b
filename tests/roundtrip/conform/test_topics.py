"""Packages that people wrote against recordings of their topics (packages/)."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from random import Random

import pytest

from rebsync.cli.recorded_topics import TopicBounds
from rebsync.roundtrip.conform.bags import OwnTypes
from rebsync.roundtrip.conform.components.heard import HeardRecordings
from rebsync.roundtrip.conform.conformance import Conformance
from tests.roundtrip.conform.real_time import Log, Package, Run, write

PACKAGES = Path(__file__).parent / "packages"
TOPICS = {
    "thermostat": ("/temperature", "/heat", "/power"),  # rospy
    "counter": ("/reset", "/count", "/alarm"),  # rclcpp
    "doors": ("/open", "/opened"),  # rclpy: chooses, and sleeps
}
FROM_START = TopicBounds(None, True, None)
ANYWHERE = TopicBounds(None, False, None)


@cache
def package(name: str) -> Package:
    """A package, read."""
    return Package.of(PACKAGES / name, TOPICS[name])


def recorded(name: str, seed: int, seconds: int = 30) -> Log:
    """What a good run shows."""
    random = Random(seed)
    times = [0.9 + 0.7 * n + random.uniform(0, 0.5) for n in range(int(seconds / 0.7))]
    outside = {
        "thermostat": [(t, "/temperature", random.randint(14, 26)) for t in times],
        "counter": [(t, "/reset", random.randint(0, 1)) for t in times[::5]],
        "doors": [],
    }
    return Run(package(name), random, 0.04, 100.0 + seconds).simulate(outside[name])


def of(name: str, log: Log, tmp_path: Path, bounds: TopicBounds = FROM_START) -> Conformance:
    """What is said of a log."""
    path = write(log, tmp_path / "run.jsonl")
    opened = HeardRecordings.of([str(path)], OwnTypes("", {}))
    return package(name).opened.compare(opened, bounds)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("name", TOPICS)
def test_good_runs_conform(name: str, seed: int, tmp_path: Path) -> None:
    log = recorded(name, seed)
    found = of(name, log, tmp_path)
    assert (found.verdict, found.compared) == ("conforms", found.recorded), found
    assert found.recorded > 5
    part = log[len(log) // 3 :]
    middle = of(name, part, tmp_path, ANYWHERE)
    if name == "doors" and middle.verdict == "undetermined":  # a body may have been at work
        assert "may have been in another state" in middle.reason
    else:
        assert middle.verdict == "conforms", middle
    nameless = of(name, [{k: v for k, v in m.items() if k != "node"} for m in log], tmp_path)
    assert nameless.verdict == "conforms", nameless


Fault = Callable[[Log, int], Log]


def dropped(log: Log, at: int) -> Log:
    """A message is not there."""
    return [*log[:at], *log[at + 1 :]]


def late(log: Log, at: int) -> Log:
    """A message comes late."""
    moved = [*log[:at], log[at] | {"stamp": log[at]["stamp"] + 0.45}, *log[at + 1 :]]
    return sorted(moved, key=lambda message: message["stamp"])


def wrong_value(log: Log, at: int) -> Log:
    """A message has another value."""
    value = log[at]["data"]["data"]
    other = not value if isinstance(value, bool) else value + 1
    return [*log[:at], log[at] | {"data": {"data": other}}, *log[at + 1 :]]


def swapped(log: Log, at: int) -> Log:
    """Two messages of a topic come in the other order."""
    value = log[at]["data"]
    same = (n for n in range(at + 1, len(log)) if log[n]["topic"] == log[at]["topic"])
    other = next(n for n in same if log[n]["data"] != value)
    found = list(log)
    found[at] = log[at] | {"data": log[other]["data"]}
    found[other] = log[other] | {"data": value}
    return found


def second_publisher(log: Log, at: int) -> Log:
    """Somebody else publishes on a topic of a node."""
    return [*log[: at + 1], log[at] | {"node": "/other"}, *log[at + 1 :]]


FAULTS: dict[str, tuple[Fault, set[str]]] = {
    "dropped": (dropped, {"lost message", "late", "wrong value", "swapped"}),
    "late": (late, {"late", "lost message"}),
    "wrong value": (
        wrong_value,
        {"wrong value", "swapped", "repeated", "lost message", "unexpected"},
    ),
    "swapped": (swapped, {"swapped", "wrong value", "repeated", "unexpected"}),
    "second publisher": (second_publisher, {"second publisher"}),
}
OUTPUTS = {
    "thermostat": ("/heat", "/power"),
    "counter": ("/count", "/alarm"),
    "doors": ("/opened",),
}


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("name", TOPICS)
def test_faults_are_found(name: str, fault: str, tmp_path: Path) -> None:
    log = recorded(name, 5)
    make, kinds = FAULTS[fault]
    for topic in OUTPUTS[name]:
        own = [n for n, message in enumerate(log) if message["topic"] == topic]
        at = own[len(own) // 2]
        if fault == "swapped" and len({str(log[n]["data"]) for n in own[len(own) // 2 :]}) < 2:
            continue
        found = of(name, make(log, at), tmp_path)
        assert found.verdict == "deviates", (topic, found)
        assert found.deviation is not None
        assert found.deviation.kind in kinds, found.deviation
        told = 100.0 + (log[at]["stamp"] - 100.0)
        begin = min(message["stamp"] for message in log)
        assert abs(begin + found.deviation.time * 0.001 - told) < 1.2, found.deviation
