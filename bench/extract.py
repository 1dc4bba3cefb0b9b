"""How long extraction takes, against what the parser alone needs for the same files.

    python bench/extract.py [DIRECTORY] [--size MB] [--packages N] [--profile]

Without a directory, packages are made whose code has so many megabytes (default 2.3, the size of
ros_comm) and is mixed as there. `bare` is tree-sitter's parse of all files, without looking at the
trees; `one process` is reading and extracting all packages in turn, `ratio` the one over the other;
`all processors` is the same as a command does it, by the clock; the others are seconds of the
processor. Files of C++ and of Python are measured apart from each other, both with what builds and
launches them.
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
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from time import perf_counter, process_time

import tree_sitter_cpp
import tree_sitter_python
from ros_packages import write_packages
from tree_sitter import Language, Parser

from rebsync.reverse.files.packages import CODE
from rebsync.reverse.files.parallel import each
from rebsync.reverse.files.python_files import SUFFIX, is_python
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
    found = (path for listing in all_listings([root]) for path in listing.files.values())
    by_language: dict[str, list[bytes]] = {"C++": [], "Python": []}
    for path in found:
        suffix = Path(path).suffix
        if suffix in CODE or suffix == SUFFIX:
            by_language["C++" if suffix in CODE else "Python"].append(Path(path).read_bytes())
    for language, texts in by_language.items():
        if texts:
            compare_language(root, language, texts)
    print(f"peak memory {peak():.0f} MB")


def compare_language(root: str, language: str, texts: list[bytes]) -> None:
    """Prints the same of the files of one language."""
    do = partial(work, language=language)
    size = sum(map(len, texts)) / 1e6
    # First, as processes are copies of this one, which a command has not read anything in yet.
    every = best(lambda: list(each([root], do)), perf_counter)
    bare = best(lambda: parse_all(texts, language))
    alone = best(lambda: [do(given) for given in packages([root])])
    read = sum(_size(_of(given, language)) for given in packages([root])) / 1e6
    print(f"{language}: {len(texts)} files, {size:.2f} MB, of which {read:.2f} MB can matter")
    for name, seconds in (("bare", bare), ("one process", alone), ("all processors", every)):
        print(f"{name:15}{seconds:8.3f} s{size / seconds:8.2f} MB/s  ratio {seconds / bare:.2f}")


def best(
    what: Callable[[], object], clock: Callable[[], float] = process_time, runs: int = 3
) -> float:
    """Seconds, the least of some runs: of the processor, which other work disturbs less."""
    found = []
    for _ in range(runs):
        gc.collect()
        start = clock()
        what()
        found.append(clock() - start)
    return min(found)


def parse_all(texts: list[bytes], language: str) -> None:
    """What tree-sitter alone does."""
    grammar = tree_sitter_cpp if language == "C++" else tree_sitter_python
    parser = Parser(Language(grammar.language()))
    for text in texts:
        parser.parse(text)


def work(given: Chosen, language: str = "") -> tuple[int, int, float]:
    """What is done with a package: the process, its memory now and the classes found."""
    found = extract(_of(given, language), given.only)
    return os.getpid(), len(found.model.classes), memory()


def _of(given: Chosen, language: str) -> dict[str, Source]:
    """The files of a package without the code of other languages than this, if one is named."""

    def is_kept(path: str, source: Source) -> bool:
        if language == "C++":
            return not is_python(path, source)
        return language != "Python" or Path(path).suffix not in CODE

    return {path: source for path, source in given.files.items() if is_kept(path, source)}


def _size(files: dict[str, Source]) -> int:
    code = {*CODE, SUFFIX}
    return sum(len(s.text) for path, s in files.items() if Path(path).suffix in code)


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
    for number, (process, _, used) in enumerate(each([root], work), 1):
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
