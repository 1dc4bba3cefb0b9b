"""Links in packages and repositories: nothing is written, and no record read, through one."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

import rebsync.writing
from tests.cli.run import environment
from tests.cli.test_check import MODEL, SOURCE, made, package, replace
from tests.security.hostile import Run, everything, git, runner

__all__ = ["made", "package"]  # fixtures

RECORDS = (
    ".rebsync",
    ".rebsync/base.rebeca",
    ".rebsync/manifest.json",
    ".rebsync/base",
    ".rebsync/base/src",
    ".rebsync/base/src/robot.cpp",
)
GENERATED = ("src", "include", "include/patrol", "config", "launch", "src/robot.cpp")
WRITING = (["generate", "patrol.rebeca"], ["generate", "--force", "patrol.rebeca"], ["sync"])
READING = (["check"], ["check", "--verify"], ["sync", "--dry-run"], ["extract", "patrol"])
DIFFING = (["generate", "--diff", "patrol.rebeca"], ["diff", "patrol.rebeca", "patrol"])


@pytest.fixture
def run(package: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs the command in the directory with the package."""
    return runner(capsys, monkeypatch)


def linked(path: Path, away: Path) -> None:
    """Puts something elsewhere, and a link to it in its place."""
    away.parent.mkdir(parents=True, exist_ok=True)
    shutil.move(path, away)
    path.symlink_to(away)


# --- what is generated, and what is recorded ----------------------------------------------------


@pytest.mark.parametrize("command", [*WRITING, *READING, *DIFFING], ids=" ".join)
@pytest.mark.parametrize("part", [*RECORDS, *GENERATED])
def test_nothing_is_written_behind_a_link(
    run: Run, package: Path, tmp_path: Path, part: str, command: list[str]
) -> None:
    outside = tmp_path / "outside"
    linked(package / part, outside / Path(part).name)
    replace("patrol.rebeca", "% 4", "% 5")
    before = everything(outside)
    links = {p: p.readlink() for p in package.rglob("*") if p.is_symlink()}
    status, shown = run(*command)
    assert everything(outside) == before
    assert {p: p.readlink() for p in package.rglob("*") if p.is_symlink()} == links
    if command in WRITING and part in (*RECORDS, "src", "src/robot.cpp"):
        assert (status in (1, 2, 4), "RS813" in shown or "RS941" in shown) == (True, True), shown


@pytest.mark.parametrize("command", WRITING, ids=" ".join)
@pytest.mark.parametrize("part", [*RECORDS, "src", "src/robot.cpp"])
def test_nor_behind_one_that_stays_in_the_repository(
    run: Run, package: Path, part: str, command: list[str]
) -> None:
    git("init", "-q")
    linked(package / part, package.parent / "other" / Path(part).name)
    replace("patrol.rebeca", "% 4", "% 5")
    before = everything(package.parent / "other")
    status, shown = run(*command)
    assert (status, "RS813" in shown) == (2, True), shown
    assert everything(package.parent / "other") == before


def test_a_shell_start_up_file_stays_as_it_is(run: Run, package: Path, tmp_path: Path) -> None:
    start_up = tmp_path / ".bashrc"
    start_up.write_text("alias l=ls\n")
    Path(SOURCE).unlink()
    Path(SOURCE).symlink_to(start_up)
    for command in WRITING:
        assert run(*command)[0] != 0
        assert start_up.read_text() == "alias l=ls\n"


def test_a_new_package_is_not_put_behind_a_link(run: Run, package: Path, tmp_path: Path) -> None:
    git("init", "-q")
    shutil.rmtree(package)
    (tmp_path / "home").mkdir()
    package.symlink_to(tmp_path / "home")
    status, shown = run("generate", "patrol.rebeca")
    assert (status, "patrol: RS813" in shown, list((tmp_path / "home").iterdir())) == (2, True, [])


@pytest.mark.parametrize(
    "name", ["../../../other/a.cpp", "/etc/hostname", "src/../../a.cpp", "a//b", ""]
)
def test_a_manifest_names_only_files_of_its_package(run: Run, package: Path, name: str) -> None:
    manifest = package / ".rebsync" / "manifest.json"
    data = json.loads(manifest.read_text())
    data["files"][name] = "0" * 64
    manifest.write_text(json.dumps(data))
    status, shown = run("check")
    assert (status, "RS962" in shown) == (2, True)


# --- races --------------------------------------------------------------------------------------


