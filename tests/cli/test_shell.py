"""What every command owes its shell: status, messages without traceback, speed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from itertools import product
from pathlib import Path

import pytest

from rebsync.cli.group import COMMANDS
from rebsync.cli.status import Status, status_of, worst
from rebsync.diagnostics import Diagnostic, Findings, Severity
from rebsync.source import Source, Span
from tests.cli.run import environment, rebsync

HEAVY = ("lark", "jinja2", "libcst", "tree_sitter")


def test_help_names_every_command_and_loads_nothing_heavy(tmp_path: Path) -> None:
    script = (
        "import sys\nfrom rebsync.cli import main\nstatus = main(['--help'])\n"
        f"print([m for m in {HEAVY} if m in sys.modules], file=sys.stderr)\nsys.exit(status)"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], env=environment(), capture_output=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, b"[]\n")
    assert all(f"  {name} " in done.stdout.decode() for name in COMMANDS)


def test_without_a_command_help_is_laid_out(tmp_path: Path) -> None:
    bare, asked = rebsync(cwd=tmp_path), rebsync("--help", cwd=tmp_path)
    assert (bare.status, bare.out, bare.err.strip()) == (2, "", asked.out.strip())
    assert all(f"\n  {name} " in asked.out for name in COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_itself(tmp_path: Path, command: str) -> None:
    done = rebsync(command, "--help", cwd=tmp_path)
    assert done.status == 0
    assert f"rebsync {command}" in done.out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["gnerate"], 'no command "gnerate"; did you mean "generate"?'),
        (["fmt"], "Missing argument"),
        (["fmt", "--chek", "x"], "--check"),
        (["lint", "--format", "xml", "x"], "'xml' is not one of"),
        (["export", "x"], "--for"),
    ],
)
def test_wrong_usage(tmp_path: Path, arguments: list[str], message: str) -> None:
    done = rebsync(*arguments, cwd=tmp_path)
    assert (done.status, done.out) == (2, "")
    assert message in done.err


@pytest.mark.parametrize(
    "command", [["fmt"], ["lint"], ["export", "--for", "rmc"], ["new"], ["generate"]], ids=str
)
@pytest.mark.parametrize(
    ("path", "code"), [("missing.rebeca", "RS801"), ("a.rebeca/b", "RS802"), ("l1.rebeca", "RS804")]
)
def test_unusable_input(tmp_path: Path, command: list[str], path: str, code: str) -> None:
    (tmp_path / "a.rebeca").touch()
    (tmp_path / "l1.rebeca").write_bytes(b"// caf\xe9\n")
    done = rebsync(*command, path, cwd=tmp_path)
    assert done.status == 2
    assert f" {code} " in done.err + done.out
    assert f"{path}:" in done.err + done.out


def test_a_full_standard_output(tmp_path: Path) -> None:
    (tmp_path / "a.rebeca").write_text("main { }\n")
    with Path("/dev/full").open("wb") as full, (tmp_path / "a.rebeca").open("rb") as model:
        done = subprocess.run(
            [sys.executable, "-m", "rebsync", "fmt", "-"],
            stdin=model,
            stdout=full,
            stderr=subprocess.PIPE,
            env=environment(),
            check=False,
        )
    assert (done.returncode, done.stderr) == (
        2,
        b"standard output: RS805 no space left on the disk\n",
    )


def test_a_reader_that_has_gone(tmp_path: Path) -> None:
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(
        [sys.executable, "-m", "rebsync", "fmt", "-"],
        input=b"main { }\n",
        stdout=write,
        stderr=subprocess.PIPE,
        env=environment(),
        check=False,
    )
    os.close(write)
    assert (done.returncode, done.stderr) == (Status.BROKEN_PIPE, b"")


def test_an_interrupt(tmp_path: Path) -> None:
    process = subprocess.Popen(
        [sys.executable, "-c", _SLOW], env=environment(), stdout=-1, stderr=-1, stdin=-1
    )
    assert process.stdout
    assert process.stdout.readline() == b"ready\n"
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=20)
    assert (process.returncode, err.strip()) == (Status.INTERRUPTED, b"interrupted")


_SLOW = """
import sys
import rebsync.cli.fmt, rebsync.files
from rebsync.cli import main
def wait(path):
    print("ready", flush=True)
    sys.stdin.buffer.read()
