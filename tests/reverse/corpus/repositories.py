"""What is extracted from the checkouts of public repositories, compared with the facts."""

from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from rebsync.records import dataclass
from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.files.python_files import is_python
from rebsync.reverse.files.reading import Chosen, packages
from rebsync.reverse.graph_json import graph_data
from rebsync.reverse.python.values.py_calls import graph_with
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse as parse_python
from tests.reverse.corpus.compare import Comparison, answers_of, compare
from tests.reverse.corpus.packages import PACKAGES, PYTHON, ROS2, facts_of
from tests.reverse.corpus.values import Json

# What a reason says of one place only.
_PARTICULAR = re.compile(r"`[^`]*`|\"[^\"]*\"|(?<!\w)'[^']*'|/\S+(?<!,)|-?\b\d+(?:\.\d+)?\b")


@dataclass(frozen=True, slots=True)
class Bodies:
    """How the bodies of packages are read.

    `statements` are all, and `grades` those findings of each grade; `reasons` those of findings,
    by grade, without what is particular; `packages` the grades of packages, or `no model`.
    """

    statements: int
    grades: Counter[str]
    reasons: Counter[tuple[str, str]]
    packages: Counter[str]
    seconds: float


@dataclass(frozen=True, slots=True)
class Result:
    """A repository compared with its facts; `seconds` are those of reading and of the graph."""

    name: str
    comparison: Comparison
    files: int
    size: int
    seconds: float
    bodies: Bodies | None = None


def results(folder: Path, bodies: bool = False) -> Iterator[Result]:
    """Each repository that has a checkout in a folder."""
    for name, within in PACKAGES.items():
        if (folder / name).is_dir():
            yield result(name, folder / name, within, bodies)
    for name, (checkout, within) in ROS2.items():
        if (folder / checkout).is_dir():
            yield result(name, folder / checkout, within, bodies)
    for name, (checkout, _) in PYTHON.items():
        if (folder / checkout).is_dir():
            yield python_result(name, folder / checkout)


def python_result(name: str, root: Path) -> Result:
    """The Python of a repository whose checkout is in a directory."""
    start = time.perf_counter()
    given = list(packages(str(root / package) for package in PYTHON[name][1]))
    code = [[s for p, s in sorted(c.files.items()) if is_python(p, s)] for c in given]
    answers = [
        {**answer, "file": Path(answer["file"]).relative_to(root).as_posix()}
        for sources in code
        for answer in answers_of(
            graph_data(graph_with(PyValues(PyCode.of(map(parse_python, sources)))))
        )
    ]
    seconds = time.perf_counter() - start
    every = [source for sources in code for source in sources]
    size = sum(len(source.text) for source in every)
    return Result(name, compare(facts_of(name), answers), len(every), size, seconds)


def result(name: str, root: Path, within: Sequence[str], bodies: bool = False) -> Result:
    """The C++ of packages in a checkout; with `bodies`, these as well."""
    start = time.perf_counter()
    given = list(packages(str(root / package) for package in within))
    answers = [answer for package in given for answer in _answers(package, root)]
    seconds = time.perf_counter() - start
    code = [s for package in given for p, s in package.files.items() if Path(p).suffix in CODE]
    return Result(
        name,
        compare(facts_of(name), answers),
        len(code),
        sum(len(source.text) for source in code),
        seconds,
        _bodies(given) if bodies else None,
    )


def _answers(package: Chosen, root: Path) -> Iterator[Json]:
    """What the nodes of a package ask ROS for, by the files of the repository."""
    code = [s for path, s in sorted(package.files.items()) if Path(path).suffix in CODE]
    for answer in answers_of(graph_data(Asking(Code.of(map(parse, code))).graph)):
        yield {**answer, "file": Path(answer["file"]).relative_to(root).as_posix()}


def _bodies(given: Sequence[Chosen]) -> Bodies:
    from rebsync.reverse.recovery import extract
    from rebsync.reverse.report import grade_of

    start = time.perf_counter()
    read = [extract(package.files) for package in given]
    seconds = time.perf_counter() - start
    findings = [f for package in given for f in package.findings]
    findings += [f for extracted in read for f in extracted.findings]
    return Bodies(
        sum(count for extracted in read for _, count in extracted.statements),
        Counter(f.grade.value for f in findings if f.within),
        Counter((f.grade.value, _PARTICULAR.sub("...", f.why)) for f in findings),
        Counter(grade_of(e) if e.model.classes else "no model" for e in read),
        seconds,
    )


def together(bodies: Sequence[Bodies]) -> Bodies:
    """Those of several repositories as one."""
    return Bodies(
        sum(b.statements for b in bodies),
        sum((b.grades for b in bodies), Counter[str]()),
        sum((b.reasons for b in bodies), Counter[tuple[str, str]]()),
        sum((b.packages for b in bodies), Counter[str]()),
        sum(b.seconds for b in bodies),
    )
