"""Runs commands, and tells what they cost."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parent.parent
MODELS = ROOT / "bench" / "models"
MEGABYTE = 1 << 20


@dataclass(frozen=True, slots=True)
class Run:
    """A command that has ended: `peak` is in bytes, `cpu` counts all its processes."""

    output: str
    seconds: float
    cpu: float
    peak: int


def run(command: Sequence[str | Path], cache: Path | None = None, status: int = 0) -> Run:
    """Runs a command on the package of this checkout, and with a cache of its own if given.

    Ends the bench when the command ends with another exit status.
    The peak is that of the largest of its processes. This process must stay small: a child
    counts the memory of its parent from before it was replaced.
    """
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed package has its bytecode
    if cache is not None:
        environment["REBSYNC_CACHE"] = str(cache)
    with tempfile.TemporaryFile("w+", encoding="utf-8") as output:
        start = time.perf_counter()
        process = subprocess.Popen(list(map(str, command)), stdout=output, env=environment)
        _, ended, usage = os.wait4(process.pid, 0)
        seconds = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(ended)
        output.seek(0)
        text = output.read()
    if process.returncode != status:
        raise SystemExit(f"{' '.join(map(str, command))}: exit {process.returncode}\n{text}")
    unit = 1 if sys.platform == "darwin" else 1024
    return Run(text, seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * unit)


def rebsync(model: Path, *options: str) -> list[str | Path]:
    """The command line of `rebsync verify` with a result to read."""
    verify = (sys.executable, "-m", "rebsync", "verify", model, "--allow", "deadlock")
    return [*verify, "--format", "json", *options]


@dataclass(frozen=True, slots=True)
class Runs:
    """The same command several times."""

    runs: tuple[Run, ...]

    @property
    def output(self) -> str:
        return self.runs[-1].output

    @property
    def seconds(self) -> float:
        return median(r.seconds for r in self.runs)

    @property
    def best(self) -> float:
        return min(r.seconds for r in self.runs)

    @property
    def cpu(self) -> float:
        return median(r.cpu for r in self.runs)

    @property
    def peak(self) -> int:
        return max(r.peak for r in self.runs)


def repeat(times: int, once: Callable[[], Run]) -> Runs:
    return Runs(tuple(once() for _ in range(times)))


@dataclass(frozen=True, slots=True)
class Whole:
    """A whole command that searched, several times."""

    engine: str
    states: int
    transitions: int
    search: float
    runs: Runs

    def line(self, name: str) -> str:
        runs = self.runs
        return (
            f"{name:32}{self.states:11,}{self.states / self.search:11,.0f}{runs.seconds:9.2f}"
            f"{runs.best:8.2f}{runs.cpu:8.2f}{runs.peak / MEGABYTE:9.0f}"
            f"{runs.peak / self.states:13.0f}"
        )


HEADING = (
    f"{'command':32}     states   states/s   median    best     cpu  peak MB  bytes/state\n"
    f"{'':32}             (searching)        s       s       s  (process)"
)


def verified(
    model: Path, times: int, *options: str, cache: Path | None = None, status: int = 0
) -> Whole:
    """The command with this exit status, so many times."""
    runs = repeat(times, lambda: run(rebsync(model, *options), cache, status))
    result = json.loads(runs.output)
    counts = result["states"], result["transitions"]
    return Whole(result["engine"], *counts, result["search_seconds"], runs)
