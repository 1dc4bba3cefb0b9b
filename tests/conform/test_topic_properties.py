"""Properties over topics of a package that people wrote (packages/thermostat), on recordings."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rebsync.cli.packages import read_observed
from rebsync.conform.bags import OwnTypes
from rebsync.conform.components.heard import HeardRecordings
from rebsync.conform.components.properties import Timespan, TopicProperties
from tests.conform.test_topics import PACKAGES

PROPERTIES = """property {
  define {
    heating = (thermostat.out_heat_data);
    strong = (heater.out_power_data > 3);
    hot = (thermostat.in_temperature_data > 22);
  }
  Assertion {
    Weak: !strong;
    Off: !(hot && heating);
    Same: heater.in_heat_data == thermostat.out_heat_data;
    Few: heater.out_count_power < 3;
    Inside: heater.power < 3;
  }
  LTL {
    Again: G(F(strong));
    Once: F(strong);
    First: heating;
    Then: G(X(heating));
  }
  TCTL {
    Soon: AG(AF(time <= 5, strong));
    Cools: AG(hot -> AF(time <= 2, !heating));
    Holds: AG(hot -> AG(time <= 2, !heating));
    Until: AU(time <= 5, !strong, strong);
    Always: AG(AU(time <= 5, true, strong));
  }
}
"""
T, H, P = "/temperature", "/heat", "/power"
SLOWLY = [(0.0, T, 23), (0.01, H, True), (0.02, P, 0), (5.0, T, 20), (5.01, H, False)]
QUICKLY = [(0.0, T, 16), (0.01, H, True), (0.02, P, 0), (1.0, T, 23), (1.01, H, False)]
CASES = [
    ("Weak", [(0.0, P, 3), (0.01, P, 4), (0.02, P, 3)], ("violated", 10)),  # one topic is exact
    ("Weak", [(0.0, P, 3), (1.0, P, 3)], ("open", None)),
    ("Off", SLOWLY, ("violated", 10)),
    ("Off", QUICKLY, ("open", None)),  # for less than messages may be late
    ("Off", SLOWLY[:1], ("undetermined", None)),  # nothing was published
    ("Same", [(0.0, H, False), (0.01, H, True), (3.0, H, False)], ("open", None)),
    ("Few", [(n, P, 0) for n in range(5)], ("undetermined", None)),
    ("Inside", [(0.0, P, 4)], ("undetermined", None)),
    ("Again", [(0.0, P, 4), (1.0, P, 0)], ("open", None)),
    ("Once", [(0.0, P, 0), (1.0, P, 4)], ("satisfied", 1000)),
    ("First", [(0.0, H, False), (9.0, H, False)], ("undetermined", None)),
    ("Then", [(0.0, H, False), (9.0, H, False)], ("undetermined", None)),
    # Bounds are in seconds, the unit that the package has; times and margins in milliseconds.
    ("Soon", [(0.0, P, 0), (90.0, P, 0)], ("violated", 5000, -85000)),  # not by the end
    ("Soon", [(0.0, P, 4), (1.0, P, 0), (5.0, P, 4), (9.0, P, 4)], ("open", None, 1000)),
    ("Soon", [(0.0, P, 4), (1.0, P, 0), (6.05, P, 4), (9.0, P, 4)], ("open", None, -50)),  # late
    ("Soon", [(0.0, P, 4), (1.0, P, 0), (6.3, P, 4), (9.0, P, 4)], ("violated", 6000, -300)),
    ("Soon", [(0.0, P, 4), (1.0, P, 0), (4.0, P, 1), (6.3, P, 4)], ("violated", 6000, -300)),
    ("Soon", [(0.0, P, 4), (9.0, P, 4)], ("open", None, 5000)),  # at once
    ("Cools", [*SLOWLY, (9.0, T, 20)], ("violated", 2100, -3000)),
    ("Cools", [*QUICKLY, (9.0, T, 20)], ("open", None, 1990)),
    ("Cools", [(0.0, T, 20), (0.01, H, True), (9.0, T, 20)], ("open", None, None)),  # never hot
    (
        "Holds",
        [(0, T, 23), (0, H, False), (1, T, 20), (4, H, True), (9, T, 20)],
        ("open", None, 1000),
    ),
    (
        "Holds",
        [(0, T, 23), (0, H, False), (1, T, 20), (2.5, H, True), (9, T, 20)],
        ("violated", 2500, -500),
    ),
    ("Until", [(0.0, P, 0), (3.0, P, 1), (4.0, P, 4), (9.0, P, 0)], ("undetermined", None)),
    ("Always", [(0.0, P, 0), (3.0, P, 4), (7.0, P, 0), (9.0, P, 0)], ("open", None, 2000)),
    ("Always", [(0.0, P, 0), (6.0, P, 4), (7.0, P, 0), (9.0, P, 0)], ("violated", 5000, -1000)),
]


@pytest.fixture(scope="module")
def properties(tmp_path_factory: pytest.TempPathFactory) -> TopicProperties:
    """All of them, read with the package."""
    path = tmp_path_factory.mktemp("properties") / "some.property"
    path.write_text(PROPERTIES)
    found = read_observed(str(PACKAGES / "thermostat"), str(path))
    assert found is not None
    return found


def said(
    properties: TopicProperties, log: list[tuple[float, str, int]], path: Path, node: str | None
) -> dict[str, tuple[str, int | None, int | None]]:
    """What is said of a log; messages on topics of nodes are from those, or from `node`."""
    names = {T: "/sensor", H: "/thermostat", P: "/heater"}
    lines = [
        {"topic": t, "stamp": 100 + s, "data": {"data": v}, "node": node or names[t]}
        for s, t, v in log
    ]
    path.write_text("".join(f"{json.dumps(line)}\n" for line in lines))
    recording = HeardRecordings.of([str(path)], OwnTypes("", {}))
    found = properties.evaluated(
        recording.events(properties.fields()), Timespan(100.0, 100.0), 0.001, 0.1
    )
    return {each.name: (each.verdict, each.time, each.margin) for each in found}


@pytest.mark.parametrize(("name", "log", "expected"), CASES)
def test_properties_are_evaluated(
    name: str,
    log: list[tuple[float, str, int]],
    expected: tuple[str, int | None] | tuple[str, int | None, int | None],
    properties: TopicProperties,
    tmp_path: Path,
) -> None:
    found = said(properties, log, tmp_path / "run.jsonl", None)[name]
    assert found[: len(expected)] == expected


def test_messages_of_strangers_are_not_counted(properties: TopicProperties, tmp_path: Path) -> None:
    log = [(0.0, P, 4), (1.0, P, 4)]
    assert said(properties, log, tmp_path / "run.jsonl", "/other")["Weak"][0] == "undetermined"
