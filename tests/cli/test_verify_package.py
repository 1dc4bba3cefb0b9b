"""`rebsync verify PACKAGE` and `rebsync ask`, as users call them: what is told and refused."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from rebsync.cli import main

GUARD = Path(__file__).parents[1] / "reverse/environment/cases/guard_rospy/package"
PROPERTY = """property {
  define { moves = guard.out_cmd_vel && guard.out_cmd_vel_linear_x > 0.0d; }
  Assertion { Slow: guard.out_cmd_vel_linear_x < 0.6d; Still: !moves; }
}
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    return Path(shutil.copytree(GUARD, tmp_path / "guard"))


def test_the_property_in_the_folder_is_taken(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / "guard.property").write_text(PROPERTY, encoding="utf-8")
    assert main(["verify", str(package), "--format", "json"]) == 3
    found = json.loads(capsys.readouterr().out)
    assert found["properties"] == {"Slow": "satisfied", "Still": "violated"}
    assert any(c.startswith("assumed: /bumper comes at most once") for c in found["caveats"])
    assert any(str(s["code"]).endswith("guard.py:25") for s in found["violations"][0]["trace"])


def test_of_several_properties_one_must_be_named(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("a.property", "b.property"):
        (package / name).write_text(PROPERTY, encoding="utf-8")
    assert main(["verify", str(package)]) == 2
    assert "RS802" in (said := capsys.readouterr().err) and "--property" in said
    assert main(["verify", str(package), "--property", str(package / "b.property")]) == 3


def test_the_closed_model_can_be_written_and_verified_by_itself(
    package: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    closed = tmp_path / "closed.rebeca"
    assert main(["verify", str(package), "--model", str(closed)]) == 0
    capsys.readouterr()
    assert main(["verify", str(closed)]) == 0
    assert "reactiveclass Environment" in closed.read_text(encoding="utf-8")


def test_without_environment_nothing_comes(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    question = "never bumper.data"
    assert main(["ask", str(package), question]) == 3
    assert main(["ask", str(package), question, "--environment", "none"]) == 0
    assert "assumed: nothing comes from outside: /bumper" in capsys.readouterr().out


def test_a_field_can_be_asked_for_that_no_callback_reads(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = package / "scripts" / "guard.py"
    text = script.read_text(encoding="utf-8").replace("message.data", "True")
    script.write_text(text, encoding="utf-8")
    assert main(["ask", str(package), "always bumper.data"]) == 3
    assert main(["ask", str(package), "never stopped.data and bumper.data"]) == 3


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (["ask", "PACKAGE", "never"], "RS912"),
        (["ask", "PACKAGE", "stopped.data at most 99 times"], "RS912"),
        (["ask", "PACKAGE", "never " + "not " * 400 + "stopped.data"], "RS912"),
        (["ask", "PACKAGE", "never cmd_vel.linear.w > 0"], "RS913"),
        (["ask", "PACKAGE", "never cmd_vel > 0"], "RS913"),
        (["ask", "PACKAGE", "never cmd_vel.linear.x > FAST"], "RS913"),
        (["ask", "EMPTY", "never cmd_vel.linear.x > 0"], "RS802"),
        (["ask", "MISSING", "never cmd_vel.linear.x > 0"], "RS801"),
        (["verify", "EMPTY"], "RS802"),
        (["verify", "PACKAGE/scripts/guard.py"], "RS802"),
    ],
)
def test_what_cannot_be_answered_is_said(
    arguments: list[str],
    code: str,
    package: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "empty").mkdir()
    named = {"PACKAGE": str(package), "EMPTY": str(tmp_path / "empty")}
    given = [arguments[0], arguments[1], *arguments[2:]]
    for word, path in named.items():
        given[1] = given[1].replace(word, path)
    assert main(given) == 2
    assert code in capsys.readouterr().err


def test_a_topic_of_several_nodes_is_named_with_one(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = package / "scripts" / "guard.py"
    other = (
        script.read_text(encoding="utf-8").replace("Guard", "Other").replace('"guard"', '"other"')
    )
    (package / "scripts" / "other.py").write_text(other, encoding="utf-8")
    assert main(["ask", str(package), "never cmd_vel.linear.x > 0"]) == 2
    assert "guard:cmd_vel.linear.x, other:cmd_vel.linear.x" in capsys.readouterr().err
    assert main(["ask", str(package), "never other:cmd_vel.linear.x > 0"]) == 3