@pytest.mark.parametrize("command", WRITING, ids=" ".join)
@pytest.mark.parametrize("part", ["src", ".rebsync", ".rebsync/base"])
def test_a_directory_that_becomes_a_link_meanwhile(
    run: Run,
    package: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    part: str,
    command: list[str],
) -> None:
    outside = tmp_path / "outside"
    shutil.copytree(package / part, outside)
    replace("patrol.rebeca", "% 4", "% 5")
    before = everything(outside)
    stage, done = rebsync.writing._stage, list[object]()

    def swapped(each: rebsync.writing._Replacement) -> None:
        if not done:
            (package / part).rename(tmp_path / "aside")
            (package / part).symlink_to(outside)
            done.append(each)
        stage(each)

    monkeypatch.setattr("rebsync.writing._stage", swapped)
    run(*command)
    assert done
    assert everything(outside) == before


_FLIP = """\
import os, sys, time
there, aside, link = sys.argv[1:]
print("begun", flush=True)
while True:
    os.rename(there, aside); os.rename(link, there); time.sleep(0.0003)
    os.rename(there, link); os.rename(aside, there); time.sleep(0.0003)
"""


@pytest.mark.parametrize("part", ["src", ".rebsync/base/src"])
def test_a_directory_that_is_a_link_half_of_the_time(
    run: Run, package: Path, tmp_path: Path, part: str
) -> None:
    outside = tmp_path / "outside"
    shutil.copytree(package / part, outside)
    before = everything(outside)
    link = tmp_path / "link"
    link.symlink_to(outside)
    flip = [sys.executable, "-c", _FLIP, str(package / part), str(tmp_path / "aside"), str(link)]
    with subprocess.Popen(flip, stdout=subprocess.PIPE) as attacker:
        try:
            assert attacker.stdout is not None
            attacker.stdout.readline()
            end = time.monotonic() + 4
            while time.monotonic() < end:
                text = re.sub(r"% \d+", f"% {time.monotonic_ns() % 90 + 5}", MODEL)
                Path("patrol.rebeca").write_text(text)
                run("generate", "--force", "patrol.rebeca")
                assert everything(outside) == before
        finally:
            attacker.kill()
    assert everything(outside) == before


# --- where the model is -------------------------------------------------------------------------


def says(package: Path, path: str) -> None:
    """Has a manifest say where the model is."""
    manifest = package / ".rebsync" / "manifest.json"
    data = json.loads(manifest.read_text())
    data["model"]["path"] = path
    manifest.write_text(json.dumps(data))


@pytest.mark.parametrize("is_repository", [True, False])
@pytest.mark.parametrize("command", [["check"], ["sync"], ["sync", "--dry-run"]], ids=" ".join)
def test_a_manifest_does_not_name_a_model_elsewhere(
    run: Run, package: Path, tmp_path: Path, command: list[str], is_repository: bool
) -> None:
    if is_repository:
        git("init", "-q")
    mine = tmp_path / "mine" / "patrol.rebeca"
    mine.parent.mkdir()
    shutil.copyfile("patrol.rebeca", mine)
    replace(SOURCE, "% 4", "% 7")
    for path in ("../../mine/patrol.rebeca", str(mine)):
        says(package, path)
        before = everything(tmp_path)
        status, shown = run(*command)
        assert (status, "RS815" in shown) == (2, True), shown
        assert everything(tmp_path) == before
    assert run("sync", "--model", str(mine))[0] == 0
    assert "% 7" in mine.read_text()


