"""`rebsync accept`: what nobody can tell is looked at once, and comes back when it changes."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest
from jsonschema import validate  # type: ignore[import-untyped]

from rebsync.cli import main
from tests.cli.run import ROOT
from tests.cli.test_check import MODEL

SCHEMA = json.loads((ROOT / "docs/check.schema.json").read_text(encoding="utf-8"))
CPP, PYTHON = "patrol/src/robot.cpp", "patrol/src/patrol/robot.py"
UNKNOWN = {
    "ros1-cpp": (CPP, "  on_ = n > 3;", "  on_ = vendor::decide(n);"),
    "ros1-py": (PYTHON, "self._on = n > 3", "self._on = n > 3; self.vendor.decide(n)"),
}
REASON = 'says the same, "n > 3", by the board\'s own table'


@pytest.fixture(params=UNKNOWN)
def edited(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> tuple[Path, str]:
    """The source of a package in which one statement cannot be read, and what it says there."""
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    Path("patrol.rebeca").write_text(MODEL, encoding="utf-8")
    assert main(["generate", "patrol.rebeca", "--target", request.param]) in (0, 1)
    name, old, new = UNKNOWN[request.param]
    replaced(Path(name), old, new)
    return Path(name), new.split("; ")[-1].strip()


def replaced(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text, old
    path.write_text(text.replace(old, new), encoding="utf-8")


def line_of(path: Path, text: str) -> str:
    lines = path.read_text(encoding="utf-8").splitlines()
    return f"{path}:{next(i for i, line in enumerate(lines, 1) if text in line)}"


def accepted(path: Path, text: str) -> None:
    assert main(["check"]) == 4
    assert main(["accept", line_of(path, text), "--reason", REASON]) == 0


def test_what_was_accepted_is_in_step_and_said(
    edited: tuple[Path, str], capsys: pytest.CaptureFixture[str]
) -> None:
    accepted(*edited)
    capsys.readouterr()
    assert main(["check"]) == 0
    assert capsys.readouterr().out == "patrol: in step, with 1 accepted\n"
    assert main(["check", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    validate(found, SCHEMA)
    (package,) = found["packages"]
    (entry,) = package["accepted"]
    assert (package["verdict"], entry["reason"]) == ("in step", REASON)
    assert main(["check", "--format", "junit"]) == 0
    said = ElementTree.fromstring(capsys.readouterr().out).findtext(".//system-out")
    assert said is not None and REASON in said
    assert main(["accept", "--list"]) == 0
    assert REASON in capsys.readouterr().out


def test_it_comes_back_when_its_place_changes(
    edited: tuple[Path, str], capsys: pytest.CaptureFixture[str]
) -> None:
    path, text = edited
    accepted(path, text)
    replaced(path, "decide(n)", "decide(n + 1)")
    capsys.readouterr()
    assert main(["check"]) == 4
    assert "RS945" in capsys.readouterr().out
    replaced(path, "decide(n + 1)", "decide(n)")
    assert main(["check"]) == 0


def test_lines_above_do_not_matter(edited: tuple[Path, str]) -> None:
    path, text = edited
    accepted(path, text)
    path.write_text("\n\n" + path.read_text(encoding="utf-8"), encoding="utf-8")
    assert main(["check"]) == 0


def test_another_edit_of_the_same_body_is_not_hidden(edited: tuple[Path, str]) -> None:
    path, text = edited
    accepted(path, text)
    delay = next(
        line for line in path.read_text(encoding="utf-8").splitlines() if "delay(1)" in line
    )
    replaced(path, f"{delay}\n", "")
    assert main(["check"]) == 4


def test_a_change_of_the_model_there_is_not_hidden(edited: tuple[Path, str]) -> None:
    accepted(*edited)
    replaced(Path("patrol.rebeca"), "on = n > 3;", "on = n > 2;")
    assert main(["check"]) == 4


def test_the_same_twice_is_accepted_once(edited: tuple[Path, str]) -> None:
    path, text = edited
    accepted(path, text)
    line = next(x for x in path.read_text(encoding="utf-8").splitlines() if text in x)
    replaced(path, line, f"{line}\n{line}")
    assert main(["check"]) == 4


def test_a_difference_is_not_accepted(
    edited: tuple[Path, str], capsys: pytest.CaptureFixture[str]
) -> None:
    path, text = edited
    replaced(path, text, "on_ = n > 4;" if path.suffix == ".cpp" else "self._on = n > 4")
    assert main(["check"]) == 1
    assert main(["accept", line_of(path, "n > 4"), "--reason", REASON]) == 2
    assert "RS946" in capsys.readouterr().err
    assert not Path("patrol/.rebsync/accepted.toml").exists()


def test_a_reason_is_wanted(edited: tuple[Path, str]) -> None:
    assert main(["accept", line_of(*edited)]) == 2
    assert main(["accept", line_of(*edited), "--reason", " "]) == 2


def test_an_entry_that_is_deleted_is_not_accepted(edited: tuple[Path, str]) -> None:
    accepted(*edited)
    Path("patrol/.rebsync/accepted.toml").write_text("", encoding="utf-8")
    assert main(["check"]) == 4


def test_a_damaged_file_is_told(
    edited: tuple[Path, str], capsys: pytest.CaptureFixture[str]
) -> None:
    accepted(*edited)
    Path("patrol/.rebsync/accepted.toml").write_text("[[accepted]]\npath = 3\n", encoding="utf-8")
    capsys.readouterr()
    assert main(["check"]) == 2
    assert "RS809" in capsys.readouterr().out


def test_properties_are_not_accepted(edited: tuple[Path, str]) -> None:
    accepted(*edited)
    broken = "property { define { d = robot1.x < 1; } Assertion { Never: d; } }\n"
    Path("patrol.property").write_text(broken, encoding="utf-8")
    assert main(["check", "--verify"]) in (3, 4)


def test_other_commands_leave_the_file(edited: tuple[Path, str]) -> None:
    accepted(*edited)
    file = Path("patrol/.rebsync/accepted.toml")
    text = file.read_text(encoding="utf-8")
    main(["generate", "patrol.rebeca"])
    main(["sync"])
    assert file.read_text(encoding="utf-8") == text
