"""A search ends before the machine, or its container, has no memory left for it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.checker import exploration
from rebsync.checker.exploration import Limits
from rebsync.checker.memory import NO_MEMORY, is_scarce
from rebsync.checker.problem import Options
from rebsync.checker.verify import verify
from tests.checker.test_bounds import COUNTER, problem

GIB = 2**30
MACHINE = "MemTotal: {} kB\nMemFree: 0 kB\nMemAvailable: {} kB\n"


def _system(root: Path, left: int, group: str = "", **files: str) -> Path:
    """A system with 16 GiB; `files` are those of the control group of the process."""
    texts = {"proc/meminfo": MACHINE.format(16 * GIB // 1024, left // 1024)}
    texts["proc/self/cgroup"] = f"4:memory:/other\n0::/{group}\n"
    for name, text in files.items():
        texts[f"sys/fs/cgroup/{group}/memory.{name}"] = text
    for path, text in texts.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text, encoding="ascii")
    return root


@pytest.mark.parametrize(
    ("left", "used", "scarce"),
    [
        (8 * GIB, 8 * GIB, False),
        (2 * GIB, 14 * GIB, False),  # more than a tenth
        (GIB, 15 * GIB, True),
        (GIB, GIB // 2, False),  # others hold the rest
    ],
)
def test_what_is_left_of_the_machine(tmp_path: Path, left: int, used: int, scarce: bool) -> None:
    assert is_scarce(used, _system(tmp_path, left)) is scarce


@pytest.mark.parametrize("group", ["", "jobs/one"])
def test_what_is_left_of_a_control_group(tmp_path: Path, group: str) -> None:
    files = {"max": f"{2 * GIB}\n", "stat": f"anon 1\ninactive_file {GIB}\n"}
    full = {**files, "current": f"{2 * GIB}\n"}
    assert not is_scarce(GIB, _system(tmp_path, 15 * GIB, group, **full))  # half of it is cache
    assert is_scarce(GIB, _system(tmp_path, 15 * GIB, group, **{**full, "stat": "anon 1\n"}))
    assert not is_scarce(GIB, _system(tmp_path, 15 * GIB, group, **{**full, "max": "max\n"}))


def test_a_system_that_tells_nothing(tmp_path: Path) -> None:
    assert not is_scarce(GIB, tmp_path)


@pytest.mark.parametrize("engine", ["interpreted", "compiled"])
def test_a_search_ends(engine: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A bound that was asked for counts alone."""
    monkeypatch.setattr(exploration, "is_scarce", lambda used: used > 0)
    endless, states = problem(COUNTER.replace("% 5", "")), 20_000_000
    for limits in (Limits(states), Limits(states, seconds=0.5, memory=2**40)):
        found = verify(endless, Options(engine=engine, limits=limits))  # type: ignore[arg-type]
        assert found.verdict == "undetermined"
        assert (found.reason == NO_MEMORY) is (limits.memory is None)
