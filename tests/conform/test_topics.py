"""Packages that people wrote against recordings of their topics (packages/)."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from pathlib import Path
from random import Random
from shutil import copytree
from typing import Any

import pytest
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore

from rebsync.cli.recorded_topics import TopicBounds, compared
from rebsync.conform.bags import OwnTypes
from rebsync.conform.components.heard import HeardRecordings
from rebsync.conform.conformance import Conformance
from tests.conform.real_time import Log, Package, Run, write

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


@pytest.mark.parametrize("seed", [0, 1, 2, 3, 8])  # 8: the last message's cause comes too late
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


def repeated(log: Log, at: int) -> Log:
    """A message comes twice."""
    again = log[at] | {"stamp": log[at]["stamp"] + 0.02}
    return sorted([*log, again], key=lambda message: message["stamp"])


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


def early(log: Log, at: int) -> Log:
    """A message comes before it can."""
    moved = [*log[:at], log[at] | {"stamp": log[at]["stamp"] - 0.3}, *log[at + 1 :]]
    return sorted(moved, key=lambda message: message["stamp"])


def silent(log: Log, at: int) -> Log:
    """A node is not there any more."""
    return [m for n, m in enumerate(log) if n < at or m["node"] != log[at]["node"]]


FAULTS: dict[str, tuple[Fault, str]] = {
    "dropped": (dropped, "lost message"),
    "late": (late, "late"),
    "wrong value": (wrong_value, "wrong value"),
    "swapped": (swapped, "swapped"),
    "repeated": (repeated, "repeated"),
    "early": (early, "early"),
    "silent": (silent, "silent"),
    "second publisher": (second_publisher, "second publisher"),
}
OUTPUTS = {
    "thermostat": ("/heat", "/power"),
    "counter": ("/count", "/alarm"),
    "doors": ("/opened",),
}


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("name", TOPICS)
def test_faults_are_found(name: str, fault: str, tmp_path: Path) -> None:
    log = recorded(name, 5, 80)
    make, kind = FAULTS[fault]
    for topic in OUTPUTS[name]:
        own = [n for n, message in enumerate(log) if message["topic"] == topic]
        at = own[len(own) // 2]
        if fault == "swapped":  # with the one after it
            late_half = pairwise(own[len(own) // 2 :])
            at = next(a for a, b in late_half if log[a]["data"] != log[b]["data"])
        found = of(name, make(log, at), tmp_path)
        assert found.verdict == "deviates", (topic, found)
        assert found.deviation is not None
        assert found.deviation.kind == kind, found.deviation
        told = min(message["stamp"] for message in log) + found.deviation.time * 0.001
        assert abs(told - log[at]["stamp"]) < 1.2, found.deviation


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("seed", [8, 9, 10])
def test_faults_are_told_apart_wherever_they_are(seed: int, fault: str, tmp_path: Path) -> None:
    log = recorded("counter", seed)
    make, kind = FAULTS[fault]
    begin = min(message["stamp"] for message in log) + 2.5  # topics are connected then
    own = [n for n, m in enumerate(log) if m["topic"] in OUTPUTS["counter"] and m["stamp"] > begin]
    for at in own[:-7:4]:
        deviation = of("counter", make(log, at), tmp_path).deviation
        assert deviation is not None
        assert deviation.kind == kind, (at, deviation)
        told = begin - 2.5 + deviation.time * 0.001
        assert abs(told - log[at]["stamp"]) < 1.2, deviation


# --- a run on a real roscore (tests/ros1/nodes/topics.py)

REAL = Path(__file__).parent / "recordings" / "thermostat.jsonl"


def read(path: Path) -> Log:
    """The messages of a log."""
    return [json.loads(line) for line in path.read_text().splitlines()]


def real() -> Log:
    """The messages of that run."""
    return read(REAL)


@pytest.mark.parametrize("is_bag", [False, True])
def test_a_real_run_conforms(is_bag: bool, tmp_path: Path) -> None:
    path = bag(real(), tmp_path / "run.bag") if is_bag else REAL
    found, _ = compared(str(PACKAGES / "thermostat"), [str(path)], ANYWHERE)
    assert (found.verdict, found.compared) == ("conforms", 60), found


def bag(log: Log, path: Path) -> Path:
    """A log as a bag of ROS 1."""
    store = get_typestore(Stores.ROS1_NOETIC)
    with Writer(path) as writer:
        connections: dict[str, Any] = {}
        for message in log:
            name, value = message["topic"], message["data"]["data"]
            type_ = f"std_msgs/msg/{'Bool' if isinstance(value, bool) else 'Int32'}"
            if name not in connections:
                caller = {"callerid": message["node"]}
                connections[name] = writer.add_connection(name, type_, typestore=store, **caller)
            raw = store.serialize_ros1(store.types[type_](data=value), type_)
            writer.write(connections[name], round(message["stamp"] * 1e9), raw)
    return path


@pytest.mark.parametrize("fault", FAULTS)
def test_faults_in_a_real_run_are_found(fault: str, tmp_path: Path) -> None:
    log = real()
    make, kind = FAULTS[fault]
    for topic in OUTPUTS["thermostat"]:
        own = [n for n, message in enumerate(log) if message["topic"] == topic]
        found = of("thermostat", make(log, own[len(own) // 3]), tmp_path)
        assert found.verdict == "deviates", (topic, found)
        assert found.deviation is not None
        assert found.deviation.kind == kind, found.deviation
        script = {"/heat": "thermostat.py", "/power": "heater.py"}[topic]
        place = found.deviation.code
        assert place.path.endswith(script) if place else fault == "second publisher"


def test_what_messages_took_is_measured(tmp_path: Path) -> None:
    log = real()
    own = [n for n, message in enumerate(log) if message["topic"] == "/heat"]
    late = log[own[5]]["stamp"] + 0.06
    log[own[5]] |= {"stamp": late}
    path = write(sorted(log, key=lambda m: m["stamp"]), tmp_path / "run.jsonl")
    measuring = TopicBounds(None, False, None, True)
    found, _ = compared(str(PACKAGES / "thermostat"), [str(path)], measuring)
    took = {(i.rebec, i.server, i.topic, i.kind): i.seconds for i in found.intervals}
    assert list(took) == [
        ("heater", "tick", "/power", "period"),
        ("thermostat", "measured", "/heat", "delay"),
    ]
    ticks = [m["stamp"] for m in log if m["topic"] == "/power"]
    assert list(took["heater", "tick", "/power", "period"]) == pytest.approx(
        [after - before for before, after in pairwise(ticks)]
    )
    inputs = [m["stamp"] for m in log if m["topic"] == "/temperature"]
    cause = max(stamp for stamp in inputs if stamp < late)
    delays = took["thermostat", "measured", "/heat", "delay"]
    assert len(delays) == len(own)
    assert max(delays) == pytest.approx(late - cause)


# --- messages that are kept for who connects later

BUMPERBOT = Path(__file__).parent / "recordings" / "bumperbot.jsonl"  # roscpp; /mode is latched


def connected_late(log: Log, topic: str, begin: float, by: float) -> Log:
    """What a recorder shows that began then, and connected to a latched topic later."""
    own = [m for m in log if m["topic"] == topic]
    old = [m for m in own if m["stamp"] <= begin + by][-1] | {"stamp": begin + by}
    others = [m for m in log if m["topic"] != topic and m["stamp"] >= begin]
    found = [old, *others, *(m for m in own if m["stamp"] > begin + by)]
    return sorted(found, key=lambda m: m["stamp"])


@pytest.mark.parametrize("by", [0.05, 0.6, 1.4])
@pytest.mark.parametrize("begin", [0.0, 3.1, 12.2, 18.0, 40.7])
def test_the_first_message_of_a_latched_topic_is_an_old_one(
    begin: float, by: float, tmp_path: Path
) -> None:
    log = read(BUMPERBOT)
    late = connected_late(log, "/mode", log[0]["stamp"] + begin, by)
    driver = [m for m in late if m["node"] in ("/driver", "/tester")]  # the other one counts up
    path = write(driver, tmp_path / "run.jsonl")
    found, _ = compared(str(PACKAGES / "bumperbot"), [str(path)], ANYWHERE)
    assert (found.verdict, found.deviation) == ("conforms", None), found


@pytest.mark.parametrize("topic", ["/cmd_vel", "/mode"])
@pytest.mark.parametrize("fault", FAULTS)
def test_faults_beside_a_latched_topic_are_found(fault: str, topic: str, tmp_path: Path) -> None:
    log = read(BUMPERBOT)
    make, kind = FAULTS[fault]
    if fault in ("wrong value", "swapped") and topic == "/cmd_vel":
        return  # of several fields
    own = [n for n, message in enumerate(log) if message["topic"] == topic]
    faulty = make(connected_late(log, "/mode", log[0]["stamp"], 0.6), own[len(own) // 2])
    path = write(faulty, tmp_path / "run.jsonl")
    found, _ = compared(str(PACKAGES / "bumperbot"), [str(path)], FROM_START)
    assert found.deviation is not None, found
    assert (found.deviation.kind, found.deviation.rebec) == (kind, "driver"), found.deviation


_LAMP = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class Button:
    def __init__(self):
        self.press = rospy.Publisher("press", Int32, queue_size=10)
        rospy.Timer(rospy.Duration(9.0), self.on_timer)

    def on_timer(self, event):
        self.press.publish(Int32(data=1))


class Lamp:
    def __init__(self):
        self.count = 0
        self.lit = rospy.Publisher("lit", Int32, queue_size=10, latch=True)
        rospy.Subscriber("press", Int32, self.on_press, queue_size=10)

    def on_press(self, message):
        self.count += message.data
        self.lit.publish(Int32(data=self.count))


if __name__ == "__main__":
    rospy.init_node("NAME")
    node = CLASS()
    rospy.spin()
"""


