"""`rebsync export --for pins`: a host takes the module, and walks what `verify` walks."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from collections import defaultdict
from functools import partial
from pathlib import Path

import pytest

from rebsync.checker.pins import pins_module
from rebsync.checker.problem import Problem
from rebsync.checker.steps import Semantics
from tests.checker.comparing import System
from tests.checker.test_models import Expected, read, rows
from tests.cli.run import rebsync

_HOST = Path(__file__).parent / "pins"
COMPILER = shlex.split(os.environ.get("CC", "")) or ["cc"]

pytestmark = pytest.mark.skipif(not shutil.which(COMPILER[0]), reason="no C compiler")


@pytest.fixture(scope="session")
def host(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The host, with what modules take from it."""
    program = tmp_path_factory.mktemp("host") / "host"
    flags = ("-O1", "-rdynamic", f"-I{_HOST}", str(_HOST / "host.c"), "-ldl")
    subprocess.run((*COMPILER, *flags, "-o", str(program)), check=True)
    return program


def _module(text: str, folder: Path) -> Path:
    source, library = folder / "model.c", folder / "model.so"
    source.write_text(text, encoding="utf-8")
    flags = ("-std=gnu11", "-O0", "-w", "-fPIC", "-shared", "-ffp-contract=off", f"-I{_HOST}")
    subprocess.run((*COMPILER, *flags, str(source), "-o", str(library), "-lm"), check=True)
    return library


def _walked(host: Path, library: Path) -> subprocess.CompletedProcess[str]:
    command = (host, library, "5000")
    return subprocess.run(command, check=False, capture_output=True, text=True)


def _of(system: System, view: Semantics) -> str:
    return pins_module(Problem(system.source, system.analysis, system.properties), view)


def _told(host: Path, library: Path) -> dict[str, set[tuple[str, ...]]]:
    done = _walked(host, library)
    assert done.returncode == 0, done.stderr
    told = defaultdict[str, set[tuple[str, ...]]](set)
    for kind, *rest in map(str.split, done.stdout.splitlines()):
        told[kind].add(tuple(rest))
    return told


@rows
def test_the_host_walks_what_verify_does(row: Expected, host: Path, tmp_path: Path) -> None:
    system = read(row.model)
    told = _told(host, _module(_of(system, row.view), tmp_path))
    assert told["states"] == {(str(row.states),)}
    assert told["transitions"] == {(str(row.transitions),)}
    kinds = {violation.split()[0] for violation in row.violations}
    assert {kind for (kind,) in told["fails"]} == kinds - {"property", "deadlock", "zeno"}
    assert (told["deadlocks"] != {("0",)}) == ("deadlock" in kinds)
    holds = {name: states for name, states in told["label"]}  # noqa: C416 - pairs, for mypy
    asserted = {each.name for each in system.properties.assertions}
    false = {f"property {name}" for name in asserted if holds[name] != str(row.states)}
    assert false == {v for v in row.violations if v.removeprefix("property ") in asserted}


def test_labels_are_what_is_true_or_false(host: Path, tmp_path: Path) -> None:
    """One may be called as a slot of the state is."""
    model = """\
reactiveclass R(2) {
    statevars { int at; int status; }
    R() { self.go(); }
    msgsrv go() { at = ?(1, 2, 3); assertion(at != 3); }
}
main { R status():(); }
"""
    properties = "property { define { status = status.at == 2; size = status.at; } }"
    text = _of(System.of(model, properties), "ftts")
    assert '#define STATUS "status_"' in text
    told = _told(host, _module(text, tmp_path))
    assert told["states"] == {("3",)}
    assert told["transitions"] == {("3",)}
    assert told["fails"] == {("assertion",)}
    assert told["deadlocks"] == {("2",)}
    assert told["label"] == {("status", "1")}  # not `size`, which is a number


@pytest.mark.parametrize(
    ("statement", "define", "said"),
    [
        ("while (true) { at = at + 0; }", "true", "a body does not end"),
        ("at = 0;", "1 / r.at == 1", "a property divides by zero"),
    ],
)
def test_what_cannot_be_finished_ends_the_tool(
    statement: str, define: str, said: str, host: Path, tmp_path: Path
) -> None:
    """No count and no label is given that might be wrong."""
    model = f"""\
reactiveclass R(2) {{
    statevars {{ int at; }}
    R() {{ at = 1; self.go(); }}
    msgsrv go() {{ {statement} }}
}}
main {{ R r():(); }}
"""
    system = System.of(model, f"property {{ define {{ d = {define}; }} }}")
    done = _walked(host, _module(_of(system, "ftts"), tmp_path))
    assert done.returncode == 255
    assert said in done.stderr


def test_the_command_writes_one_file_that_includes_none_of_ours(tmp_path: Path) -> None:
    model = tmp_path / "a b.rebeca"
    model.write_text("reactiveclass R(2) { R() { } }\nmain { R r():(); }\n", encoding="utf-8")
    export = partial(rebsync, "export", str(model), "--for", "pins", cwd=tmp_path)
    done = export("--semantics", "tts")
    assert (done.status, done.err) == (0, "")
    assert '#include "' not in done.out
    assert 'char pins_plugin_name[] = "a b.rebeca";' in done.out
    assert "#define SEMANTICS TTS\n" in done.out
    assert "#define SEMANTICS CORE\n" in export("--language", "core").out


def test_rmc_takes_none_of_the_options(tmp_path: Path) -> None:
    model = tmp_path / "m.rebeca"
    model.write_text("reactiveclass R(2) { R() { } }\nmain { R r():(); }\n", encoding="utf-8")
    done = rebsync("export", str(model), "--for", "rmc", "--semantics", "tts", cwd=tmp_path)
    assert done.status == 2
    assert "--semantics is for --for pins" in done.err
