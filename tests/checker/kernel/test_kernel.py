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
COMPILER = shlex.split(os.environ.get("CC", "")) or ["cc"]

pytestmark = pytest.mark.skipif(not shutil.which(COMPILER[0]), reason="no C compiler")


def _built(model: str, folder: Path, *more: str) -> Path:
    source, program = folder / "model.c", folder / "shards"
    source.write_text(ModelText(read(model).program).render(), encoding="utf-8")
    made = (str(source), str(_HERE / "shards.c"), "-o", str(program), "-lm")
    subprocess.run((*COMPILER, *_FLAGS, *more, *made), check=True)
    return program


def _run(program: Path, view: str) -> tuple[int, ...]:
    out = subprocess.run([program, view], check=True, capture_output=True, text=True).stdout
    return tuple(map(int, out.split()))


@rows
def test_kernels_that_share_states_find_what_one_finds(row: Expected, tmp_path: Path) -> None:
    states, transitions, failures = _run(_built(row.model, tmp_path), row.view)
    assert (states, transitions) == (row.states, row.transitions)
    kinds = {each.split()[0] for each in row.violations} - {"property", "deadlock", "zeno"}
    assert bool(failures) == bool(kinds)


def test_it_stays_within_its_memory(tmp_path: Path) -> None:
    """What a step leaves behind is freed, and nothing is read beyond its end."""
    probe = tmp_path / "probe.c"
    probe.write_text("int main(void) { return 0; }\n", encoding="utf-8")
    command = (*COMPILER, *_SANITIZED, str(probe), "-o", str(tmp_path / "probe"))
    if subprocess.run(command, check=False, capture_output=True).returncode:
        pytest.skip("no sanitizers")
    program = _built("light", tmp_path, *_SANITIZED)
    assert _run(program, "ftts")[:2] == _run(_built("light", tmp_path), "ftts")[:2]
