"""How long extraction of Python takes, against what libcst alone needs to parse the same files.

    python bench/extract_python.py DIRECTORY ... [--profile]

`bare` is libcst's parse of the files that matter, without looking at the trees: those that
extraction reads, of all that lie in the directories. `extraction` is choosing them, reading them
and extracting their packages; `ratio` the one over the other, of which the goal is 1.5. Files that
libcst cannot parse (Python 2) are no part of `bare`, but of the extraction.
"""

from __future__ import annotations

import argparse
import gc
import shutil
import tempfile
from pathlib import Path

import libcst
from extract import best, peak, profile

from rebsync.reverse.files.python_files import is_python, may_be_script
from rebsync.reverse.files.reading import packages
from rebsync.reverse.recovery import extract

GOAL = 1.5


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("directories", nargs="+", type=Path, metavar="DIRECTORY")
    parser.add_argument("--profile", action="store_true")
    options = parser.parse_args()
    gc.disable()  # as the command line does
    with tempfile.TemporaryDirectory() as made:
        for directory in options.directories:
            copy_python(directory, Path(made) / directory.name)
        compare(made)
        if options.profile:
            profile(made)


def copy_python(directory: Path, to: Path) -> None:
    """Copies what is Python, and the manifests, so that nothing else is measured."""
    for path in directory.rglob("*"):
        wanted = path.suffix == ".py" or path.name == "package.xml" or may_be_script(path.name)
        if wanted and path.is_file() and ".git" not in path.parts:
            there = to / path.relative_to(directory)
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, there)


def compare(root: str) -> None:
    """Prints times, speeds and their ratio."""
    every = [s for given in packages([root]) for p, s in given.files.items() if is_python(p, s)]
    texts = [source.text for source in every if is_parsed(source.text)]
    size = sum(len(text.encode()) for text in texts) / 1e6
    bare = best(lambda: [libcst.parse_module(text) for text in texts])
    whole = best(lambda: [extract(given.files, given.only) for given in packages([root])])
    print(f"{len(every)} files matter, of which libcst parses {len(texts)}: {size:.2f} MB")
    for name, seconds in (("bare", bare), ("extraction", whole)):
        print(f"{name:12}{seconds:8.3f} s{size / seconds:8.2f} MB/s  ratio {seconds / bare:.2f}")
    print(f"goal {GOAL}: {'met' if whole <= GOAL * bare else 'missed'}; memory {peak():.0f} MB")


def is_parsed(text: str) -> bool:
    """Whether libcst can parse a file."""
    try:
        libcst.parse_module(text)
    except libcst.ParserSyntaxError:
        return False
    return True


if __name__ == "__main__":
    main()
