"""The robots of a run are where the state of the model says: in runs by chance of the examples."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync.checker.movement import movement_of
from rebsync.checker.movement.of_trace import cell_in
from rebsync.checker.movement.ways import Movement, Pose
from rebsync.checker.steps import Semantics
from rebsync.checker.trace import Trace
from rebsync.config import Config, Drive, settings_beside
from rebsync.grammars.cells import parse_cells
from rebsync.static import Analysis
from tests.checker.movement.moving import EXAMPLES, analysed, example_run, moved, run_of

EXPECTED = Path(__file__).parents[2] / "ros1" / "expected"
MOVING = ("experiment1", "experiment2", "experiment3", "running_example", "warehouse", "hello")

JUMPS = """
@Robot reactiveclass R(2) {
  statevars { int x; int y; int n; }
  R(int a, int b) { x = a; y = b; n = 2; self.go(); }
  msgsrv go() {
    @Move(X + n, Y);
    @Move(X, Y - 1);
    delay(4);
    x += n;
    y--;
    far();
    self.go() after(1);
  }
  void far() { @Move(X - 1, Y + (n + 1)); delay(3); x = x - 1; y = (n + 1) + y; }
}
main { R one():(0, 0); R other():(5, 5); }
"""


def off(analysis: Analysis, trace: Trace, movement: Movement, name: str) -> float:
    """How far robots are from the cells of the model's state when they are idle, at most."""
    settings_source, config = settings_beside(str(EXAMPLES / name / f"{name}.rebeca"))
    cells = parse_cells(settings_source, config, analysis)
    worst = 0.0
    for way in movement.ways:
        gives = cell_in(analysis, way.robot, cells)
        for step in trace.steps[1:]:
            rebec = next(r for r in step.rebecs if r.name == way.robot)
            idle = rebec.busy_until is None or rebec.busy_until == step.until
            if not idle or rebec.suspended_at is not None or step.failure is not None:
                continue
            cell, pose = gives.at(dict(rebec.variables), analysis.env), way.at(step.until)
            # An axis that no variable gives is one along which the class never moves.
            worst = max(worst, math.dist((cell.x, cell.y), (pose.x, pose.y)))
    return worst


@pytest.mark.parametrize("name", MOVING)
@given(
    seed=st.integers(0, 10**6),
    drive=st.sampled_from(["holonomic", "differential"]),
    semantics=st.sampled_from(["tts", "ftts"]),
)
@settings(max_examples=8, deadline=None)
def test_robots_are_in_the_cells_of_the_state(
    name: str, seed: int, drive: Drive, semantics: Semantics
) -> None:
    analysis, trace, movement = example_run(name, seed, 150, semantics, drive)
    assert movement.ways
    assert off(analysis, trace, movement, name) < 1e-9


@pytest.mark.parametrize("path", sorted(EXPECTED.glob("*.json")), ids=lambda path: path.stem)
def test_the_cells_are_those_that_runs_on_a_roscore_are_judged_by(path: Path) -> None:
    """What the tests with ROS say of the cells of each example, and what is inferred or set."""
    told = json.loads(path.read_text(encoding="utf-8"))["cells"]
    _, trace, movement = example_run(path.stem, 1, 80)
    assert {way.robot for way in movement.ways} == set(told)
    for way in movement.ways:
        state = next(r.variables for r in trace.steps[0].rebecs if r.name == way.robot)
        names: dict[str, object] = {"__builtins__": {}, "pos": [0, 0]}
        for name, value in state:
            target, _, index = name.partition("[")
            if index:
                pos = names["pos"]
                assert target == "pos" and isinstance(pos, list)
                pos[int(index[:-1])] = int(value)
            else:
                names[name] = value == "true" if value in ("true", "false") else int(value)
        x, y = (eval(text, dict(names)) for text in told[way.robot])
        assert (way.start.x, way.start.y) == (x, y)


def test_the_safe_robots_keep_apart_and_the_others_collide() -> None:
    _, _, safe = example_run("experiment2", 0, 120)
    assert safe.encounters == () and safe.nearest is not None and safe.nearest.distance > 0.5
    _, _, unsafe = example_run("experiment2_unsafe", 0, 120)
    (meeting,) = unsafe.encounters
    assert meeting.robots == ("robot1", "robot2")
    assert (meeting.start, meeting.time, meeting.end) == pytest.approx((4.5, 5, 5.5))
    assert meeting.distance == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("semantics", ["tts", "ftts"])
def test_moves_with_amounts_of_the_state_in_methods_and_in_one_delay(semantics: Semantics) -> None:
    problem = analysed(JUMPS)
    movement = moved(problem, run_of(problem, 1, 20, semantics))
    one = movement.ways[0]
    assert [(p.time, p.x, p.y) for p in one.poses[:6]] == [
        (0, 0, 0), (2, 2, 0), (4, 2, -1), (7, 1, 2), (8, 1, 2), (10, 3, 2),
    ]  # fmt: skip
    other = movement.ways[1]
    assert (other.start.x, other.start.y, other.start.told_by) == (5, 5, ("x", "y"))
    assert other.at(7) == Pose(7, 6, 7, 0)


def test_a_run_that_ends_in_mid_move_is_driven_to_its_end() -> None:
    problem = analysed(JUMPS)
    movement = moved(problem, run_of(problem, 1, 2))
    assert (movement.until, movement.end) == (0, 4)


@pytest.mark.parametrize("amount", ["f(1)", "n++", "4 / n", "?(1, 2)"])
def test_offsets_with_an_effect_are_not_computed(amount: str) -> None:
    text = JUMPS.replace("X, Y - 1", f"X, Y - {amount}")
    problem = analysed(text.replace("void far", "int f(int k) { return k; } void far"))
    trace = run_of(problem, 1, 20)
    way = moved(problem, trace).ways[0]
    assert way.lost == 0
    assert way.poses == (Pose(0, 0, 0, 0),)


def test_an_overflow_ends_the_body_before_its_later_moves() -> None:
    text = """
    @Robot reactiveclass R(1) {
      knownrebecs { R other; }
      statevars { int x; }
      R() { x = 0; self.go(); }
      msgsrv go() { @Move(X + 1, Y); other.go(); @Move(X + 5, Y); delay(2); }
    }
    main { R a(b):(); R b(a):(); }
    """
    problem = analysed(text)
    trace = run_of(problem, 0, 20)
    assert trace.steps[-1].failure is not None
    assert all(len(way.poses) == 1 for way in moved(problem, trace).ways)


def test_without_moves_without_time_and_of_another_model_there_is_no_movement() -> None:
    problem = analysed(JUMPS)
    trace = run_of(problem, 1, 20)
    still = analysed("@Robot reactiveclass R(2) { R() { self.go(); } msgsrv go() { } } "
                     "main { R r():(); }")  # fmt: skip
    assert movement_of(run_of(still), still.analysis, Config(), {}) is None
    core = analysed(
        JUMPS.replace(" after(1)", "").replace("delay(4);", "").replace("delay(3);", "")
    )
    assert movement_of(run_of(core, 0, 10, "core"), core.analysis, Config(), {}) is None
    other = analysed(
        JUMPS.replace("self.go() after(1)", "self.go() after(2)").replace("(5, 5)", "(1, 1)")
    )
    shorter = analysed(JUMPS.replace("R other():(5, 5);", ""))
    assert movement_of(trace, other.analysis, Config(), {}) is not None  # the same actions
    assert movement_of(trace, shorter.analysis, Config(), {}) is None
