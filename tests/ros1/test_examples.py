"""The examples on a real roscore: what their nodes do is what their models mean."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import pytest

from rebsync.config import Config, parse_config
from rebsync.source import Source
from tests.forward.compiling import generated, written
from tests.ros1.conftest import Build
from tests.ros1.fidelity import FIDELITY, compared, fidelity, log_of, note, run_name
from tests.ros1.paths import Way, nearest, write_paths
from tests.ros1.recording import WARNING, Recording, Served
from tests.ros1.run import Clock, run
from tests.ros1.workspace import Workspace

EXPECTED = Path(__file__).parent / "expected"
EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = tuple(sorted(path.stem for path in EXPECTED.glob("*.json")))

IN_PYTHON = frozenset({"experiment1", "experiment2", "experiment3", "warehouse"})

# Units a second of a clock that does not wait for the nodes: of ROS 2.
SLOW = 4.0
QUIET = 15.0
SOON = 0.1
STEP = 0.01
IN_CELL = 0.05  # of a holonomic robot; a differential one adds up the error of each turn


@dataclass(frozen=True, slots=True)
class Example:
    """An example's run and what is expected of it.

    `expected` has the model time `until` which it ran, at `rate` units a second where the clock
    does not wait for the nodes; `cells`, for each robot the expressions over its state that give
    its cell; the properties that the run has `violated`; `served` and `final`, or for models
    that draw at random the servers that each rebec serves `first`, the `invariants` of all states,
    what has to be `reached` in some state, and what is `met` with the data that the stand-ins of
    sensors play where the clock does wait. Robots end up in their cells to `in_cell` cells,
    keep apart by `keeps_apart`, or come within `comes_within`.
    """

    name: str
    expected: Mapping[str, Any]
    recording: Recording

    def cell(self, served: Served) -> tuple[float, float]:
        """The cell of a robot after a body."""
        state = {"__builtins__": {}, **served.state}
        x, y = (eval(e, dict(state)) for e in self.expected["cells"][served.rebec])
        return float(x), float(y)

    def way(self, robot: str) -> Way:
        """The way of a robot, by the velocities that it was told."""
        constructed = next(s for s in self.recording.served if s.rebec == robot)
        x, y = self.cell(constructed)
        path = self.recording.path(robot)
        times = (0.0, *(stamp for stamp, _ in path))
        places = ((x, y), *((x + pose.x, y + pose.y) for _, pose in path))
        return Way(robot, times, places)

    def ways(self) -> tuple[Way, ...]:
        """The ways of all robots."""
        return tuple(self.way(robot) for robot in self.expected["cells"])

    def states(self) -> Iterator[Mapping[str, Any]]:
        """The states of all rebecs, after each body from when all are constructed."""
        now: dict[str, Any] = {"__builtins__": {}, "len": len, "sum": sum}
        rebecs = {s.rebec for s in self.recording.served}
        for served in self.recording.served:
            now = {**now, served.rebec: SimpleNamespace(**served.state)}
            if rebecs <= set(now):
                yield now


@pytest.fixture(scope="module")
def workspace(
    dialect: str, build_workspace: Build, tmp_path_factory: pytest.TempPathFactory
) -> Workspace:
    if dialect == "ros1-cpp":
        return build_workspace("examples", [EXAMPLES / name / name for name in NAMES])
    folder = tmp_path_factory.mktemp("packages")
    packages = [example_package(EXAMPLES / name, dialect, folder) for name in NAMES]
    return build_workspace(f"examples_{dialect}", packages)


def example_package(example: Path, dialect: str, folder: Path) -> Path:
    """The package of an example in a dialect."""
    settings = example / "rebsync.toml"
    found = parse_config(Source(settings.name, settings.read_text())) if settings.exists() else None
    config = replace(found or Config(), target=dialect)
    text = (example / f"{example.name}.rebeca").read_text(encoding="utf-8")
    return written(generated(text, example.name, config), folder, example.name, config)


def is_tried(parameters: Mapping[str, object]) -> bool:
    """Whether an example is run in a dialect: of most one is enough."""
    name = parameters.get("example")
    return parameters.get("dialect") != "ros1-py" or name is None or name in IN_PYTHON


@pytest.fixture(scope="module", params=NAMES)
def example(
    request: pytest.FixtureRequest,
    dialect: str,
    workspace: Workspace,
    tmp_path_factory: pytest.TempPathFactory,
) -> Example:
    name = str(request.param)
    expected = json.loads((EXPECTED / f"{name}.json").read_text())
    launch = workspace.root / "src" / name / "launch" / f"{name}.launch"
    clock = Clock(until=expected["until"] + 0.5, quiet=QUIET)
    recording = run(workspace, launch, tmp_path_factory.mktemp(name), clock)
    note(recording.run_log, name, dialect)
    expected["reached"] = [*expected.get("reached", ()), *expected.get("met", ())]
    return Example(name, expected, recording)


# --- order and time ----------------------------------------------------------------------------


def test_each_rebec_serves_what_the_model_says(example: Example) -> None:
    for rebec, expected in example.expected.get("served", {}).items():
        bodies = example.recording.bodies(rebec)
        assert [[b.server, b.arguments, b.start] for b in bodies] == expected


def test_nothing_is_lost_at_the_start(example: Example) -> None:
    for rebec, expected in example.expected.get("first", {}).items():
        bodies = example.recording.bodies(rebec)[: len(expected)]
        assert sorted(b.server for b in bodies) == sorted(expected)
        assert all(b.arrival <= 1 for b in bodies)


def test_the_run_is_one_of_the_model(
    example: Example, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    model = EXAMPLES / example.name / f"{example.name}.rebeca"
    found = compared(model, log_of(example.recording, tmp_path))
    request.node.user_properties.append(
        (FIDELITY, fidelity(run_name(request, example.name), found))
    )
    assert found.verdict == "conforms", found.deviation or found.reason
    assert found.compared == len(example.recording.served)
    violated = [p.name for p in found.properties if p.verdict not in ("satisfied", "open")]
    assert violated == example.expected.get("violated", [])
    assert found.lateness.greatest is not None
    assert found.lateness.greatest[2] >= -SOON / 2  # nothing is done before its time


# --- states ------------------------------------------------------------------------------------


def test_the_run_ends_in_the_state_of_the_model(example: Example) -> None:
    for rebec, expected in example.expected.get("final", {}).items():
        assert example.recording.final(rebec) == expected


def test_invariants_hold_in_every_state(example: Example) -> None:
    for state in example.states():
        for invariant in example.expected.get("invariants", ()):
            assert eval(invariant, dict(state)), f"{invariant} in {state}"


def test_the_run_gets_somewhere(example: Example) -> None:
    states = [dict(state) for state in example.states()]
    for goal in example.expected.get("reached", ()):
        assert any(eval(goal, state) for state in states), goal


def test_nothing_is_reported(example: Example) -> None:
    reported = example.recording.reports()
    assert [r for r in reported if r.kind != "late"] == []
    others = [line for line in example.recording.log if line.level >= WARNING]
    unknown = [line.text for line in others if not line.text.startswith(("late:", "sensor:"))]
    assert unknown == []


# --- ways --------------------------------------------------------------------------------------


def test_velocities_take_every_robot_to_its_cells(example: Example) -> None:
    within = example.expected.get("in_cell", IN_CELL)
    for robot in example.expected["cells"]:
        way = example.way(robot)
        for body in example.recording.bodies(robot):
            off = _off(way, example.cell(body), body.now)
            assert off <= within, f"{robot} after {body.server}@{body.now}: {off} cells off"


def _off(way: Way, cell: tuple[float, float], end: int) -> float:
    """How far from a cell a robot is when a body ends, before the next move takes it away."""
    moments = (end + tick * STEP for tick in range(round(SOON / STEP) + 1))
    return min(math.dist(way.at(moment), cell) for moment in moments)


def test_paths_are_drawn(example: Example, tmp_path: Path) -> None:
    picture = write_paths(example.name, example.ways(), tmp_path).read_text()
    drawn = {text.text for text in ElementTree.fromstring(picture).iter() if text.text}
    assert drawn >= set(example.expected["cells"])


def test_robots_keep_apart(example: Example) -> None:
    apart = example.expected.get("keeps_apart")
    if apart is not None:
        meeting = nearest(example.ways())
        assert meeting.distance > apart, meeting


def test_the_unsafe_robots_collide(example: Example) -> None:
    within = example.expected.get("comes_within")
    if within is not None:
        meeting = nearest(example.ways())
        assert meeting.distance < within, meeting
