"""The hooks, run by the real pre-commit in real repositories of git."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from rebsync.cli import main

ROOT = Path(__file__).parents[2]
SHIPPED = ("rebsync", "forward", "grammars", "reverse", "roundtrip", "pyproject.toml", "LICENSE")
MODEL = """\
env int e = 2;

reactiveclass Robot(3) {
  knownrebecs {
    Robot other;
  }
  statevars {
    int x;
  }

  Robot(int x0) {
    x = x0;
    self.look();
  }

  msgsrv look() {
    x = (x + 1) % 4;
    self.look() after(e);
    other.hear(x, 0);
  }

  msgsrv hear(int place, int speed) {
    delay(1);
  }
}

main {
  Robot robot1(robot2):(1);
  Robot robot2(robot1):(2);
}
"""
PROPERTY = """\
property {
  define {
    small = robot1.x < 4;
  }
  Assertion {
    Stays_Small: small;
  }
}
"""
CONFIG = """\
default_install_hook_types: [pre-commit, pre-push]
repos:
  - repo: {source}
    rev: {revision}
    hooks:
      - id: rebsync-check
      - id: rebsync-verify
"""


def git(*arguments: str, cwd: Path) -> str:
    """Runs git, which must succeed; gives what it prints."""
    return run("git", *arguments, cwd=cwd, status=0)


def run(*command: str, cwd: Path, status: int | None = None) -> str:
    """Runs a command; gives all that it prints."""
    done = subprocess.run(
        command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
    )
    assert status in (None, done.returncode), done.stdout
    assert "Traceback" not in done.stdout, done.stdout
    return done.stdout


def init(folder: Path) -> None:
    git("init", "-q", "-b", "main", cwd=folder)
    git("config", "user.name", "Ada", cwd=folder)
    git("config", "user.email", "ada@example.org", cwd=folder)
    git("add", "-A", cwd=folder)
    git("commit", "-q", "-m", "begin", cwd=folder)


@pytest.fixture(scope="module", autouse=True)
def home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Where pre-commit keeps what it installs, and git looks for settings."""
    folder = tmp_path_factory.mktemp("home")
    (folder / ".gitconfig").write_text("")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PRE_COMMIT_HOME", str(folder / "hooks"))
        patch.setenv("REBSYNC_CACHE", str(folder / "cache"))
        patch.setenv("GIT_CONFIG_GLOBAL", str(folder / ".gitconfig"))
        patch.setenv("GIT_CONFIG_NOSYSTEM", "1")
        patch.setenv("PATH", f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}")
        for name in ("PYTHONPATH", "GIT_DIR", "GIT_INDEX_FILE", "PRE_COMMIT"):
            patch.delenv(name, raising=False)
        yield folder


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory, home: Path) -> Path:
    """A repository with rebsync as it is here, from which pre-commit installs it."""
    folder = tmp_path_factory.mktemp("rebsync")
    ignored = shutil.ignore_patterns("__pycache__", "*.pyc")
    for name in (*SHIPPED, "README.md", ".pre-commit-hooks.yaml"):
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, folder / name, symlinks=True, ignore=ignored)
        else:
            shutil.copy(ROOT / name, folder / name)
    init(folder)
    return folder


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory, source: Path) -> Path:
    """A repository with a model, its package and the hooks, which are installed."""
    folder = tmp_path_factory.mktemp("template")
    (folder / "patrol.rebeca").write_text(MODEL)
    (folder / "patrol.property").write_text(PROPERTY)
    (folder / "notes.txt").write_text("ours\n")
    assert main(["generate", str(folder / "patrol.rebeca"), "-o", str(folder)]) == 0
    revision = git("rev-parse", "HEAD", cwd=source).strip()
    config = CONFIG.format(source=source, revision=revision)
    (folder / ".pre-commit-config.yaml").write_text(config)
    init(folder)
    run("pre-commit", "install", "--install-hooks", cwd=folder, status=0)
    return folder


@pytest.fixture
def repository(template: Path, tmp_path: Path) -> Path:
    """A copy of that repository, and a remote one to push to."""
    folder = tmp_path / "here"
    shutil.copytree(template, folder, symlinks=True)
    git("init", "-q", "--bare", str(tmp_path / "there"), cwd=tmp_path)
    git("remote", "add", "origin", str(tmp_path / "there"), cwd=folder)
    return folder


def edit(path: str, old: str, new: str) -> Callable[[Path], None]:
    def change(folder: Path) -> None:
        text = (folder / path).read_text()
        assert old in text, text
        (folder / path).write_text(text.replace(old, new))

    return change


