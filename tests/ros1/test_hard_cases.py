"""Hard cases of the language as running nodes: inheritance, interfaces, rebecs as values."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.forward.compiling import CASES, case_config, case_files, written
from tests.ros1.conftest import Build
from tests.ros1.fidelity import FIDELITY, compared, fidelity, note
from tests.ros1.recording import Recording
from tests.ros1.run import Clock, run
from tests.ros1.workspace import Workspace

PlayCase = Callable[[str], Recording]
RecordProperty = Callable[[str, object], None]
VIOLATED = {"inheritance": "Station.arrived", "rebecs": "Node.visit"}  # messages to nobody

NAMES = ("inheritance", "interfaces", "overloads", "rebecs")


@pytest.fixture(scope="module")
def hard(
    dialect: str, build_workspace: Build, tmp_path_factory: pytest.TempPathFactory
) -> Workspace:
    directory = tmp_path_factory.mktemp("hard")
    cases = [CASES / f"{name}.rebeca" for name in NAMES]
    packages = [written(case_files(c, dialect), directory, c.stem, case_config(c)) for c in cases]
    return build_workspace(f"hard_{dialect}", packages)


@pytest.fixture
def play_case(
    dialect: str, hard: Workspace, tmp_path: Path, record_property: RecordProperty
) -> PlayCase:
    """Runs a case by its name."""

    def play(name: str) -> Recording:
        launch = hard.root / "src" / name / "launch" / f"{name}.launch"
        recording = run(hard, launch, tmp_path, Clock(until=12, quiet=5))
        note(recording.run_log, name, dialect)
        assert_is_run(name, dialect, recording.run_log, record_property)
        return recording

    return play


def assert_is_run(name: str, dialect: str, log: Path, record_property: RecordProperty) -> None:
    """A case has done what its model says, up to where that breaks a rule."""
    case = CASES / f"{name}.rebeca"
    found = compared(case, log, case_config(case))
    record_property(FIDELITY, fidelity(f"{name} {dialect}", found))
    if name in VIOLATED:
        assert found.deviation is not None
        assert found.verdict == "violated"
        assert VIOLATED[name] in found.deviation.message
    else:
        assert found.verdict == "conforms", found.deviation or found.reason
        assert found.compared == found.recorded


def test_inheritance(play_case: PlayCase) -> None:
    played = play_case("inheritance")
    assert played.order("car") == ["refuel(1)@0", "drive(11)@1", "refuel(4)@1", "drive(-8)@2"]
    assert played.order("truck") == ["refuel(true)@0", "refuel(10)@0", "drive(35)@1"]
    assert played.final("car")["fuel"] == 7
    assert played.final("truck")["fuel"] == -110
    wanted = {"seen": 38, "trucks": 1, "last": True, "latest": "truck"}
    assert played.final("station") == wanted
    assert played.final("idle")["trips"] == 7
    # a car is no truck: the message that the cast promises cannot be sent
    reports = [(r.kind, r.rebec) for r in played.reports() if r.kind != "late"]
    assert reports == [("null", "station")]


def test_interfaces(play_case: PlayCase) -> None:
    played = play_case("interfaces")
    # The model leaves open which of two messages of one moment goes first; so does rospy.
    assert sorted(played.order("bulb")[:2]) == ["dim(4)@0", "light(true)@0"]
    assert played.order("bulb")[2:] == ["light(false)@2"]
    assert played.final("bulb") == {"lit": False, "level": 4}
    assert played.final("late") == {"x": -1}
    assert played.final("full") == {"d": 4}
    assert played.final("strip") == {"lit": False, "level": played.final("strip")["level"], "n": 8}
    assert sorted(played.order("strip")[:6]) == ["dim(3)@0"] * 3 + ["name(8)@0"] * 3
    assert played.order("strip")[6:] == ["both()@1"] * 3 + ["light(true)@1"] * 3
    assert played.problems() == ()


def test_overloads(play_case: PlayCase) -> None:
    played = play_case("overloads")
    assert played.order("a1") == ["m(5, 6)@0"]
    assert (played.final("a1")["a"], played.final("a1")["d"]) == (4, 30)
    # f(1) and f(3) mean f(byte), f(a) the overridden f(int)
    assert played.final("b1")["a"] == 16
    assert played.order("b1")[:3] == ["m(5)@0", "m(true)@0", "m(7)@0"]
    assert played.order("b1").count("m(7)@0") == 7
    assert (played.final("b1")["c"], played.final("b1")["d"]) == (16, 4)
    assert played.problems() == ()


def test_rebecs_as_values(play_case: PlayCase) -> None:
    played = play_case("rebecs")
    for own, other, count in (("a", "b", 6007), ("b", "a", 6008)):
        final = played.final(own)
        assert (final["best"], final["two"], final["count"]) == (other, [other, other], count)
        # The last visit and `done` come at one time: each may be the last to store the grid.
        assert final["grid"] in ([own, own, "", ""], [other, other, "", ""])
        assert (final["none"], final["e"]) == ("", "x")
    kinds = sorted((r.kind, r.rebec, r.server) for r in played.reports())
    assert kinds == [("null", "a", "visit"), ("null", "b", "visit")]