@pytest.mark.parametrize(
    ("late", "bounds", "verdict"),
    [
        (0.01, FROM_START, "conforms"),
        (1.5, FROM_START, "conforms"),  # so long a recorder may take to connect
        (5.0, FROM_START, "deviates"),
        (5.0, ANYWHERE, "conforms"),
    ],
)
def test_who_records_from_the_start_on_has_soon_connected(
    late: float, bounds: TopicBounds, verdict: str, tmp_path: Path
) -> None:
    head, rest = _LAMP.split("\n\nclass Button", 1)
    button, rest = rest.split("\n\nclass Lamp", 1)
    lamp, end = rest.split("\n\nif __name__", 1)
    scripts = tmp_path / "lamp" / "scripts"
    scripts.mkdir(parents=True)
    for name, body in (("Button", button), ("Lamp", lamp)):
        text = f"{head}\n\nclass {name}{body}\n\nif __name__{end}".replace("CLASS", name)
        (scripts / f"{name.lower()}.py").write_text(text.replace("NAME", name.lower()))
    copytree(PACKAGES / "thermostat", tmp_path / "other")
    xml = (tmp_path / "other" / "package.xml").read_text(encoding="utf-8")
    (tmp_path / "lamp" / "package.xml").write_text(xml.replace("thermostat", "lamp"))
    log: Log = []
    for number, time in enumerate((101.0, 110.0, 119.0)):
        delay = 0.01 if number else late
        log.append({"topic": "/press", "stamp": time, "node": "/button", "data": {"data": 1}})
        lit = {"data": number + 1}
        log.append({"topic": "/lit", "stamp": time + delay, "node": "/lamp", "data": lit})
    path = write(log, tmp_path / "run.jsonl")
    found, _ = compared(str(tmp_path / "lamp"), [str(path)], bounds)
    assert found.verdict == verdict, found


