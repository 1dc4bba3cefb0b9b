"""The model of a package is found wherever both are in a repository, and stays so."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from rebsync.cli import main
from tests.cli.test_check import MODEL, replace

Run = Callable[..., tuple[int, str]]
TARGETS = ("ros1-cpp", "ros2-py")  # one package, and two
SETTINGS = """\
license = "MIT"
copyright = "2026 Ada"
maintainers = [{ name = "Ada", email = "ada@example.org" }]
"""
PACKAGE = "ros/src/patrol"


@pytest.fixture(params=TARGETS)
def target(request: pytest.FixtureRequest) -> str:
    """A dialect."""
    return str(request.param)


@pytest.fixture
def folder(target: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current directory: a repository with a model in `models`, its package in `ros/src`."""
    return _made(tmp_path / "here", target, monkeypatch, is_repository=True)


@pytest.fixture
def plain(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The same in no repository."""
    return _made(tmp_path / "here", "ros1-cpp", monkeypatch, is_repository=False)


def _made(
    folder: Path, target: str, monkeypatch: pytest.MonkeyPatch, *, is_repository: bool
) -> Path:
    (folder / "models").mkdir(parents=True)
    (folder / "ros/src").mkdir(parents=True)
    monkeypatch.chdir(folder)
    monkeypatch.setenv("REBSYNC_CACHE", str(folder.parent / "cache"))
    if is_repository:
        git("init", "-q")
    Path("models/patrol.rebeca").write_text(MODEL)
    Path("models/rebsync.toml").write_text(f'target = "{target}"\n{SETTINGS}')
    assert main(["generate", "models/patrol.rebeca", "-o", "ros/src"]) == 0
    return folder


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs a command in-process; gives the exit status and all that is printed."""

    def run(*arguments: str) -> tuple[int, str]:
        capsys.readouterr()
        status = main(list(arguments))
        shown = capsys.readouterr()
        return status, shown.out + shown.err

    return run


def git(*arguments: str) -> None:
    subprocess.run(("git", *arguments), check=True, capture_output=True)


def move(old: str, new: str) -> None:
    Path(new).parent.mkdir(parents=True, exist_ok=True)
    Path(old).rename(new)


def git_move(old: str, new: str) -> None:
    Path(new).parent.mkdir(parents=True, exist_ok=True)
    git("add", "-A")
    git("mv", old, new)


def recorded(package: str = PACKAGE) -> dict[str, str]:
    """What the manifest says of the model, which is nothing of this machine."""
    text = Path(package, ".rebsync/manifest.json").read_text()
    assert str(Path.cwd().parent) not in text
    found: dict[str, str] = json.loads(text)["model"]
    return found


def in_step(package: str) -> tuple[int, str]:
    return 0, f"{package}: in step\n"


def test_a_package_is_checked_from_anywhere(
    run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for start in ("/", str(folder / "models"), str(folder / PACKAGE / ".rebsync")):
        monkeypatch.chdir(start)
        assert run("check", str(folder / PACKAGE)) == in_step(str(folder / PACKAGE))
    monkeypatch.chdir(folder / "ros")
    assert run("check", "src/patrol") == in_step("src/patrol")
    assert run("check", "../models/patrol.rebeca") == in_step("src/patrol")
    monkeypatch.chdir(next((folder / PACKAGE).rglob("launch")))
    assert run("check") == in_step("patrol")
    assert run("sync")[0] == 0


@pytest.mark.parametrize("moved", [move, git_move])
def test_a_model_may_move(run: Run, folder: Path, moved: Callable[[str, str], None]) -> None:
    moved("models/patrol.rebeca", "deep/down/patrol.rebeca")
    moved("models/rebsync.toml", "deep/down/rebsync.toml")
    status, shown = run("check", PACKAGE)
    assert (status, shown.startswith(f"{PACKAGE}: in step\n")) == (0, True), shown
    assert "RS965 its model is deep/down/patrol.rebeca, which" in shown
    assert f"`rebsync sync {PACKAGE}` records that" in shown
    assert run("check", "deep/down/patrol.rebeca")[0] == 0
    replace("deep/down/patrol.rebeca", "delay(1)", "delay(2)")
    status, shown = run("check", PACKAGE)
    assert (status, "the model is ahead" in shown) == (1, True), shown
    assert run("sync", PACKAGE)[0] == 0
    assert recorded()["path"] == "../../../deep/down/patrol.rebeca"
    assert run("check", PACKAGE) == in_step(PACKAGE)


def test_a_model_that_moved_is_recorded_though_nothing_else_changed(run: Run, folder: Path) -> None:
    move("models", "deep")
    assert run("sync", PACKAGE) == (0, f"{PACKAGE}: in step with deep/patrol.rebeca\n")
    assert recorded()["path"] == "../../../deep/patrol.rebeca"
    assert run("check", PACKAGE) == in_step(PACKAGE)


def test_generate_records_where_a_model_is_now(run: Run, folder: Path) -> None:
    move("models", "deep")
    assert run("generate", "deep/patrol.rebeca", "-o", "ros/src")[0] == 0
    assert recorded()["path"] == "../../../deep/patrol.rebeca"
    assert run("check", PACKAGE) == in_step(PACKAGE)


@pytest.mark.parametrize("moved", [move, git_move])
@pytest.mark.parametrize("to", ["packages/patrol", "a/b/c/d/robots"])
def test_a_package_may_move(
    run: Run, folder: Path, moved: Callable[[str, str], None], to: str
) -> None:
    moved(PACKAGE, to)
    status, shown = run("check", to)
    assert (status, shown.startswith(f"{to}: in step\n")) == (0, True), shown
    replace("models/patrol.rebeca", "delay(1)", "delay(2)")
    assert run("sync", to)[0] == 0
    up = "../" * len(Path(to).parts)
    assert recorded(to)["path"] == f"{up}models/patrol.rebeca"
    assert run("check", "models/patrol.rebeca") == in_step(to)


def test_a_model_may_get_another_name(run: Run, folder: Path) -> None:
    move("models/patrol.rebeca", "models/guard.rebeca")
    before = {p: p.read_bytes() for p in Path(PACKAGE).rglob("*") if p.is_file()}
    status, shown = run("check", PACKAGE)
    assert (status, "its model is models/guard.rebeca, which" in shown) == (0, True), shown
    assert f"`rebsync sync {PACKAGE}` records that" in shown
    assert run("sync", PACKAGE)[0] == 0
    manifest = Path(PACKAGE, ".rebsync/manifest.json")
    after = {p: p.read_bytes() for p in Path(PACKAGE).rglob("*") if p.is_file()}
    assert {p for p in after if after[p] != before[p]} == {manifest}
    assert run("check", PACKAGE) == in_step(PACKAGE)
    replace("models/guard.rebeca", "delay(1)", "delay(2)")
    assert run("sync", PACKAGE)[0] == 0
    assert run("check") == in_step(PACKAGE)


def test_a_package_keeps_its_name_where_settings_say_it(run: Run, folder: Path) -> None:
    move("models/patrol.rebeca", "models/guard.rebeca")
    shown = run("generate", "models/guard.rebeca", "-o", "ros/src")[1]
    assert "ros/src/patrol: RS965 this was made from models/guard.rebeca when it was" in shown
    assert 'write `package = "patrol"` in rebsync.toml' in shown
    shutil.rmtree("ros/src/guard")
    replace("models/rebsync.toml", "license", 'package = "patrol"\nlicense')
    status, shown = run("check", PACKAGE)
    assert (status, "RS955" in shown) == (0, False), shown
    assert run("generate", "models/guard.rebeca", "-o", "ros/src")[0] == 0
    assert recorded()["name"] == "guard.rebeca"
    assert run("check") == in_step(PACKAGE)


def test_of_a_model_with_another_name_and_text_there_is_a_hint(run: Run, folder: Path) -> None:
    move("models/patrol.rebeca", "models/guard.rebeca")
    replace("models/guard.rebeca", "delay(1)", "delay(2)")
    status, shown = run("check", PACKAGE)
    assert (status, "RS965 the model patrol.rebeca" in shown) == (2, True), shown
    told = ("sync", "--model", "models/guard.rebeca", PACKAGE)
    assert f"if it is models/guard.rebeca now, `rebsync {' '.join(told)}` brings both" in shown
    assert run(*told)[0] == 0
    assert recorded()["path"] == "../../../models/guard.rebeca"
    assert run("check") == in_step(PACKAGE)
    assert run("check", "models/guard.rebeca") == in_step(PACKAGE)


def test_another_model_of_that_name_is_not_taken_for_it(run: Run, folder: Path) -> None:
    Path("models/patrol.rebeca").unlink()
    Path("other").mkdir()
    Path("other/patrol.rebeca").write_text("reactiveclass A(2) { }\nmain { A a():(); }\n")
    status, shown = run("check", PACKAGE)
    assert (status, "RS965" in shown, "other" in shown) == (2, True, False), shown


def test_of_several_copies_the_user_says_which(run: Run, folder: Path) -> None:
    for copy in ("a", "b"):
        shutil.copytree("models", copy)
    assert run("check", PACKAGE) == in_step(PACKAGE)
    assert run("check", "a/patrol.rebeca")[0] == 2
    status, shown = run("generate", "a/patrol.rebeca", "-o", "ros/src")
    assert (status, "was made from models/patrol.rebeca, not from a/patrol" in shown) == (2, True)
    shutil.rmtree("models")
    for command in ("check", "sync"):
        status, shown = run(command, PACKAGE)
        assert (status, "may be any of a/patrol.rebeca, b/patrol.rebeca" in shown) == (2, True)
    assert run("sync", "--model", "b/patrol.rebeca", PACKAGE)[0] == 0
    assert run("check", "b/patrol.rebeca") == in_step(PACKAGE)
    assert run("check", "a/patrol.rebeca")[0] == 2


def test_a_model_that_was_named_once_is_recorded(run: Run, folder: Path) -> None:
    Path("new").mkdir()
    shutil.copy("models/rebsync.toml", "new")
    Path("new/patrol.rebeca").write_text(MODEL.replace("delay(1)", "delay(2)"))
    assert run("check", "--model", "new/patrol.rebeca", PACKAGE)[0] == 1
    assert recorded()["path"] == "../../../models/patrol.rebeca"
    assert run("sync", "--model", "new/patrol.rebeca", PACKAGE)[0] == 0
    assert recorded()["path"] == "../../../new/patrol.rebeca"
    assert run("check", PACKAGE) == in_step(PACKAGE)
    assert run("check", "models/patrol.rebeca")[0] == 2


def test_a_model_finds_all_packages_made_from_it(run: Run, folder: Path) -> None:
    assert main(["generate", "models/patrol.rebeca", "-o", "b"]) == 0
    move(PACKAGE, "ros/two/robots")
    Path("x").mkdir()
    Path("x/patrol.rebeca").write_text(MODEL)
    assert main(["generate", "x/patrol.rebeca", "-o", "x"]) == 0
    assert run("check", "models/patrol.rebeca")[1].startswith(
        "b/patrol: in step\nros/two/robots: in step\n"
    )
    assert run("check", "x/patrol.rebeca") == in_step("x/patrol")
    Path("link.rebeca").symlink_to("x/patrol.rebeca")
    assert run("check", "link.rebeca") == in_step("x/patrol")


def test_built_copies_and_inner_repositories_are_not_looked_at(run: Run, folder: Path) -> None:
    move("models", "deep")
    shutil.copytree("deep", "install/share")
    Path("install/COLCON_IGNORE").touch()
    shutil.copytree("deep", "inner")
    git("init", "-q", "inner")
    assert run("sync", PACKAGE)[0] == 0
    assert recorded()["path"] == "../../../deep/patrol.rebeca"


# --- without a repository -----------------------------------------------------------------------


def test_without_a_repository_it_is_found_from_anywhere(
    run: Run, plain: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert recorded()["path"] == "../../../models/patrol.rebeca"
    for start in ("/", str(plain / "models"), str(plain / PACKAGE)):
        monkeypatch.chdir(start)
        assert run("check", str(plain / PACKAGE)) == in_step(str(plain / PACKAGE))
    monkeypatch.chdir(plain / "ros")
    assert run("check", "../models/patrol.rebeca") == in_step("src/patrol")


def test_a_path_of_the_machine_is_remembered_and_not_recorded(
    run: Run, plain: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    users = plain.parent / "users"
    monkeypatch.setenv("HOME", str(users / "ada"))
    shutil.copytree("models", users / "ada/models")
    shutil.rmtree(PACKAGE)
    assert main(["generate", str(users / "ada/models/patrol.rebeca"), "-o", "ros/src"]) == 0
    assert "path" not in recorded()
    assert run("check", PACKAGE) == in_step(PACKAGE)
    replace(str(users / "ada/models/patrol.rebeca"), "delay(1)", "delay(2)")
    assert run("sync", PACKAGE)[0] == 0
    assert run("check", PACKAGE) == in_step(PACKAGE)
    monkeypatch.setenv("REBSYNC_CACHE", str(plain.parent / "other"))
    assert run("check", PACKAGE)[0] == 2


def test_a_model_of_another_repository_is_remembered(run: Run, folder: Path) -> None:
    git("init", "-q", "other")
    assert main(["generate", "models/patrol.rebeca", "-o", "other"]) == 0
    assert "path" not in recorded("other/patrol")
    assert run("check", "other/patrol") == in_step("other/patrol")
    replace("models/patrol.rebeca", "delay(1)", "delay(2)")
    assert run("sync", "other/patrol")[0] == 0
    assert run("check", "other/patrol") == in_step("other/patrol")


# --- without a manifest -------------------------------------------------------------------------


def test_a_model_that_is_named_needs_no_manifest(run: Run, folder: Path, target: str) -> None:
    records = ".rebsync"
    shutil.rmtree(f"{PACKAGE}/{records}")
    for path in (PACKAGE, "ros/src", "."):
        assert run("check", "--model", "models/patrol.rebeca", path) == in_step(PACKAGE)
    (source,) = Path(PACKAGE).rglob("robot.cpp" if target == "ros1-cpp" else "robot.py")
    replace(str(source), "delay(1)", "delay(3)")
    status, shown = run("check", "--model", "models/patrol.rebeca", PACKAGE)
    assert (status, "delay is 1 in the model, 3 in the code" in shown) == (1, True), shown
    shutil.copytree(PACKAGE, "other/patrol")
    status, shown = run("check", "--model", "models/patrol.rebeca", ".")
    assert (status, "--model is for one package, and here are" in shown) == (2, True), shown
