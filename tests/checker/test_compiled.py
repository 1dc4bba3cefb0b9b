"""The compiled engine: bounds, large states, and bodies that do not end."""

from __future__ import annotations

import shutil
import subprocess
import sys
from dataclasses import astuple, replace
from pathlib import Path

import pytest

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Exploration, Limits, Progress
from rebsync.checker.program import Program
from rebsync.checker.search import Interpreted
from rebsync.checker.steps import Semantics
from tests.checker.comparing import System

pytestmark = pytest.mark.skipif(
    not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler"
)

_VIEWS: tuple[Semantics, ...] = ("tts", "ftts")

WALKERS = """\
reactiveclass Walker(5) {
    statevars { int at; boolean odd; }
    msgsrv walk(int steps) {
        at = (at + steps) % %SIZE%;
        odd = at % 2 == 1;
        self.walk(?(1, 3)) after(?(1, 2));
    }
    Walker() { self.walk(1); }
}
main {
%MAIN%
}
"""
PROPERTIES = "property { define { odd = w0.odd; } Assertion { small: w0.at < 3; even: !odd; } }"


def _walkers(count: int, size: int) -> System:
    main = "\n".join(f"    Walker w{i}():();" for i in range(count))
    return System.of(WALKERS.replace("%SIZE%", str(size)).replace("%MAIN%", main), PROPERTIES)


def _program(count: int = 2, size: int = 5) -> Program:
    return _walkers(count, size).program


def _figures(found: Exploration) -> tuple[object, ...]:
    return astuple(replace(found, engine="", seconds=0.0, build_seconds=0.0, memory=0, notes=()))


def test_it_finds_what_the_interpreter_finds() -> None:
    program = _program()
    for view in _VIEWS:
        search, interpreted = (
            engine(program, view, (0, 1)) for engine in (CompiledSearch, Interpreted)
        )
        found = interpreted.run(Limits())
        assert len(found.events) == 2
        assert _figures(search.run(Limits())) == _figures(found)
        assert search.graph() == interpreted.graph()


# --- bounds --------------------------------------------------------------------------------------


@pytest.mark.parametrize("limits", [Limits(states=17), Limits(until=5), Limits(states=50, until=4)])
@pytest.mark.parametrize("compacted", [False, True])
def test_bounds_cut_where_the_interpreter_is_cut(limits: Limits, compacted: bool) -> None:
    program = _program()
    compiled = CompiledSearch(program, "ftts", (0, 1), hash_compaction=compacted)
    interpreted = Interpreted(program, "ftts", (0, 1))
    found = interpreted.run(limits)
    assert found.reason
    assert _figures(compiled.run(limits)) == _figures(found)
    assert compiled.graph() == interpreted.graph()
    assert [compiled.path(s) for s in range(found.states)] == [
        interpreted.path(s) for s in range(found.states)
    ]


def test_a_search_goes_on() -> None:
    program = _program()
    pieces, whole = CompiledSearch(program, "ftts"), CompiledSearch(program, "ftts")
    for states in range(3, 40, 7):
        assert (
            pieces.run(Limits(states=states)).reason == f"the bound of {states} states was reached"
        )
    assert _figures(pieces.run(Limits())) == _figures(whole.run(Limits()))
    with pytest.raises(ValueError, match="bound of time"):
        pieces.run(Limits(until=3))


def test_seconds_memory_and_progress() -> None:
    seen: list[Progress] = []
    search = CompiledSearch(_program(8, 40), "ftts")
    assert (
        search.run(Limits(seconds=0.1), seen.append).reason
        == "the bound of 0.1 seconds was reached"
    )
    assert search.run(Limits(memory=1)).reason == "the bound of 1 bytes of memory was reached"
    assert seen[0].states > seen[0].waiting > 0
    assert seen[0].memory > 0
    assert seen[-1].transitions >= seen[0].transitions > 0


def test_an_interrupt_ends_it_cleanly() -> None:
    def interrupt(_: Progress) -> None:
        raise KeyboardInterrupt

    search = CompiledSearch(_program(8, 40), "ftts")
    found = search.run(Limits(), interrupt)
    assert found.reason == "it was interrupted"
    assert len(search.path(found.states - 1)) == found.depth + 1