@pytest.mark.parametrize("node", ["/driver", "/odometer"])
def test_a_node_that_ends_within_a_body_is_silent(node: str, tmp_path: Path) -> None:
    """Its last message may be recorded before another one of the same body, which is lost."""
    log = read(BUMPERBOT)
    topic = {"/driver": "/mode", "/odometer": "/backwards"}[node]
    own = [n for n, m in enumerate(log) if m["topic"] == topic]
    for at in own[10:40:7]:
        path = write(silent(log, at), tmp_path / "run.jsonl")
        found, _ = compared(str(PACKAGES / "bumperbot"), [str(path)], FROM_START)
        assert found.deviation is not None
        assert (found.deviation.kind, found.deviation.rebec) == ("silent", node[1:]), found
        told = log[0]["stamp"] + found.deviation.time * 0.001
        assert abs(told - log[at]["stamp"]) < 0.7, found.deviation


@pytest.mark.parametrize("number", [2, 4, 6])
@pytest.mark.parametrize("is_taken_out", [True, False])
def test_an_input_that_was_lost_is_told(is_taken_out: bool, number: int, tmp_path: Path) -> None:
    log = read(BUMPERBOT)
    inputs = [n for n, m in enumerate(log) if m["topic"] == "/bumper"]
    hits = [n for n in inputs if log[n]["data"]["data"] and is_answered(log, n) is is_taken_out]
    misses = [n for n in inputs if not log[n]["data"]["data"]]
    at = hits[number] if is_taken_out else misses[number]
    # The recorder has not got it; or it has one that the node has not got.
    changed = [] if is_taken_out else [log[at] | {"data": {"data": True}}]
    path = write([*log[:at], *changed, *log[at + 1 :]], tmp_path / "run.jsonl")
    found, _ = compared(str(PACKAGES / "bumperbot"), [str(path)], FROM_START)
    if found.deviation is None:  # one more changes nothing while it goes back
        assert not is_taken_out
        assert found.verdict == "conforms"
        return
    assert (found.deviation.kind, found.deviation.rebec) == ("lost message", "driver")
    assert "onBumper" in found.deviation.message
    told = log[0]["stamp"] + found.deviation.time * 0.001
    assert abs(told - log[at]["stamp"]) < 0.1, found.deviation


