"""What a user does to a package in a day, and what `check` and `sync` make of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.cli.status import Status
from tests.roundtrip.mutations.harness import written
from tests.roundtrip.mutations.package import Package

CLEAN = int(Status.CLEAN)


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / ".cache"))


def made(dialect: str, folder: Path) -> Path:
    """The warehouse with its package."""
    root = folder / "warehouse"
    written(Package("warehouse", dialect), root)
    return root


def file_of(root: Path, end: str) -> Path:
    (found,) = (
        p for p in root.rglob("*") if p.as_posix().endswith(end) and ".rebsync" not in p.parts
    )
    return found


def replace(file: Path, old: str, new: str) -> None:
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


@pytest.mark.parametrize(
    ("dialect", "old", "new"),
    [
        ("ros1-cpp", "sendSelfWeigh(after(weigh_rate_))", "sendSelfWeigh(after(3))"),
        ("ros2-cpp", "sendSelfWeigh(after(weigh_rate_))", "sendSelfWeigh(after(3))"),
        ("ros1-py", "When(after=self._weigh_rate)", "When(after=3)"),
        ("ros2-py", "When(after=self._weigh_rate)", "When(after=3)"),
    ],
)
def test_a_stand_in_plays_as_often_as_the_class_looks(
    dialect: str, old: str, new: str, tmp_path: Path
) -> None:
    root = made(dialect, tmp_path)
    class_ = file_of(root, "/lifter.py" if dialect.endswith("py") else "/lifter.cpp")
    ends = {"ros1-py": "/lifter_stand_in", "ros2-py": "/lifter_stand_in.py"}
    stand_in = file_of(root, ends.get(dialect, "/lifter_stand_in.cpp"))
    replace(class_, old, new)
    code, played = class_.read_bytes(), stand_in.read_text(encoding="utf-8")
    assert main(["sync", str(root)]) == CLEAN
    assert class_.read_bytes() == code
    changed = stand_in.read_text(encoding="utf-8")
    gone = set(played.splitlines()) - set(changed.splitlines())
    assert len(gone) == 1
    assert "3.0" in changed
    assert main(["check", str(root)]) == CLEAN
    assert "after(3)" in (root / "warehouse.rebeca").read_text(encoding="utf-8")


@pytest.mark.parametrize("dialect", ["ros1-cpp", "ros2-cpp"])
def test_the_model_goes_into_a_file_that_was_moved(dialect: str, tmp_path: Path) -> None:
    root = made(dialect, tmp_path)
    old = file_of(root, "/carrier.cpp")
    new = old.parent / "robots" / "carrier.cpp"
    new.parent.mkdir()
    old.rename(new)
    replace(new, "  loaded_ = !loaded_;\n", "  loaded_ = !loaded_;  // mine\n")
    replace(file_of(root, "/CMakeLists.txt"), "src/carrier.cpp", "src/robots/carrier.cpp")
    assert main(["check", str(root)]) == CLEAN
    replace(root / "warehouse.rebeca", "delay(drive_time);\n    dispatcher", "dispatcher")
    assert main(["sync", str(root)]) == CLEAN
    assert not old.exists()
    text = new.read_text(encoding="utf-8")
    assert "// mine" in text
    assert "mailbox_.delay(drive_time_);" not in text
    assert main(["check", str(root)]) == CLEAN


def test_a_package_behind_a_link_is_found(tmp_path: Path) -> None:
    root = made("ros2-py", tmp_path / "repository")
    workspace = tmp_path / "workspace" / "src"
    workspace.mkdir(parents=True)
    (workspace / "warehouse").symlink_to(root / "warehouse")
    assert main(["check", str(workspace)]) == CLEAN
    replace(root / "warehouse.rebeca", "cell < 4", "cell < 5")
    assert main(["check", str(workspace)]) == int(Status.FINDINGS)
    assert main(["sync", str(workspace)]) == int(Status.UNUSABLE), "nothing is written behind it"
    assert main(["sync", str(root / "warehouse")]) == CLEAN
    assert main(["check", str(workspace)]) == CLEAN
    assert "if cell < 5:" in file_of(root, "/dispatcher.py").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("dialect", "end", "old", "new"),
    [
        ("ros1-cpp", ".cpp", "  x_ = place;\n", "  x_ = place;  // mine\n"),
        ("ros2-py", ".py", "        self._x = place\n", "        self._x = place  # mine\n"),
    ],
)
def test_edits_go_with_a_class_that_the_model_renames(
    dialect: str, end: str, old: str, new: str, tmp_path: Path
) -> None:
    root = made(dialect, tmp_path)
    before = file_of(root, f"/lifter{end}")
    replace(before, old, new)
    replace(root / "warehouse.rebeca", "Lifter", "Hoist")
    assert main(["sync", str(root)]) == CLEAN
    assert not before.exists()
    assert new in file_of(root, f"/hoist{end}").read_text(encoding="utf-8")
    assert main(["check", str(root)]) == CLEAN