def test_what_the_user_named_may_hold_the_model(
    run: Run, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = package.parent
    (folder / "ros" / "deep").mkdir(parents=True)
    package.rename(folder / "ros" / "deep" / "patrol")
    says(folder / "ros" / "deep" / "patrol", "../../../patrol.rebeca")
    assert run("check", ".")[0] == 0
    assert run("check", "ros")[0] == 0  # who calls is where the model is
    monkeypatch.chdir("ros")
    assert run("check", "deep")[0] == 2
    assert run("check", "..")[0] == 0
    git("init", "-q", cwd=folder)
    assert run("check")[0] == 0


def test_a_model_that_is_a_link_in_the_repository(run: Run, package: Path) -> None:
    git("init", "-q")
    linked(Path("patrol.rebeca").absolute(), package.parent / "models" / "robots.rebeca")
    assert run("check") == (0, "patrol: in step\n")
    replace(SOURCE, "% 4", "% 7")
    status, shown = run("sync")
    assert status == 0
    assert "wrote patrol.rebeca, a link to models/robots.rebeca" in shown
    assert Path("patrol.rebeca").is_symlink()
    assert "% 7" in Path("models/robots.rebeca").read_text()
    for command in (["lint"], ["fmt"], ["verify"], ["export", "--for", "rmc"], ["generate"]):
        assert run(*command, "patrol.rebeca")[0] in (0, 1, 3)
    assert Path("patrol.rebeca").is_symlink()


@pytest.mark.parametrize("where", ["../away/patrol.rebeca", ".git/patrol.rebeca"])
@pytest.mark.parametrize(
    "command",
    [
        ["check"],
        ["sync"],
        ["sync", "--dry-run"],
        ["check", "--model", "patrol.rebeca"],
        ["lint", "."],
        ["lint", "--fix", "patrol.rebeca"],
        ["fmt", "patrol.rebeca"],
        ["generate", "patrol.rebeca"],
        ["verify", "patrol.rebeca"],
        ["simulate", "patrol.rebeca"],
        ["export", "--for", "rmc", "patrol.rebeca"],
        ["diff", "patrol.rebeca", "patrol"],
    ],
    ids=" ".join,
)
def test_a_model_that_is_a_link_out_of_the_repository(
    run: Run, package: Path, tmp_path: Path, command: list[str], where: str
) -> None:
    git("init", "-q")
    away = Path(where).absolute()
    linked(Path("patrol.rebeca").absolute(), away)
    replace(str(away), "delay(1);", "delay(1) ;")
    replace(SOURCE, "% 4", "% 7")
    before = everything(tmp_path)
    status, shown = run(*command)
    assert (status, "RS813" in shown or "RS815" in shown) == (2, True), shown
    assert everything(tmp_path) == before


_READS = {
    ("patrol.property", "verify"),
    ("patrol.property", "sync"),
    ("patrol.property", "--verify"),
    ("rebsync.toml", "verify"),
    ("rebsync.toml", "sync"),
    ("rebsync.toml", "generate"),
    ("rebsync.toml", "--verify"),
}


@pytest.mark.parametrize("name", ["patrol.property", "rebsync.toml"])
@pytest.mark.parametrize("command", [["check", "--verify"], ["sync"], ["verify"], ["generate"]])
def test_what_lies_beside_the_model_is_in_the_repository(
    run: Run, package: Path, command: list[str], name: str
) -> None:
    git("init", "-q")
    Path("../secret").write_text("a secret word\n")
    Path(name).unlink(missing_ok=True)
    Path(name).symlink_to("../secret")
    replace("patrol.rebeca", "% 4", "% 5")
    paths = ["patrol.rebeca"] if command[0] in ("verify", "generate") else []
    _, shown = run(*command, *paths)
    assert "secret word" not in shown
    assert ("RS813" in shown) == ((name, command[0]) in _READS or (name, command[-1]) in _READS), (
        shown
    )


# --- outputs ------------------------------------------------------------------------------------


@pytest.mark.parametrize("where", ["../start_up", ".git/config"])
@pytest.mark.parametrize(
    "command",
    [
        ["check", "--format", "sarif"],
        ["extract", "patrol"],
        ["diff", "patrol.rebeca", "patrol", "--format", "json"],
        ["export", "--for", "rmc", "patrol.rebeca"],
    ],
    ids=" ".join,
)
def test_an_output_that_a_branch_has_made_a_link(
    run: Run, package: Path, where: str, command: list[str]
) -> None:
    git("init", "-q")
    target = Path(where)
    if not target.exists():
        target.write_text("mine\n")
    before = target.read_text()
    Path("result").symlink_to(target)
    status, shown = run(*command, "-o", "result")
    assert (status, "result: RS813" in shown) == (2, True), shown
    assert target.read_text() == before


def test_outputs_go_where_the_user_says(run: Run, package: Path) -> None:
    git("init", "-q")
    Path("../link").symlink_to(Path("../elsewhere").absolute())
    Path("../elsewhere").write_text("")
    assert run("extract", "patrol", "-o", "../link")[0] == 0
    assert "reactiveclass" in Path("../elsewhere").read_text()
    assert run("extract", "patrol", "-o", "/dev/null")[0] == 0
    line = f'"{sys.executable}" -m rebsync extract patrol -o /dev/stdout | cat'
    done = subprocess.run(
        ["sh", "-c", line], env=environment(), capture_output=True, text=True, check=False
    )
    assert "reactiveclass" in done.stdout


def test_the_name_of_a_package_is_no_path(run: Run, package: Path) -> None:
    shutil.copytree("patrol", "src/one")
    shutil.copytree("patrol", "src/two")
    replace("src/one/package.xml", "<name>patrol<", "<name>../../stolen<")
    replace("src/two/package.xml", "<name>patrol<", "<name>/tmp/.stolen<")
    Path("models").mkdir()
    run("extract", "src", "-o", "models")
    assert sorted(p.name for p in Path("models").iterdir()) == [
        "_.._stolen.rebeca",
        "_tmp_.stolen.rebeca",
    ]
