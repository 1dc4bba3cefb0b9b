"""Packages that people could have written: their closed models, and questions about them.

`python -m tests.reverse.environment` writes `expected.rebeca` and `assumptions.txt` anew.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rebsync.cli import main
from tests.reverse.environment.cases import CASES, closed_model, questions

# Cases whose models do more than the code, where a run to a violation passes.
_LOOSE = (
    "none_arguments_rclpy",
    "none_rospy",
    "unset_locals",
    "wide_literals_rclcpp",
    "wide_literals_roscpp",
    "texts_between",
    "texts_changed_rclpy",
    "texts_changed_roscpp",
)
_STATUS = {"satisfied": 0, "violated": 3, "undetermined": 4}


@pytest.mark.parametrize("case", CASES, ids=lambda c: c.name)
def test_the_model_is_closed(case: Path) -> None:
    model, told = closed_model(case)
    assert model == (case / "expected.rebeca").read_text(encoding="utf-8")
    assert told == (case / "assumptions.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize(("case", "question", "verdict"), questions())
def test_questions_are_answered(
    case: str, question: str, verdict: str, capsys: pytest.CaptureFixture[str]
) -> None:
    package = next(c for c in CASES if c.name == case) / "package"
    status = main(["ask", str(package), question, "--format", "json"])
    out, err = capsys.readouterr()
    found = json.loads(out)
    assert found["verdict"] == verdict, (found["reason"], err)
    assert status == _STATUS[verdict]
    assert (found["reason"] is not None) == (verdict == "undetermined")
    does_more = any("which the model does more" in c for c in found["caveats"])
    assert does_more == (case in _LOOSE and verdict == "violated")


def test_the_four_client_libraries_say_the_same() -> None:
    asked: dict[str, list[tuple[str, str]]] = {}
    for case, question, verdict in questions():
        asked.setdefault(case, []).append((question, verdict))
    guards = [asked[c.name] for c in CASES if c.name.startswith("guard_")]
    assert len(guards) == 4
    assert all(guard == guards[0] for guard in guards)


def test_texts_are_shown_as_such(capsys: pytest.CaptureFixture[str]) -> None:
    package = next(c for c in CASES if c.name == "texts_rclpy") / "package"
    assert main(["ask", str(package), 'never status.data == "done"']) == 3
    out = capsys.readouterr().out
    assert 'sends words.on_command("start")' in out
    assert 'out_status_data: "running" -> "done"' in out
    assert "state: State.RUNNING -> State.DONE" in out
    assert 'one of "", "start", "go", "finish", "reset" or any other text' in out


@pytest.mark.parametrize(
    "question",
    ["never status.data == command.data", "never status.data == 1", 'never level.data == "x"'],
)
def test_texts_are_compared_with_texts_in_quotes(
    question: str, capsys: pytest.CaptureFixture[str]
) -> None:
    package = next(c for c in CASES if c.name == "texts_rclpy") / "package"
    assert main(["ask", str(package), question]) == 2
    assert "RS912" in capsys.readouterr().err


def test_steps_name_the_code(capsys: pytest.CaptureFixture[str]) -> None:
    package = next(c for c in CASES if c.name == "guard_roscpp") / "package"
    assert main(["ask", str(package), "never stopped.data", "--format", "json"]) == 3
    (violation,) = json.loads(capsys.readouterr().out)["violations"]
    places = [step["code"] for step in violation["trace"] if step["rebec"] == "guard"]
    assert str(places[-1]).endswith("src/guard.cpp:16")