def commit(folder: Path) -> tuple[bool, str]:
    """Commits all that there is; whether that was let through, and what was printed."""
    before = git("rev-parse", "HEAD", cwd=folder)
    git("add", "-A", cwd=folder)
    shown = run("git", "commit", "-m", "change", cwd=folder)
    return git("rev-parse", "HEAD", cwd=folder) != before, shown


DRIFT = {
    "model": (edit("patrol.rebeca", "delay(1)", "delay(2)"), "the model is ahead"),
    "code": (edit("patrol/src/robot.cpp", "delay(1)", "delay(2)"), "the code is ahead"),
    "launch": (
        edit("patrol/launch/patrol.launch", 'value="2"', 'value="3"'),
        "rebec robot2: argument",
    ),
    "yaml": (edit("patrol/config/params.yaml", "e: 2", "e: 3"), "env e: initial value"),
    "msg": (edit("patrol/msg/RobotHear.msg", "int32 speed", "int16 speed"), "type of speed"),
    "manifest": (edit("patrol/.rebsync/manifest.json", "{", "<"), "RS962"),
    "header": (edit("patrol/include/patrol/mailbox.h", "alarm_;", "alarm_; int more_;"), "RS956"),
}


@pytest.mark.parametrize("name", DRIFT)
def test_a_commit_that_leaves_step_is_refused(repository: Path, name: str) -> None:
    change, told = DRIFT[name]
    change(repository)
    accepted, shown = commit(repository)
    assert not accepted, shown
    assert told in shown


def test_other_commits_are_let_through(repository: Path) -> None:
    edit("patrol.rebeca", "delay(1)", "delay(2)")(repository)
    assert main(["generate", str(repository / "patrol.rebeca"), "-o", str(repository)]) == 0
    accepted, shown = commit(repository)
    assert accepted, shown
    assert "rebsync check" in shown and "Passed" in shown
    edit("notes.txt", "ours", "theirs")(repository)
    accepted, shown = commit(repository)
    assert accepted, shown
    assert "Skipped" in shown


def test_what_is_not_staged_does_not_count(repository: Path) -> None:
    edit("patrol/src/robot.cpp", "delay(1)", "delay(2)")(repository)
    (repository / "extra.launch").write_text("<launch/>\n")
    git("add", "extra.launch", cwd=repository)
    shown = run("git", "commit", "-m", "change", cwd=repository, status=0)
    assert "Passed" in shown
    assert "delay(2)" in (repository / "patrol/src/robot.cpp").read_text()


def test_a_push_of_a_broken_property_is_refused(repository: Path) -> None:
    run("git", "push", "-q", "origin", "main", cwd=repository, status=0)
    edit("patrol.rebeca", "% 4", "% 6")(repository)
    assert main(["generate", str(repository / "patrol.rebeca"), "-o", str(repository)]) == 0
    accepted, shown = commit(repository)
    assert accepted, shown
    shown = run("git", "push", "origin", "main", cwd=repository)
    assert "in step, property Stays_Small broken" in shown
    there = git("rev-parse", "origin/main", cwd=repository)
    assert there == git("rev-parse", "HEAD~1", cwd=repository)


def test_the_hooks_can_be_tried(repository: Path, source: Path) -> None:
    edit("patrol.rebeca", "% 4", "% 6")(repository)
    tried = ("pre-commit", "try-repo", str(source), "rebsync-check", "--all-files")
    shown = run(*tried, cwd=repository, status=1)
    assert "the model is ahead" in shown
    assert "- exit code: 1" in shown


def test_the_hook_of_a_push_is_bounded_and_says_what_it_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (ROOT / ".pre-commit-hooks.yaml").read_text()
    entry = text.partition("id: rebsync-verify")[2].partition("entry: rebsync ")[2]
    command = entry.partition("\n")[0].split()
    assert "--max-time" in command
    # So many states that the search is not over before it looks at its bound.
    (tmp_path / "patrol.rebeca").write_text(MODEL.replace("% 4", "% 10000"))
    (tmp_path / "patrol.property").write_text(PROPERTY.replace("< 4", "< 10000"))
    monkeypatch.chdir(tmp_path)
    assert main(["generate", "patrol.rebeca"]) == 0
    assert main(command) == 0
    capsys.readouterr()
    assert main([*command, "--max-time", "0.000001"]) == 4  # as `args` of a configuration does
    shown = capsys.readouterr().out
    assert "patrol: in step" in shown
    assert "undetermined: the bound of 1e-06 seconds was reached; not finished: Stays" in shown
