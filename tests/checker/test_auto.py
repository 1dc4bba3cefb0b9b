"""Which engine searches when that is left open."""

from __future__ import annotations

import shutil
import subprocess
import time
from pathlib import Path

import pytest

from rebsync.checker import engines
from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.engines import explore
from rebsync.checker.exploration import Exploration
from rebsync.checker.problem import Options
from rebsync.checker.program import Program
from rebsync.checker.symmetry import Symmetry
from tests.checker.comparing import System

pytestmark = pytest.mark.skipif(
    not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler"
)
WALKER = """\
reactiveclass Walker(3) {
    statevars { int at; }
    Walker() { self.walk(); }
    msgsrv walk() { at = (at + ?(1, 3)) % 32; self.walk() after(?(1, 2)); }
}
main { Walker left():(); Walker right():(); }
"""
ENDLESS = 1e9


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Program:
    """A model that the interpreter needs half a second for, and a cache without it."""
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path))
    monkeypatch.setattr(engines, "GLANCE", 0)
    return System.of(WALKER, "").program


def _explored(program: Program) -> Exploration:
    return explore(program, "ftts", (), (), Symmetry(), Options())[1]


def test_what_was_compiled_before_is_taken_at_once(
    program: Program, monkeypatch: pytest.MonkeyPatch
) -> None:
    CompiledSearch(program, "tts")
    monkeypatch.setattr(engines, "PATIENCE", ENDLESS)
    monkeypatch.setattr(subprocess, "Popen", None)  # compiles nothing any more
    found = _explored(program)
    assert (found.engine, found.reason) == ("compiled", None)


def test_a_tiny_search_looks_for_nothing(program: Program, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engines, "GLANCE", ENDLESS)
    monkeypatch.setattr(engines, "_compiled", None)
    assert _explored(program).engine == "interpreted"


def test_what_was_not_compiled_before_waits_for_its_turn(
    program: Program, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(engines, "PATIENCE", ENDLESS)
    monkeypatch.setattr(subprocess, "Popen", None)
    assert _explored(program).engine == "interpreted"


def test_a_compiler_that_hangs_holds_nothing_up(
    program: Program, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compiler = tmp_path / "compiler"
    compiler.write_text(f"#!/bin/sh\necho $$ > {tmp_path}/group\nsleep 100\n")
    compiler.chmod(0o755)
    monkeypatch.setenv("CC", str(compiler))
    monkeypatch.setattr(engines, "PATIENCE", 0)
    started = time.monotonic()
    found = _explored(program)
    assert (found.engine, found.reason, found.notes) == ("interpreted", None, ())
    assert time.monotonic() - started < 50
    assert (tmp_path / "group").exists()
