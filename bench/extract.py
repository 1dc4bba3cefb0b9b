"""How long extraction takes, against what the parser alone needs for the same files.

    python bench/extract.py [DIRECTORY] [--size MB] [--packages N] [--profile]

Without a directory, packages are made whose code has so many megabytes (default 2.3, the size of
ros_comm) and is mixed as there. `bare` is tree-sitter's parse of all files, without looking at the
trees; `one process` is listing, reading and extracting all packages in turn, `ratio` the one over
the other; both are seconds of the processor, the least of five rounds in which they take turns, so
that a machine that is slower for a while slows both. `all processors` is the same as a command does
it, by the clock. Files of C++ and of Python are measured apart from each other, in copies of the
directory without the code of the other: both with what builds and launches them.
`--packages` makes N small packages and prints the memory on the way. Peak memory is that of the
largest process.
"""

from __future__ import annotations

import argparse
import cProfile
import gc
import os
import pstats
import resource
import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter, process_time

import tree_sitter_cpp
import tree_sitter_python
from ros_packages import write_packages
from tree_sitter import Language, Parser

from rebsync.reverse.files.packages import CODE, suffix_of
from rebsync.reverse.files.parallel import each
from rebsync.reverse.files.python_files import SUFFIX, is_script
from rebsync.reverse.files.reading import Chosen, all_listings, packages
from rebsync.reverse.recovery import extract
from rebsync.source import Source


def main() -> None:
    options = _options()
    gc.disable()  # as the command line does
    with tempfile.TemporaryDirectory() as made:
        if options.packages:
            write_packages(Path(made), options.packages, libraries=1)
            watch_memory(made, options.packages)
            return
        root = options.directory
        if root is None:
            root, size = made, 0
            while size < options.size * 1e6:
                size += write_packages(Path(made) / str(size), 4, seed=size)
        compare(root)
        if options.profile:
            profile(root)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("directory", nargs="?")
    parser.add_argument("--size", type=float, default=2.3, metavar="MB")
    parser.add_argument("--packages", type=int, default=0, metavar="N")
    parser.add_argument("--profile", action="store_true")
    return parser.parse_args()


# --- speed --------------------------------------------------------------------------------------


def compare(root: str) -> None:
    """Prints times, speeds and their ratio."""
    for language in ("C++", "Python"):
        with tempfile.TemporaryDirectory() as made:
            copy_language(root, Path(made), language)
            compare_language(made, language)
    print(f"peak memory {peak():.0f} MB")


def copy_language(root: str, to: Path, language: str) -> None:
    """Copies what is read of a directory, but for the code of other languages than this."""
    for listing in all_listings([root]):
        package = to / os.path.relpath(listing.root, root)
        for name, path in listing.files.items():
            if language_of(path) in (language, ""):
                there = package / name
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(path, there)


def language_of(path: str) -> str:
    """The language of a file, empty where it is no code."""
    suffix = suffix_of(path)
    if suffix in CODE:
        return "C++"
    is_python = suffix == SUFFIX or (not suffix and is_script(Path(path).read_bytes()))
    return "Python" if is_python else ""


def compare_language(root: str, language: str) -> None:
    """Prints the same of the files of one language."""
    # First, as processes are copies of this one, which a command has not read anything in yet.
    every = best(lambda: list(each(all_listings([root]), work)), perf_counter)
    paths = (path for listing in all_listings([root]) for path in listing.files.values())
    texts = [Path(path).read_bytes() for path in paths if language_of(path) == language]
    if not texts:
        return
    bare, alone = alternately(
        lambda: parse_all(texts, language), lambda: [work(given) for given in packages([root])]
    )
    size = sum(map(len, texts)) / 1e6
    read = sum(_size(given.files) for given in packages([root])) / 1e6
    print(f"{language}: {len(texts)} files, {size:.2f} MB, of which {read:.2f} MB can matter")
    for name, seconds in (("bare", bare), ("one process", alone), ("all processors", every)):
        print(f"{name:15}{seconds:8.3f} s{size / seconds:8.2f} MB/s  ratio {seconds / bare:.2f}")


def best(
    what: Callable[[], object], clock: Callable[[], float] = process_time, runs: int = 3
) -> float:
    """Seconds, the least of some runs: of the processor, which other work disturbs less."""
    return min(_seconds(what, clock) for _ in range(runs))


def alternately(*whats: Callable[[], object], rounds: int = 5) -> list[float]:
    """Seconds of the processor for each of several, the least of some rounds of them all."""
    found = [[_seconds(what, process_time) for what in whats] for _ in range(rounds)]
    return [min(times) for times in zip(*found, strict=True)]


def _seconds(what: Callable[[], object], clock: Callable[[], float]) -> float:
    gc.collect()
    start = clock()
    what()
    return clock() - start


def parse_all(texts: list[bytes], language: str) -> None:
    """What tree-sitter alone does."""
    grammar = tree_sitter_cpp if language == "C++" else tree_sitter_python
    parser = Parser(Language(grammar.language()))
    for text in texts:
        parser.parse(text)


def work(given: Chosen) -> tuple[int, int, float]:
    """What is done with a package: the process, its memory now and the classes found."""
    found = extract(given.files, given.only)
    return os.getpid(), len(found.model.classes), memory()


def _size(files: dict[str, Source]) -> int:
    return sum(len(s.text) for path, s in files.items() if suffix_of(path) in {*CODE, SUFFIX})


def profile(root: str) -> None:
    """Prints where the time goes."""
    profiler = cProfile.Profile()
    profiler.runcall(lambda: [work(given) for given in packages([root])])
    pstats.Stats(profiler, stream=sys.stdout).sort_stats("tottime").print_stats(40)


# --- memory -------------------------------------------------------------------------------------


def watch_memory(root: str, count: int) -> None:
    """Prints the memory after a tenth, a half and all of the packages."""
    start = perf_counter()
    largest: dict[int, float] = {}
    marks = {max(1, round(count * share)): share for share in (0.1, 0.5, 1.0)}
    for number, (process, _, used) in enumerate(each(all_listings([root]), work), 1):
        largest[process] = used
        if number in marks:
            others = " ".join(f"{m:.0f}" for p, m in largest.items() if p != os.getpid())
            print(
                f"{marks[number]:4.0%} {number:6} packages {perf_counter() - start:7.1f} s"
                f"  memory {memory():.0f} MB, of the others {others or '-'} MB"
            )


def memory() -> float:
    """Megabytes that this process holds now."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * resource.getpagesize() / 1e6


def peak() -> float:
    """Megabytes that the largest process has held."""
    who = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    return max(resource.getrusage(w).ru_maxrss for w in who) / 1e3


if __name__ == "__main__":
    main()
