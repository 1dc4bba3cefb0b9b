"""The kernel's interface in C, by a search that has nothing else, on every model of `models/`."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

from rebsync.checker import build
from rebsync.checker.compile_model import ModelText
from tests.checker.test_models import Expected, read, rows

_HERE, _TEMPLATES = Path(__file__).parent, Path(build.__file__).parent / "templates"
_FLAGS = ("-std=gnu11", "-O0", "-w", "-ffp-contract=off", "-I", str(_TEMPLATES), "-I", str(_HERE))
_SANITIZED = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
_RACES = ("-fsanitize=thread", "-O1", "-g", "-pthread", "-DLITTLE_ROOM")
COMPILER = shlex.split(os.environ.get("CC", "")) or ["cc"]

pytestmark = pytest.mark.skipif(not shutil.which(COMPILER[0]), reason="no C compiler")


def _built(model: str, folder: Path, *more: str, host: str = "shards") -> Path:
    source, program = folder / "model.c", folder / host
    source.write_text(ModelText(read(model).program).render(), encoding="utf-8")
    made = (str(source), str(_HERE / f"{host}.c"), "-o", str(program), "-lm")
    subprocess.run((*COMPILER, *_FLAGS, *more, *made), check=True)
    return program


def _run(program: Path, *arguments: str) -> tuple[int, ...]:
    out = subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout
    return tuple(map(int, out.split()))


@rows
def test_kernels_that_share_states_find_what_one_finds(row: Expected, tmp_path: Path) -> None:
    states, transitions, failures = _run(_built(row.model, tmp_path), row.view)
    assert (states, transitions) == (row.states, row.transitions)
    kinds = {each.split()[0] for each in row.violations} - {"property", "deadlock", "zeno"}
    assert bool(failures) == bool(kinds)


def test_it_stays_within_its_memory(tmp_path: Path) -> None:
    """What a step leaves behind is freed, and nothing is read beyond its end."""
    _need(tmp_path, *_SANITIZED)
    program = _built("light", tmp_path, *_SANITIZED)
    assert _run(program, "ftts")[:2] == _run(_built("light", tmp_path), "ftts")[:2]


@pytest.mark.parametrize(("model", "view"), [("light", "tts"), ("keep_last", "tts")])
def test_threads_do_not_race(model: str, view: str, tmp_path: Path) -> None:
    _need(tmp_path, *_RACES)
    alone = _run(_built(model, tmp_path, "-pthread", host="together"), view, "1")
    assert _run(_built(model, tmp_path, *_RACES, host="together"), view, "3") == alone


def _need(folder: Path, *options: str) -> None:
    """Skips the test if programs made so do not run here."""
    source, program = folder / "probe.c", folder / "probe"
    source.write_text("int main(void) { return 0; }\n", encoding="utf-8")
    made = subprocess.run(
        (*COMPILER, *options, str(source), "-o", str(program)), check=False, capture_output=True
    )
    if made.returncode or subprocess.run([program], check=False).returncode:
        pytest.skip(f"nothing can be made with {options[0]}")
