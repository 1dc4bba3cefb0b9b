"""Fingerprints alone: what waits on the disk, steps in a byte, and what all that takes."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from dataclasses import astuple, replace
from pathlib import Path
from unittest import mock

import pytest

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Exploration, Limits
from tests.checker.comparing import System
from tests.checker.test_compiled import _walkers

_COMPILERS = tuple(filter(None, map(shutil.which, ("cc", "gcc", "clang"))))
_ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.skipif(not _COMPILERS, reason="no C compiler")


def _figures(found: Exploration) -> tuple[object, ...]:
    return astuple(replace(found, seconds=0.0, build_seconds=0.0, memory=0, notes=()))


@pytest.mark.parametrize(
    ("walkers", "size", "limits"),
    [(3, 8, Limits()), (3, 8, Limits(until=40)), (30, 20, Limits(states=20_000))],
)
def test_states_that_wait_on_the_disk(walkers: int, size: int, limits: Limits) -> None:
    """With little room most states wait there, in many chunks, and local states are given up.

    Thirty walkers have few bits each for their local states, which outgrow these.
    """
    program = _walkers(walkers, size).program
    exact = CompiledSearch(program, "ftts")
    found = exact.run(limits)
    little = {"CC": f"{os.environ.get('CC') or _COMPILERS[0]} -DLITTLE_ROOM"}
    with mock.patch.dict(os.environ, little):
        compacted = CompiledSearch(program, "ftts", hash_compaction=True)
    assert _figures(compacted.run(limits)) == _figures(found)
    assert found.states > 1000
    for state in range(0, found.states, 1 + found.states // 100):
        assert compacted.path(state) == exact.path(state)


_TREE = """\
reactiveclass Tree(3) {
  knownrebecs { Ticker ticker; }
  statevars { int n; }
  Tree() { self.grow(0); }
  msgsrv grow(int depth) {
    n = n * 2 + ?(0, 1);
    if (depth < 7) { self.grow(depth + 1) after(1); } else { ticker.tick(6) after(1); }
  }
}
reactiveclass Ticker(3) {
  msgsrv tick(int left) { if (left > 0) { self.tick(left - 1) after(1); } }
}
reactiveclass Idle(1) { }
main { Tree tree(ticker):(); Ticker ticker():(); %IDLE% }
"""


def test_local_states_outgrow_their_bits_when_they_are_read_from_the_disk() -> None:
    """No step makes one then: all states of the tree wait, and what they are made of was given up.

    Each idle rebec takes two bits; with 58 of them few are left over for the tree.
    """
    idle = " ".join(f"Idle i{i}():();" for i in range(58))
    program = System.of(_TREE.replace("%IDLE%", idle)).program
    exact = CompiledSearch(program, "ftts").run(Limits())
    little = {"CC": f"{os.environ.get('CC') or _COMPILERS[0]} -DLITTLE_ROOM"}
    with mock.patch.dict(os.environ, little):
        compacted = CompiledSearch(program, "ftts", hash_compaction=True)
    assert _figures(compacted.run(Limits())) == _figures(exact)


_FULL_DISK = """\
import resource, signal, sys
from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Limits
from tests.checker.test_compiled import _walkers
search = CompiledSearch(_walkers(3, 8).program, "ftts", hash_compaction=True)
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (16384, 16384))
found = search.run(Limits())
assert found.reason == "there was no more memory", found
assert found.states > 30, found
"""


@pytest.mark.skipif(sys.platform != "linux", reason="files are bounded as Linux does")
def test_a_full_disk_ends_the_search() -> None:
    environment = {**os.environ, "CC": f"{os.environ.get('CC') or _COMPILERS[0]} -DLITTLE_ROOM"}
    command = [sys.executable, "-c", _FULL_DISK]
    subprocess.run(command, cwd=_ROOT, env=environment, check=True, timeout=120)


_LITTLE_MEMORY = """\
import resource
from pathlib import Path
from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Limits
from tests.checker.test_compiled import _walkers
program = _walkers(4, 400).program
exact = CompiledSearch(program, "ftts", (0,))
exact.run(Limits(states=1000))
held = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (held + 20 * 2**20,) * 2)
search = CompiledSearch(program, "ftts", (0,), hash_compaction=True)
for _ in range(2):
    found = search.run(Limits())
    assert found.reason == "there was no more memory", found
assert found.states > 100_000, found
assert found.events
assert [search.path(state) for state in range(1000)] == [exact.path(state) for state in range(1000)]
assert len(search.path(found.states - 1)) > found.depth
"""


@pytest.mark.skipif(sys.platform != "linux", reason="memory is bounded as Linux does")
def test_without_memory_it_tells_what_it_has_found() -> None:
    command = [sys.executable, "-c", _LITTLE_MEMORY]
    subprocess.run(command, cwd=_ROOT, check=True, timeout=120)


def _growth(engine: str) -> int:
    """Bytes that a search of 348,000 states with floats adds to its process."""
    script, model = _ROOT / "bench" / "searching.py", _ROOT / "bench" / "models" / "ttc.rebeca"
    command = [sys.executable, str(script), engine, "timed", str(model), "rounds=10"]
    output = subprocess.run(command, cwd=_ROOT, check=True, capture_output=True, timeout=120)
    return int(json.loads(output.stdout)["growth"])


@pytest.mark.skipif(sys.platform != "linux", reason="memory is counted as Linux does")
def test_memory_of_states_that_are_all_different() -> None:
    assert 6 * _growth("compacted") < _growth("compiled")
