"""Names and texts that terminals and CI systems obey: every command shows them as escapes."""

from __future__ import annotations

import json
import os
import pty
import re
import subprocess
import sys
import unicodedata
from pathlib import Path

import pytest

from tests.cli.run import environment

_EVIL = "\x1b[2J\x9b31m\u202e\u200b\r\n::error::stolen ##[error]x"
_FOLDER = f"d{_EVIL}"
_MODEL = """reactiveclass Robot(3) {
    statevars { int x; }
    Robot() { self.go(); }
    msgsrv go() { x = x + 1; assertion(x < 2, "TEXT"); self.go() after(1); }
}
main { Robot r():(); }
"""
_NODE = """#include <ros/ros.h>
#include <vector>
ros::Publisher pub;
void tick(const ros::TimerEvent&) { ROS_ASSERT_MSG(false, "a\x1b[2Jb"); unknown_to_all(pub); }
int main(int argc, char** argv) {
  ros::init(argc, argv, "n\x1b[2J\u202e");
  ros::NodeHandle n;
  ros::Timer t = n.createTimer(ros::Duration(1e400), tick);
  ros::spin();
}
"""
_COMMANDS = {
    "lint": ("lint", "bad.rebeca"),
    "lint github": ("lint", "bad.rebeca", "--format", "github"),
    "lint json": ("lint", "bad.rebeca", "--format", "json"),
    "lint sarif": ("lint", "bad.rebeca", "--format", "sarif"),
    "lint property": ("lint", "m.property"),
    "fmt": ("fmt", "--check", "loose.rebeca"),
    "fmt itself": ("fmt", "loose.rebeca"),
    "export": ("export", "--for", "rmc", "bad.rebeca"),
    "verify": ("verify", "m.rebeca"),
    "verify json": ("verify", "m.rebeca", "--format", "json"),
    "verify property": ("verify", "m.rebeca", "--property", "none.property"),
    "simulate": ("simulate", "m.rebeca", "--seed", "1", "--steps", "3"),
    "generate": ("generate", "m.rebeca", "-o", "code"),
    "generate list": ("generate", "m.rebeca", "--list"),
    "extract": ("extract", "code", "--report", "text"),
    "extract model": ("extract", "code", "-o", "read.rebeca"),
    "extract json": ("extract", "code", "--format", "json"),
    "check": ("check", "."),
    "check verify": ("check", "--verify", "."),
    "check json": ("check", ".", "--format", "json"),
    "check github": ("check", ".", "--format", "github"),
    "check junit": ("check", ".", "--format", "junit"),
    "sync": ("sync", "m"),
    "diff": ("diff", "m.rebeca", "other.rebeca"),
    "diff behaviour": ("diff", "m.rebeca", "other.rebeca", "--behaviour"),
    "diff github": ("diff", "m.rebeca", "other.rebeca", "--format", "github"),
    "diff json": ("diff", "m.rebeca", "other.rebeca", "--format", "json"),
    "diff revision": ("diff", f"HEAD{_EVIL}:m.rebeca", "m.rebeca"),
    "new": ("new", "rebsync.toml"),
    "no such file": ("lint", f"none{_EVIL}.rebeca"),
    "no such option": ("lint", f"--x{_EVIL}"),
    "no such command": (f"x{_EVIL}",),
    "no such choice": ("lint", "m.rebeca", "--format", f"x{_EVIL}"),
}


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A folder whose path and files are hostile."""
    folder = tmp_path / _FOLDER
    folder.mkdir()
    (folder / "m.rebeca").write_text(_MODEL.replace("TEXT", "fine"))
    (folder / "other.rebeca").write_text(_MODEL.replace("TEXT", "fine").replace("x + 1", "x + 2"))
    (folder / "loose.rebeca").write_text(_MODEL.replace("TEXT", "fine").replace("    ", " "))
    (folder / "bad.rebeca").write_text(
        _MODEL.replace("TEXT", f"a{_EVIL}b").replace("x +", "y\x9b +")
    )
    (folder / "m.property").write_text("property { Assertion { a\x1b: r.x < 9; } } // \u202e\n")
    code = folder / "code"
    code.mkdir()
    (code / "package.xml").write_text("<package><name>code</name></package>")
    (code / f"n{_FOLDER[1:].replace('/', '')}.cpp").write_text(_NODE)
    _run(("generate", "m.rebeca", "-o", "."), folder)
    generated = folder / "m" / "src" / "robot.cpp"
    text = generated.read_text()
    assert '"fine"' in text
    generated.write_text(text.replace('"fine"', '"fi\x1b[2Jne"'))
    return folder


def _from_above(arguments: tuple[str, ...], folder: Path) -> list[str]:
    """The arguments with paths from above the folder, so that its name is part of what is said."""
    return [
        f"{_FOLDER}/{a}" if not a.startswith("-") and (folder / a).exists() else a
        for a in arguments
    ]


def _run(arguments: tuple[str, ...], folder: Path) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, "-m", "rebsync", *_from_above(arguments, folder)],
        cwd=folder.parent,
        capture_output=True,
        env=environment(),
        check=False,
        stdin=subprocess.DEVNULL,
    )


def _run_on_terminal(arguments: tuple[str, ...], folder: Path) -> bytes:
    """What the command writes to a terminal."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "rebsync", *_from_above(arguments, folder)],
        cwd=folder.parent,
        stdin=subprocess.DEVNULL,
        stdout=theirs,
        stderr=theirs,
        env={**environment(), "TERM": "xterm-256color"},
    )
    os.close(theirs)
    read = b""
    while True:
        try:
            data = os.read(ours, 1 << 16)
        except OSError:  # Linux says so at the end
            break
        if not data:
            break
        read += data
    os.close(ours)
    process.wait()
    return read