def test_the_run_that_is_shown_ends_where_it_deviates(tmp_path: Path) -> None:
    log = read(BUMPERBOT)
    own = [n for n, m in enumerate(log) if m["topic"] == "/mode"]
    path = write(dropped(log, own[20]), tmp_path / "run.jsonl")
    measuring = TopicBounds(None, True, None, True)
    found, _ = compared(str(PACKAGES / "bumperbot"), [str(path)], measuring)
    assert found.deviation is not None
    times = [step.time for step in found.run]
    assert {step.rebec for step in found.run} >= {"driver", "odometer"}
    assert found.deviation.time - 1000 < times[-1] <= found.deviation.time


def test_the_unit_of_bounds_is_told_where_it_is_no_second(tmp_path: Path) -> None:
    properties = tmp_path / "soon.property"
    formula = "AG(driver.out_mode_data == 1 -> AF(time <= 3, driver.out_mode_data == 2))"
    properties.write_text(f"property {{ TCTL {{ Soon: {formula}; }} }}")
    found, _ = compared(str(PACKAGES / "bumperbot"), [str(BUMPERBOT)], FROM_START, str(properties))
    assert [(p.name, p.verdict) for p in found.properties] == [("Soon", "open")]
    assert "a bound of time in the properties counts in units of 0.5 s" in found.notes


def is_answered(log: Log, at: int) -> bool:
    """Whether the node changes its mode by an input."""
    later = [m for m in log if 0 <= m["stamp"] - log[at]["stamp"] < 0.05]
    return any(m["topic"] == "/mode" and m["data"]["data"] == 1 for m in later)


def lamp(*messages: tuple[float, str, bool | int]) -> Log:
    """A run of a lamp and its switch, which keeps what it told last (rclpy)."""
    nodes = {"/press": "/thumb", "/on": "/switch", "/light": "/lamp"}
    return [{"topic": t, "stamp": s, "node": nodes[t], "data": {"data": v}} for s, t, v in messages]


LATER = (
    *((112.0, "/press", True), (112.01, "/on", False), (112.02, "/light", 0)),
    *((115.0, "/press", True), (115.01, "/on", True), (115.02, "/light", 100)),
)
BEFORE_IT = ((100.0, "/on", False), (103.0, "/press", True), (103.01, "/on", True))


@pytest.mark.parametrize(
    ("messages", "kind"),
    [
        ((*BEFORE_IT, (109.0, "/light", 100), *LATER), None),  # begun at 109 s
        ((*BEFORE_IT, *LATER), None),  # and nobody has listened to it yet
        ((*BEFORE_IT, (109.0, "/light", 60), *LATER), "wrong value"),
        ((*BEFORE_IT, (109.0, "/light", 100), *LATER[:2], *LATER[3:]), "lost message"),
    ],
)
def test_a_node_gets_what_was_published_before_it_began(
    messages: tuple[tuple[float, str, bool | int], ...], kind: str | None, tmp_path: Path
) -> None:
    path = write(lamp(*messages), tmp_path / "run.jsonl")
    found, _ = compared(str(PACKAGES / "lamp"), [str(path)], FROM_START)
    assert (found.deviation.kind if found.deviation else None) == kind, found
    assert found.verdict == ("deviates" if kind else "conforms"), found


