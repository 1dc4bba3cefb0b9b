"""How long `rebsync check` takes, by the clock and by the processor.

    python bench/check.py [--packages N] [--cold N] [--robots N] [--profile]

Packages are copies of the examples. `click` is `python -c 'import click'`, the floor for every
command; `ratio` is the time against that. `in step` is answered from digests; `first edit` has
nothing in the cache but the grammars; `next edit` has the package as it was before the edit in the
cache; `as before` is the same package once more. `robots` are the same for a package of that many
classes, each in files of its own, of which one is edited. `cold` are packages that were all edited,
with an empty cache, on one processor and on all. Each time is the least of some runs, of whole
processes.
"""

from __future__ import annotations

import argparse
import cProfile
import io
import os
import pstats
import resource
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from fleet import fleet

EXAMPLES = Path(__file__).parent.parent / "examples"
CHECK = (sys.executable, "-m", "rebsync", "check")


@dataclass(frozen=True)
class Time:
    """Seconds by the clock, and of all processors."""

    clock: float
    work: float

    def __str__(self) -> str:
        return f"{self.clock:7.3f} s, processors {self.work:7.3f} s"


def main() -> None:
    options = _options()
    with tempfile.TemporaryDirectory() as folder:
        os.environ["REBSYNC_CACHE"] = f"{folder}/cache"
        click = best(lambda: run(sys.executable, "-c", "import click"), 5)
        print(f"click              {click}")
        shutil.copytree(EXAMPLES / "warehouse", f"{folder}/one")
        one(Path(folder, "one"), "warehouse/src/carrier.cpp", click)
        print(f"{options.robots} robots, each of a class of its own")
        robots(Path(folder, "robots"), options.robots)
        one(Path(folder, "robots"), "fleet/src/robot1.cpp", click)
        many = made(Path(folder, "many"), options.packages)
        told(f"{options.packages} in step", best(lambda: run(*CHECK, str(many))), click)
        cold(made(Path(folder, "cold"), options.cold), options.cold, click)
        if options.profile:
            profile(many)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--packages", type=int, default=200, metavar="N")
    parser.add_argument("--cold", type=int, default=24, metavar="N")
    parser.add_argument("--robots", type=int, default=20, metavar="N")
    parser.add_argument("--profile", action="store_true")
    return parser.parse_args()


def one(folder: Path, name: str, click: Time) -> None:
    """A package of some size, before and after edits of one file."""
    file = folder / name
    check = (*CHECK, str(folder))
    told("in step", best(lambda: run(*check), 5), click)
    edit(file)
    run(*check)  # the grammars are compiled and kept
    forget()
    told("first edit", run(*check), click)
    told("as before", best(lambda: run(*check)), click)
    told("next edit", best(lambda: run(*check), before=lambda: edit(file)), click)


def robots(folder: Path, count: int) -> None:
    """A package of a control and as many robots, each of a class of its own."""
    folder.mkdir()
    (folder / "fleet.rebeca").write_text(fleet(count), encoding="utf-8")
    generate = (sys.executable, "-m", "rebsync", "generate", "fleet.rebeca")
    subprocess.run(generate, cwd=folder, stdout=subprocess.DEVNULL, check=True)


def cold(folder: Path, count: int, click: Time) -> None:
    """Packages of which none was read before."""
    for file in folder.glob("*/*/src/*.cpp"):
        edit(file)
    check = (*CHECK, str(folder))
    every = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(every)})
    told(f"{count} cold, one", best(lambda: run(*check), 2, forget), click)
    os.sched_setaffinity(0, every)
    told(f"{count} cold, all", best(lambda: run(*check), 2, forget), click)


def forget() -> None:
    """Empties the cache, but for the grammars."""
    for room in ("records", "values"):
        shutil.rmtree(Path(os.environ["REBSYNC_CACHE"], room), ignore_errors=True)


def edit(file: Path) -> None:
    """Makes another text of a file that says the same."""
    file.write_text(file.read_text(encoding="utf-8") + "// once more\n", encoding="utf-8")


def made(folder: Path, count: int) -> Path:
    """Copies of the examples in turn, each with its model in a directory of its own."""
    examples = sorted(EXAMPLES.iterdir())
    for number in range(count):
        shutil.copytree(examples[number % len(examples)], folder / f"p{number:04}")
    return folder


# --- measuring ----------------------------------------------------------------------------------


def run(*command: str) -> Time:
    """One process to its end."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = perf_counter()
    done = subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
    clock = perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 1):
        raise SystemExit(f"{' '.join(command)} ends with {done.returncode}")
    work = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Time(clock, work)


def best(
    what: Callable[[], Time], runs: int = 3, before: Callable[[], object] = lambda: None
) -> Time:
    """The least of some runs: other work disturbs that least."""
    found = []
    for _ in range(runs):
        before()
        found.append(what())
    return Time(min(t.clock for t in found), min(t.work for t in found))


def told(name: str, time: Time, click: Time) -> None:
    ratios = f"{time.clock / click.clock:6.2f}, {time.work / click.work:6.2f}"
    print(f"{name:18} {time}  ratio {ratios}")


def profile(folder: Path) -> None:
    """Prints where the time goes when all is in step."""
    from rebsync.cli import main as command

    profiler = cProfile.Profile()
    with redirect_stdout(io.StringIO()):
        profiler.runcall(command, ["check", str(folder)])
    pstats.Stats(profiler, stream=sys.stdout).sort_stats("tottime").print_stats(30)


if __name__ == "__main__":
    main()
