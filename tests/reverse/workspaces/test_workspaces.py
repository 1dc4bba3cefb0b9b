"""Packages are read with what they take of others in their workspace.

`python -m tests.reverse.workspaces` writes `expected.rebeca` anew.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from rebsync.cli import main
from tests.reverse.workspaces.cases import CASES, model_of, questions


@pytest.mark.parametrize("case", CASES, ids=lambda c: c.name)
def test_models(case: Path) -> None:
    assert model_of(case) == (case / "expected.rebeca").read_text(encoding="utf-8")


@pytest.mark.parametrize(("case", "package", "question", "verdict"), list(questions()))
def test_questions(
    case: str, package: str, question: str, verdict: str, capsys: pytest.CaptureFixture[str]
) -> None:
    root = next(c for c in CASES if c.name == case) / package
    main(["ask", str(root), question, "--format", "json"])
    found = json.loads(capsys.readouterr().out)
    assert found["verdict"] == verdict, found["reason"]


@pytest.mark.parametrize(
    "case", ["roscpp", "rclcpp", "rospy", "rclpy", "launch_ros1", "launch_ros2"]
)
def test_alone_a_package_knows_nothing_of_others(
    case: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = next(q for q in questions() if q[0] == case and q[3] == "satisfied")
    root = next(c for c in CASES if c.name == case) / asked[1]
    shutil.copytree(root, tmp_path / "alone" / asked[1])
    status = main(["ask", str(tmp_path / "alone" / asked[1]), asked[2]])
    assert status != 0, capsys.readouterr().out


_LIBRARY = "add_library(base_pkg src/base.cpp)"
_EDITS = {
    "not named in package.xml": ("robot_pkg/package.xml", "<depend>base_pkg</depend>", ""),
    "a target that is not known": (
        "base_pkg/CMakeLists.txt",
        _LIBRARY,
        f"if(WITH_OTHER)\n  add_library(base_pkg src/other.cpp)\nelse()\n  {_LIBRARY}\nendif()",
    ),
}


@pytest.mark.parametrize("edit", _EDITS)
def test_nothing_is_taken_where_the_build_may_take_another(edit: str, tmp_path: Path) -> None:
    root = next(c for c in CASES if c.name == "roscpp")
    shutil.copytree(root, tmp_path / "ws")
    path, old, new = _EDITS[edit]
    text = (tmp_path / "ws" / path).read_text(encoding="utf-8")
    assert old in text
    (tmp_path / "ws" / path).write_text(text.replace(old, new), encoding="utf-8")
    assert "class Robot" in model_of(root)
    assert "class Robot" not in model_of(tmp_path / "ws")


@pytest.mark.parametrize("named", [".", "src/robot.cpp", "../robot_pkg"])
def test_a_package_finds_others_from_where_it_is(
    named: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    root = next(c for c in CASES if c.name == "roscpp") / "robot_pkg"
    monkeypatch.chdir(root)
    assert main(["extract", named]) == 1
    assert "onLevel(data);" in capsys.readouterr().out


def test_facts_are_those_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    root = next(c for c in CASES if c.name == "roscpp")
    assert main(["extract", str(root / "robot_pkg"), "--format", "json"]) == 1
    told = json.loads(capsys.readouterr().out)
    assert [each["topic"] for each in told["publishers"]] == ["alarm"]
    assert [each["topic"] for each in told["subscriptions"]] == ["level"]


@pytest.mark.parametrize("case", ["roscpp", "rclcpp", "rospy", "rclpy"])
def test_the_graph_has_what_nodes_inherit(case: str, capsys: pytest.CaptureFixture[str]) -> None:
    root = next(c for c in CASES if c.name == case)
    main(["graph", str(root), "--format", "json"])
    told = json.loads(capsys.readouterr().out)
    package = next(q[1] for q in questions() if q[0] == case)
    own = [b["id"] for b in told["boxes"] if b["package"] == package]
    assert len(own) == 1  # none is for code of others that it does not use
    names = {b["id"]: b["name"] for b in told["boxes"]}
    ends = {
        w[end] for w in told["wires"] for end in ("from", "to") if set(own) & {w["from"], w["to"]}
    }
    assert {names[end] for end in ends - set(own)} == {"/alarm", "/level"}