# --- what is not known


def test_choices_that_lead_equally_far_are_told(tmp_path: Path) -> None:
    hasty = TopicBounds(3, False, 0.02)  # by less than this run is late
    assert of("doors", recorded("doors", 0, 40), tmp_path, hasty).verdict == "undetermined"


def test_a_refusal_is_open_where_the_states_before_are_not_known(tmp_path: Path) -> None:
    log = recorded("counter", 5)
    own = [n for n, message in enumerate(log) if message["topic"] == "/count"]
    faulty = wrong_value(log, own[20])
    assert of("counter", faulty, tmp_path, FROM_START).verdict == "deviates"
    found = of("counter", faulty, tmp_path, ANYWHERE)
    assert found.verdict == "undetermined"
    assert "--from-start" in found.reason


def test_topics_that_were_not_recorded_leave_it_open(tmp_path: Path) -> None:
    log = real()

    def without(topic: str) -> Conformance:
        path = write([m for m in log if m["topic"] != topic], tmp_path / "run.jsonl")
        return compared(str(PACKAGES / "thermostat"), [str(path)], FROM_START)[0]

    assert "may have served measured" in without("/temperature").reason
    assert "what other nodes send to its heat was not recorded" in without("/heat").reason
    found = without("/power")
    assert found.verdict == "conforms"
    assert "heater publishes nothing that was recorded" in found.notes


@pytest.mark.parametrize(
    ("parts", "verdict"),
    [
        (lambda log: (log, log), "conforms"),
        (lambda log: (log[:50], log[50:]), "conforms"),
        (lambda log: (log[:50], log[20:]), "conforms"),
        (
            lambda log: tuple(
                [m for m in log if (m["topic"] == t)] for t in ("/heat", "/power", "/temperature")
            ),
            "conforms",
        ),
        # Of each message both tell, one of them later: it is not known which are the same.
        (lambda log: (log, [m | {"stamp": m["stamp"] + 0.004} for m in log]), "undetermined"),
        (lambda log: (log, wrong_value(log, 61)), "undetermined"),
        (lambda log: (log[:50], wrong_value(log, 61)[50:]), "deviates"),
    ],
)
def test_several_files_of_one_run(
    parts: Callable[[Log], tuple[Log, ...]], verdict: str, tmp_path: Path
) -> None:
    paths = [write(part, tmp_path / f"{n}.jsonl") for n, part in enumerate(parts(real()))]
    found, _ = compared(str(PACKAGES / "thermostat"), list(map(str, paths)), FROM_START)
    assert found.verdict == verdict, found.reason


def test_times_by_another_clock_leave_it_open(tmp_path: Path) -> None:
    slow = [m | {"stamp": 2 * m["stamp"]} for m in real()]
    path = write(slow, tmp_path / "run.jsonl")
    assert compared(str(PACKAGES / "thermostat"), [str(path)], FROM_START)[0].verdict == "deviates"
    clock = {"topic": "/clock", "stamp": slow[0]["stamp"], "data": {"clock": 0.0}}
    path = write([clock, *slow], tmp_path / "run.jsonl")
    found, _ = compared(str(PACKAGES / "thermostat"), [str(path)], FROM_START)
    assert found.verdict == "undetermined"
    assert "/clock" in found.reason


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("self.power = 0\n\n", "self.power = sock.recv()\n\n", "not compared"),
        ("self.power += 1", "self.power += random.randint(0, 1)", None),
        ("self.power += 1", "self.power = json.loads(x)", "heater"),
        ("self.power += 1", "self.power = helper(self.power)", "heater"),
    ],
)
def test_code_that_is_not_read_leaves_it_open(
    old: str, new: str, reason: str | None, tmp_path: Path
) -> None:
    folder = tmp_path / "thermostat"
    copytree(PACKAGES / "thermostat", folder)
    heater = folder / "src" / "heater.py"
    text = heater.read_text()
    assert old in text
    heater.write_text(
        text.replace("import rospy", "import json, random\n\nimport rospy").replace(old, new)
    )
    found, _ = compared(str(folder), [str(REAL)], FROM_START)
    if reason is None:  # the recorded run is one of those
        assert found.verdict == "conforms", found
    else:
        assert found.verdict == "undetermined", found
        assert reason in found.reason