def _refuse(data: bytes, is_terminal: bool = False) -> None:
    text = data.decode("utf-8")
    odd = {
        c for c in text if c not in "\n\t" and unicodedata.category(c) in ("Cc", "Cf", "Zl", "Zp")
    }
    assert not odd, text
    assert "Traceback" not in text, text
    for line in text.splitlines():
        assert is_terminal or not line.lstrip().startswith("::error::stolen"), line
        assert is_terminal or "##[" not in line, line


@pytest.mark.parametrize("name", _COMMANDS)
def test_nothing_reaches_a_pipe(name: str, place: Path) -> None:
    done = _run(_COMMANDS[name], place)
    assert done.stdout + done.stderr
    _refuse(done.stdout)
    _refuse(done.stderr)
    if "json" in _COMMANDS[name]:
        json.loads(done.stdout or "{}")


@pytest.mark.parametrize("name", [n for n in _COMMANDS if n.isalpha()])
def test_nothing_reaches_a_terminal(name: str, place: Path) -> None:
    read = _run_on_terminal(_COMMANDS[name], place)
    assert read
    _refuse(re.sub(rb"\x1b\[[\d;]*[mK]|\r(?=\n|\x1b\[K)", b"", read), True)


_OUTPUTS = {
    "fmt": ("fmt", "--diff", "loose.rebeca"),
    "sync": ("sync", "--dry-run", "m"),
    "generate": ("generate", "m.rebeca", "-o", ".", "--diff"),
}


@pytest.mark.parametrize("name", _OUTPUTS)
def test_a_patch_is_faithful_on_a_pipe_and_clean_on_a_terminal(name: str, place: Path) -> None:
    """Texts with form feeds and other line ends are the texts of the patch; names are quoted."""
    model = place / "loose.rebeca"
    model.write_text(_MODEL.replace("TEXT", "fine").replace("    ", " ") + "// \x0cé\x0c\n")
    place_model = place / "m.rebeca"
    place_model.write_text(_MODEL.replace("TEXT", "other").replace("(3)", "(4)") + "// \x0cé\n")
    piped = _run(_OUTPUTS[name], place)
    assert b"\\ No newline" not in piped.stdout, piped.stdout
    heads = [line for line in piped.stdout.split(b"\n") if line.startswith((b"--- ", b"+++ "))]
    assert heads
    assert all(b"\x1b" not in line for line in heads)
    assert not any(line.startswith(b"::error") for line in piped.stdout.split(b"\n"))
    seen = _run_on_terminal(_OUTPUTS[name], place)
    _refuse(re.sub(rb"\x1b\[[\d;]*[mK]|\r(?=\n|\x1b\[K)", b"", seen), True)


def test_the_output_of_fmt_is_faithful_on_a_pipe(place: Path) -> None:
    text = _MODEL.replace("TEXT", "\u200d fine") + "// \x0cé\u200f\n"
    done = subprocess.run(
        [sys.executable, "-m", "rebsync", "fmt", "-"],
        input=text.encode(),
        capture_output=True,
        env=environment(),
        check=False,
    )
    assert "\u200d fine".encode() in done.stdout
    assert "\x0cé\u200f\n".encode() in done.stdout