rebsync.cli.fmt.read_source = wait
sys.exit(main(["fmt", "-"]))
"""


def test_any_encoding_of_the_terminal_will_do(tmp_path: Path) -> None:
    (tmp_path / "ä.rebeca").write_text("ö\n", encoding="utf-8")
    done = rebsync("lint", "ä.rebeca", cwd=tmp_path, env={"PYTHONIOENCODING": "ascii"})
    assert done.status == 1
    assert "\\xe4.rebeca:1:1: RS10" in done.out


def test_the_first_of_several_outcomes_counts() -> None:
    order = (Status.UNUSABLE, Status.VIOLATED, Status.UNDETERMINED, Status.FINDINGS, Status.CLEAN)
    for one, other in product(order, order):
        assert worst([one, other]) == min(one, other, key=order.index)
    assert worst([]) == Status.CLEAN


@pytest.mark.parametrize(
    ("severity", "status"),
    [(Severity.ERROR, 1), (Severity.WARNING, 1), (Severity.NOTE, 0)],
)
def test_errors_and_warnings_are_findings(severity: Severity, status: int) -> None:
    found = Diagnostic("RS501", Span(0, 0), "x", severity=severity)
    assert status_of([Findings(Source("a", ""), (found,))]) == status


@pytest.mark.parametrize(
    ("closed", "command", "status", "message"),
    [
        (">&-", "lint a.rebeca", 2, "standard output: RS806 it is closed"),
        (">&-", "--help", 2, "standard output: RS806 it is closed"),
        (">&-", "generate a.rebeca", 2, "standard output: RS806 it is closed"),
        ("<&-", "fmt -", 2, "-: RS806 standard input is closed"),
        (">&- 2>&-", "lint a.rebeca", 2, ""),
        ("2>&-", "generate missing", 2, ""),
    ],
)
def test_closed_streams(
    tmp_path: Path, closed: str, command: str, status: int, message: str
) -> None:
    (tmp_path / "a.rebeca").write_text("main { }\n")
    line = f'"{sys.executable}" -m rebsync {command} {closed}'
    done = subprocess.run(
        ["sh", "-c", line], cwd=tmp_path, env=environment(), capture_output=True, check=False
    )
    assert (done.returncode, done.stderr.decode().strip()) == (status, message)


def test_a_pipe_in_a_directory_is_no_model(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "a.rebeca")
    assert "RS811" in rebsync("lint", ".", cwd=tmp_path).out


@pytest.mark.parametrize("command", [["export", "--for", "rmc"], ["new", "--force"]], ids=str)
def test_the_input_is_not_overwritten_by_the_output(tmp_path: Path, command: list[str]) -> None:
    model = "@Robot reactiveclass R(2) { R() { } } main { R r():(); }\n"
    text = model if command[0] == "export" else "[robots.R]\n"
    (tmp_path / "a").write_text(text)
    (tmp_path / "link").symlink_to("a")
    for output in ("a", "./link"):
        done = rebsync(*command, "a", "-o", output, cwd=tmp_path)
        assert (done.status, "RS802" in done.err) == (2, True), done
    assert (tmp_path / "a").read_text() == text


def test_a_text_without_end_is_not_read_for_ever(tmp_path: Path) -> None:
    assert "/dev/zero: RS814 this is a device" in rebsync("lint", "/dev/zero", cwd=tmp_path).out
    line = f'head -c 70000000 /dev/zero | "{sys.executable}" -m rebsync lint /dev/stdin'
    done = subprocess.run(
        ["sh", "-c", line], cwd=tmp_path, env=environment(), capture_output=True, check=False
    )
    assert b"/dev/stdin: RS806 larger than 64 MiB" in done.stdout
