"""Pipes, devices, sockets and directories where a file is wanted: refused at once."""

from __future__ import annotations

import os
import shutil
import socket
import stat
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.run import rebsync
from tests.cli.test_check import made, package, replace
from tests.security.hostile import Run, git, runner

__all__ = ["made", "package"]  # fixtures
pytestmark = pytest.mark.timeout(60)

COMMANDS = (
    ["check"],
    ["check", "--verify"],
    ["sync"],
    ["sync", "--dry-run"],
    ["extract", "patrol"],
    ["generate", "patrol.rebeca"],
    ["generate", "--diff", "patrol.rebeca"],
    ["generate", "--force", "patrol.rebeca"],
    ["verify", "patrol.rebeca"],
    ["simulate", "patrol.rebeca"],
    ["lint", "patrol.rebeca", "patrol.property"],
    ["lint", "."],
    ["fmt", "patrol.rebeca"],
    ["fmt", "."],
    ["export", "--for", "rmc", "patrol.rebeca"],
    ["diff", "patrol.rebeca", "patrol"],
    ["new", "patrol.rebeca", "-o", "new.rebeca"],
)
PLACES = (
    "patrol.rebeca",
    "patrol.property",
    "rebsync.toml",
    "patrol/.rebsync/manifest.json",
    "patrol/.rebsync/base.rebeca",
    "patrol/.rebsync/base/src/robot.cpp",
    "patrol/src/robot.cpp",
    "patrol/package.xml",
    "patrol/launch/patrol.launch",
    "patrol/scripts/talk",
)


def _socket(path: Path) -> None:
    here = Path.cwd()
    os.chdir(path.parent)  # names of sockets are short
    try:
        with socket.socket(socket.AF_UNIX) as made_:
            made_.bind(path.name)
    finally:
        os.chdir(here)


def _device(path: Path) -> None:
    try:
        os.mknod(path, stat.S_IFCHR | 0o600, os.makedev(1, 5))  # that of /dev/zero
    except PermissionError:
        pytest.skip("devices are not ours to make")


SPECIAL: dict[str, Callable[[Path], object]] = {
    "pipe": os.mkfifo,
    "socket": _socket,
    "device": _device,
    "directory": Path.mkdir,
    "link to a device": lambda p: p.symlink_to("/dev/zero"),
    "link to a file of the kernel": lambda p: p.symlink_to("/proc/self/environ"),
}


@pytest.fixture
def run(package: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs the command in the directory with the package."""
    monkeypatch.setenv("SECRET", "a secret word")
    return runner(capsys, monkeypatch)


def put(place: str, kind: str) -> None:
    path = Path(place)
    path.parent.mkdir(exist_ok=True)
    path.unlink(missing_ok=True)
    SPECIAL[kind](path)


@pytest.mark.parametrize("kind", SPECIAL)
@pytest.mark.parametrize("place", PLACES)
def test_it_is_refused_at_once(run: Run, place: str, kind: str) -> None:
    replace("patrol.rebeca", "% 4", "% 5")
    put(place, kind)
    for command in COMMANDS:
        status, shown = run(*command)
        assert status in (0, 1, 2, 3, 4)
        assert "a secret word" not in shown
        if place in command[-2:] and (command[0] != "new" and kind != "directory"):
            assert status == 2, (command, shown)
            assert "RS814" in shown, (command, shown)
    mode = Path(place).lstat().st_mode
    assert not stat.S_ISREG(mode), "what is there is not written over"


@pytest.mark.parametrize("kind", ["pipe", "device", "link to a device"])
@pytest.mark.parametrize("is_repository", [True, False])
def test_what_a_branch_may_bring_is_named(run: Run, kind: str, is_repository: bool) -> None:
    if is_repository:
        git("init", "-q")
    for place, command in (
        ("patrol.rebeca", ["check"]),
        ("rebsync.toml", ["sync"]),
        ("patrol.property", ["check", "--verify"]),
        ("patrol/.rebsync/manifest.json", ["check"]),
    ):
        kept = Path(place).read_bytes() if Path(place).exists() else None
        replace_ = Path("patrol.rebeca").read_bytes()
        if place == "rebsync.toml":
            replace("patrol.rebeca", "% 4", "% 5")
        put(place, kind)
        status, shown = run(*command)
        assert (status, any(c in shown for c in ("RS813", "RS814", "RS815"))) == (2, True), shown
        Path(place).unlink()
        if kept is not None:
            Path(place).write_bytes(kept)
        Path("patrol.rebeca").write_bytes(replace_)


def test_a_pipe_that_a_user_names(package: Path) -> None:
    """What a shell makes of `<(command)` is the user's, and is read."""
    if shutil.which("bash") is None:
        pytest.skip("no bash")
    import subprocess
    import sys

    from tests.cli.run import environment

    line = f'"{sys.executable}" -m rebsync diff <(cat patrol.rebeca) patrol.rebeca'
    done = subprocess.run(
        ["bash", "-c", line], env=environment(), capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout) in ((0, ""), (2, "")), done
    text = Path("patrol.rebeca").read_bytes()
    assert rebsync("lint", "/dev/stdin", cwd=package.parent, stdin=text).status == 0


@pytest.mark.parametrize("place", ["patrol/src/robot.cpp", "patrol/.rebsync/manifest.json"])
def test_a_file_that_would_fill_the_memory(run: Run, place: str) -> None:
    """It takes no place in an archive, or in a repository."""
    os.truncate(place, 1 << 40)
    for command in ("check", "extract", "sync"):
        status, shown = run(*[command, "patrol"])
        if command != "extract" or "src" in place:
            assert (status in (2, 4), "larger than 64 MiB" in shown) == (True, True), shown