def test_many_rebecs_and_wide_states() -> None:
    """More than one word for a state, and numbers that outgrow their fields."""
    search, interpreted = (
        engine(_program(70, 3), "tts", (0,)) for engine in (CompiledSearch, Interpreted)
    )
    assert _figures(search.run(Limits(states=300))) == _figures(interpreted.run(Limits(states=300)))
    many = CompiledSearch(_program(3, 150), "ftts")
    compacted = CompiledSearch(_program(3, 150), "ftts", hash_compaction=True)
    found = many.run(Limits(states=60_000))
    again = compacted.run(Limits(states=60_000))
    assert _figures(found) == _figures(again)
    assert many.path(found.states - 1) == compacted.path(found.states - 1)
    assert "64 bits of each state" in again.notes[0]
    assert f"{5 * again.states**2 / 2**65:.1e}" in again.notes[0]  # three rebecs


@pytest.mark.parametrize("compacted", [False, True])
def test_states_that_outgrow_their_words(compacted: bool) -> None:
    """Sixteen rebecs have 4 bits each at first; when they count on, all states move."""
    text = WALKERS.replace("?(1, 3)", "1").replace("?(1, 2)", "1").replace("%SIZE%", "300")
    main = "\n".join(f"    @priority({i}) Walker w{i}():();" for i in range(16))
    program = System.of(text.replace("%MAIN%", main)).program
    search = CompiledSearch(program, "ftts", hash_compaction=compacted)
    interpreted = Interpreted(program, "ftts")
    found = interpreted.run(Limits())
    assert found.states > 16 * 256
    assert _figures(search.run(Limits())) == _figures(found)
    for state in range(0, found.states, 500):
        assert search.path(state) == interpreted.path(state)
    assert search.graph() == interpreted.graph()


# --- memory --------------------------------------------------------------------------------------


def test_a_bag_takes_memory_only_for_what_is_in_it() -> None:
    program = System.of(
        WALKERS.replace("Walker(5)", "Walker(2000000000)")
        .replace("%SIZE%", "5")
        .replace("%MAIN%", "Walker w0():();")
    ).program
    search, interpreted = CompiledSearch(program, "tts"), Interpreted(program, "tts")
    assert _figures(search.run(Limits())) == _figures(interpreted.run(Limits()))


_LITTLE_MEMORY = """\
import resource, sys
from pathlib import Path
from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Limits
from tests.checker.test_compiled import _walkers
search = CompiledSearch(_walkers(4, 400).program, "ftts", (0,), threads=int(sys.argv[2]))
search.run(Limits(states=100))
paths = [search.path(state) for state in range(100)]
held = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
most = held + int(sys.argv[1]) * 2**20
resource.setrlimit(resource.RLIMIT_AS, (most, most))
for _ in range(2):
    found = search.run(Limits())
    assert found.reason == "there was no more memory", found
assert found.states > 1000, found
assert found.events
assert [search.path(state) for state in range(100)] == paths
assert len(search.path(found.states - 1)) > found.depth
"""


@pytest.mark.skipif(sys.platform != "linux", reason="memory is bounded as Linux does")
@pytest.mark.parametrize("more", [20, 30, 40])  # so that it ends in different places
@pytest.mark.parametrize("threads", [1, 2])
def test_without_memory_it_tells_what_it_has_found(more: int, threads: int) -> None:
    command = [sys.executable, "-c", _LITTLE_MEMORY, str(more), str(threads)]
    subprocess.run(command, cwd=Path(__file__).parents[2], check=True, timeout=60)


def test_the_interpreter_without_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    search = Interpreted(_program(), "ftts", (0,))
    found = search.run(Limits(states=20))
    monkeypatch.setattr(Interpreted, "_expand", _out_of_memory)
    again = search.run(Limits())
    assert again.reason == "there was no more memory"
    assert _figures(replace(again, reason=None)) == _figures(replace(found, reason=None))


def _out_of_memory(*_: object) -> None:
    raise MemoryError
