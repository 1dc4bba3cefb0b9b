"""Packages that people edit come in step with their models, and nothing else changes."""

from __future__ import annotations

import difflib
import re
from pathlib import Path
from typing import Any

import pytest

from rebsync.cli import main
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.verdict.check import check
from rebsync.roundtrip.verdict.drift import Verdict
from tests.reverse.test_edits import BY_NAME, EDITS, edited
from tests.reverse.test_laws import package_of

# Changes of models that concern nothing that the edits of code do.
CHANGES = {
    "experiment1": [("msgsrv moveBackward() {", "\n    delay(7);  // rest"), ("int e11 = ", "1")],
    "experiment2": [("msgsrv MoveInX() {", "\n    delay(7);  // rest"), ("int e2 = ", "1")],
    "warehouse": [
        ("msgsrv enter(int id, int cell) {", "\n    delay(7);  // rest"),
        ("int patience = ", "1"),
    ],
}


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty directory, which is the current one, with a cache of its own."""
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("name", EDITS)
def test_edits_of_code_come_into_the_model(name: str, here: Path) -> None:
    model, root = _made(EDITS[name]["example"], here)
    before, generated = model.read_text(), _files(root, records=False)
    _edit(EDITS[name], root)
    code = _files(root, records=False)
    assert main(["sync", "."]) == 0
    assert _is_in_step(root)
    now = _files(root, records=False)
    changed = {path for path in code if now[path] != code[path]}
    assert not changed or name == "changed_constant", "the code has it already"
    assert all(code[path] == generated[path] for path in changed), "only defaults follow"
    assert all(path.startswith("msg/") for path in now.keys() - code.keys())
    assert main(["check", "."]) == 0
    assert _gone(before, model.read_text()) <= _most(EDITS[name], before)
    after = _files(here)
    assert main(["sync", "."]) == 0
    assert _files(here) == after, "nothing is left to do"


def test_defaults_follow_a_constant_that_was_changed_in_its_file(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What nobody has edited is generated anew, so that no edit of it seems to be kept."""
    _, root = _made("experiment2", here)
    params = root / "config" / "params.yaml"
    params.write_text(params.read_text().replace("e1: 1", "e1: 3"))
    assert main(["sync", "."]) == 0
    assert 'param("e1", 3)' in (root / "src" / "r1.cpp").read_text()
    assert main(["generate", "experiment2.rebeca"]) == 0
    assert capsys.readouterr().out.endswith("32 files, 0 of them written\n")


def test_messages_do_not_follow_a_variable_that_is_not_published(here: Path) -> None:
    _, root = _made("experiment2", here)
    header, message = root / "include" / "experiment2" / "r1.h", root / "msg" / "R1State.msg"
    text = header.read_text()
    header.write_text(text.replace("  bool stopped_{};", "  int32_t laps_{};\n  bool stopped_{};"))
    before = message.read_text()
    assert main(["sync", "."]) == 0
    assert message.read_text() == before


def test_a_class_that_is_renamed_in_its_code_alone_is_refused(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its messages are called after it, so that half of a package would have the new name."""
    _, root = _made("experiment2", here)
    for path in (*root.glob("include/*/*.h"), *root.glob("src/*.cpp")):
        path.write_text(re.sub(r"\bR1\b", "Shuttle", path.read_text()))
    assert main(["check", "."]) == 1
    before = _files(here)
    assert main(["sync", "."]) == 1
    assert _files(here) == before
    said = capsys.readouterr()
    assert "nothing was written" in said.out + said.err


@pytest.mark.parametrize("name", list(EDITS)[::3])
def test_changes_of_both_sides_are_merged(name: str, here: Path) -> None:
    edit = EDITS[name]
    model, root = _made(edit["example"], here)
    _edit(edit, root)
    text = model.read_text()
    for old, new in CHANGES[edit["example"]]:
        assert old in text
        text = text.replace(old, old + new, 1)
    model.write_text(text)
    code = _files(root, records=False)
    assert main(["sync", "."]) == 0
    assert _is_in_step(root)
    assert all(old + new in model.read_text() for old, new in CHANGES[edit["example"]])
    for path, old in code.items():
        assert _gone(old, (root / path).read_text()) <= 2, path
    after = _files(here)
    assert main(["sync", "."]) == 0
    assert _files(here) == after, "nothing is left to do"


def _made(example: str, here: Path) -> tuple[Path, Path]:
    """A copy of an example: its model and its package."""
    model = here / f"{example}.rebeca"
    model.write_text((BY_NAME[example] / model.name).read_text())
    assert main(["generate", model.name]) == 0
    return model, here / example


def _edit(edit: dict[str, Any], root: Path) -> None:
    """Makes an edit by hand in a package."""
    old = package_of(BY_NAME[edit["example"]])
    for path, text in edited(edit).items():
        if old.get(path) != text:
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text)


def _files(root: Path, records: bool = True) -> dict[str, str]:
    return {
        p.relative_to(root).as_posix(): p.read_text()
        for p in sorted(root.rglob("*"))
        if p.is_file() and ".cache" not in p.parts
        if records or (".rebsync" not in p.parts and p.name != "README.md")  # it follows the model
    }


def _is_in_step(root: Path) -> bool:
    (package,) = find([str(root)])
    drift = check(package).drift
    return drift is None or drift.verdict is Verdict.IN_STEP


def _gone(old: str, new: str) -> int:
    """How many lines of a text are gone."""
    return sum(line.startswith("- ") for line in difflib.ndiff(old.split("\n"), new.split("\n")))


def _most(edit: dict[str, Any], text: str) -> int:
    """How many lines of a model an edit may change: those that it is in as it is written."""
    return sum(text.count(old) * (old.count("\n") + 1) for old, *_ in edit["model"])


def test_files_that_nobody_has_edited_are_in_no_conflict(here: Path) -> None:
    model, root = _made("experiment1", here)
    code = root / "src/r_1.cpp"
    code.write_text(code.read_text().replace("    sendSelfWaitForCharge();\n", ""))
    model.write_text(model.read_text().replace("(25, 1);", "(25, 1);\n  R_1 twin():(30, 1);"))
    assert main(["sync", "."]) == 0
    assert _is_in_step(root)
    told = (root / "README.md").read_text()
    assert "| `/twin/waitForCharge` | `R1WaitForCharge` | twin |" in told
    assert "node_robot1 -- " in told
    assert '-- "waitForCharge" -->' not in told


def test_a_check_says_what_the_sync_before_it_said(
    here: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where nothing is cached: what is sent to the picker has left a publisher behind."""
    model, root = _made("warehouse", here)
    publish = "mailbox_.publish({}_serve_pub_, msg, when);"
    code = [["src/dispatcher.cpp", publish.format("packer"), publish.format("picker")]]
    _edit({"example": "warehouse", "code": code}, root)
    assert main(["sync", str(here)]) == 0
    assert "picker.serve(carrier, 7 - cell)" in model.read_text(encoding="utf-8")
    assert main(["check", str(here)]) == 0
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "another"))
    assert main(["check", str(here)]) == 0
    text = model.read_text(encoding="utf-8")
    model.write_text(text.replace("loaded = !loaded;", "loaded = true;"), encoding="utf-8")
    assert main(["sync", str(here)]) == 0
    assert main(["check", str(here)]) == 0
