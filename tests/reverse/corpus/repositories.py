"""The public repositories of which there are facts, and what is extracted from their checkouts."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

from rebsync.records import dataclass
from rebsync.reverse.cpp_index import Code
from rebsync.reverse.cpp_tree import parse
from rebsync.reverse.graph import Graph
from rebsync.reverse.graph_json import graph_data
from rebsync.reverse.ros_calls import graph_of
from rebsync.source import Source
from tests.reverse.corpus.compare import Comparison, answers_of, compare
from tests.reverse.corpus.packages import PACKAGES, facts_of

_CODE = frozenset(
    {
        *(".h", ".hh", ".hpp", ".hxx", ".ipp", ".tpp", ".cuh"),
        *(".c", ".cc", ".cpp", ".cxx", ".C", ".cu"),
    }
)


@dataclass(frozen=True, slots=True)
class Result:
    """A repository compared with its facts; `seconds` are those of reading."""

    name: str
    comparison: Comparison
    files: int
    size: int
    seconds: float


def results(folder: Path) -> Iterator[Result]:
    """Each repository that has a checkout in a folder."""
    for name in PACKAGES:
        if (folder / name).is_dir():
            yield _result(name, folder / name)


def _result(name: str, root: Path) -> Result:
    packages = [files_of(root, package) for package in PACKAGES[name]]
    start = time.perf_counter()
    answers = [a for files in packages for a in answers_of(graph_data(_graph(files)))]
    seconds = time.perf_counter() - start
    every = [source for files in packages for source in files]
    size = sum(len(source.text) for source in every)
    return Result(name, compare(facts_of(name), answers), len(every), size, seconds)


def _graph(files: list[Source]) -> Graph:
    return graph_of(Code.of(parse(source) for source in files))


def files_of(root: Path, package: str) -> list[Source]:
    """The C++ files of a package, known by their paths in the repository."""
    paths = sorted(p for p in (root / package).rglob("*") if p.suffix in _CODE and p.is_file())
    return [Source(p.relative_to(root).as_posix(), _text(p)) for p in paths]


def _text(path: Path) -> str:
    data = path.read_bytes()
    try:
        return data.decode("utf-8").replace("\r\n", "\n")
    except UnicodeDecodeError:
        return data.decode("latin-1").replace("\r\n", "\n")
