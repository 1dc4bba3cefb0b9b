"""`rebsync init` in a repository, and `rebsync examples`."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from rebsync.cli import main, team_files
from tests.cli.run import ROOT, environment

CI_PAGE = (ROOT / "docs/ci.md").read_text(encoding="utf-8")


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with a model, its properties and its package."""
    assert main(["examples", str(tmp_path), "hello"]) == 0
    (tmp_path / "hello/rebsync.toml").unlink()
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def texts(folder: Path) -> dict[Path, bytes]:
    """All files of a directory."""
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def ran(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """What a command prints that ends well."""
    capsys.readouterr()
    assert main(arguments) == 0
    return capsys.readouterr().out


def test_a_repository_is_set_up_once(
    repository: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir("hello")
    assert ran(capsys, "init").splitlines() == [
        "model ../hello/hello.rebeca",
        "  properties  ../hello/hello.property",
        "  package     ../hello/hello, ros1-cpp",
        "wrote ../hello/rebsync.toml",
        "wrote ../.pre-commit-config.yaml",
        "wrote ../.github/workflows/rebsync.yml",
        "`pre-commit install` puts the hooks into this clone",
    ]
    before = texts(repository)
    assert "wrote" not in ran(capsys, "init")
    assert texts(repository) == before


def test_what_is_written_changes_no_verdict(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = 'target = "ros2-cpp"\npackage = "walker"\n'
    (repository / "hello/rebsync.toml").write_text(settings)
    ran(capsys, "generate", "hello/hello.rebeca", "-o", "ws")
    (repository / "hello/rebsync.toml").unlink()
    subprocess.run(["mv", "ws/walker", "ws/renamed"], check=True)
    ran(capsys, "init")
    told = (repository / "hello/rebsync.toml").read_text()
    assert 'package = "hello"\n' in told  # of the first of the two
    subprocess.run(["rm", "-r", "hello/hello", "hello/rebsync.toml"], check=True)
    ran(capsys, "init")
    told = (repository / "hello/rebsync.toml").read_text()
    assert told.splitlines()[1:3] == ['package = "walker"', 'target = "ros2-cpp"']
    assert ran(capsys, "check") == "ws/renamed: in step\n"


def test_files_that_are_there_are_not_changed(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (repository / team_files.HOOKS).write_text("repos: []\n")
    (repository / team_files.GITLAB).write_text("stages: [test]\n")
    before = texts(repository)
    out = ran(capsys, "init")
    assert f"{team_files.HOOKS} is yours; to add there:\n{team_files.HOOK_ENTRIES}" in out
    assert f"{team_files.GITLAB} is yours; to add there:\n{team_files.GITLAB_JOB}" in out
    assert texts(repository).keys() - before.keys() == {repository / "hello/rebsync.toml"}
    assert before.items() <= texts(repository).items()


def test_what_belongs_to_nothing_is_told(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (repository / "hello/hello.rebeca").rename(repository / "lost.rebeca")
    (repository / "hello/hello").rename(repository / "hello/of_lost")
    driver = repository / "driver"
    driver.mkdir()
    (driver / "package.xml").write_text("<buildtool_depend>ament_cmake</buildtool_depend>\n")
    lines = ran(capsys, "init").splitlines()
    assert "package driver: of no model here; `rebsync ask driver QUESTION` looks at its nodes" in (
        lines
    )
    assert "properties hello/hello.property: no model of this name is beside them" in lines
    assert 'target = "ros1-cpp"\n' in (repository / "rebsync.toml").read_text()


def test_nothing_refuses_commits_before_there_is_a_package(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ran(capsys, "init", str(tmp_path)).startswith("no model is here")
    assert not texts(tmp_path)
    (tmp_path / "package.xml").write_text("<build_type>ament_cmake</build_type>\n")
    (tmp_path / "a-b.rebeca").write_text("main {}\n")
    (tmp_path / "c.rebeca").write_text("main {}\n")
    assert "once there is a package" in ran(capsys, "init", str(tmp_path))
    told = (tmp_path / "rebsync.toml").read_text()
    assert "\npackage" not in told and '\ntarget = "ros2-cpp"\n' in told


def test_the_hooks_are_those_that_are_shipped() -> None:
    shipped = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    (local,) = yaml.safe_load(team_files.HOOKS_FILE)["repos"]
    for key in ("id", "name", "entry", "stages"):
        assert [h[key] for h in local["hooks"]] == [h[key] for h in shipped]


@pytest.mark.parametrize("text", [team_files.WORKFLOW, team_files.GITLAB_JOB])
def test_the_page_of_continuous_integration_shows_what_is_written(text: str) -> None:
    assert f"```yaml\n{text}```\n" in CI_PAGE


@pytest.mark.parametrize(("edit", "status"), [("", 0), ("delay(2)", 1)])
def test_the_action_tells_the_verdict(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, edit: str, status: int
) -> None:
    assert main(["examples", str(tmp_path), "hello"]) == 0
    monkeypatch.chdir(tmp_path)
    if edit:
        model = tmp_path / "hello/hello.rebeca"
        model.write_text(model.read_text().replace(edit, "delay(3)"))
    action = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
    check = action["runs"]["steps"][-1]
    assert set(check["env"]) == {"OPTIONS", "PATHS"}
    tool = tmp_path / "bin/rebsync"
    tool.parent.mkdir()
    tool.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m rebsync "$@"\n')
    tool.chmod(0o755)
    given = {name.upper(): each["default"] for name, each in action["inputs"].items()}
    given["OPTIONS"] += " --allow deadlock"
    path = f"{tool.parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-e", "-c", check["run"]], env={**environment(), **given, "PATH": path}, text=True
    )
    assert done.returncode == status
    assert (tmp_path / "rebsync.sarif").is_file()


def test_an_example_is_written_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "files" in ran(capsys, "examples", str(tmp_path), "warehouse")
    written, shipped = texts(tmp_path / "warehouse"), texts(ROOT / "examples/warehouse")
    assert {p.relative_to(tmp_path): text for p, text in written.items()} == {
        p.relative_to(ROOT / "examples"): text for p, text in shipped.items()
    }
    (tmp_path / "warehouse/README.md").write_text("mine\n")
    assert "is there already" in ran(capsys, "examples", str(tmp_path), "warehouse")
    assert (tmp_path / "warehouse/README.md").read_text() == "mine\n"


def test_an_example_that_there_is_not(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["examples", str(tmp_path), "helo"]) == 2
    assert 'no example "helo"; there are experiment1' in capsys.readouterr().err
