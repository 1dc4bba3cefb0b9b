"""What `rebsync check` says of each mutant."""

from __future__ import annotations

import gc
import os
import random
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from rebsync.cli.status import Status, status_of
from rebsync.diagnostics import RebsyncError
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.verdict.check import check
from rebsync.roundtrip.verdict.drift import Verdict
from rebsync.roundtrip.verdict.result import CheckResult
from tests.roundtrip.mutations.kinds import named
from tests.roundtrip.mutations.package import Kind, Mutant, Package, generated


class Said(Enum):
    """What check says.

    AT_ELEMENT: that the code moved, at the element that was changed. ELSEWHERE: the same, but at
    other elements only. AT_FILE: that it cannot tell, with a finding in the file that was changed.
    UNDETERMINED: that it cannot tell, with none there. ALIKE: in step, as a proof shows that bodies
    do the same. NOISE: in step, but not without a finding. BROKEN: that something cannot be read at
    all.
    """

    AT_ELEMENT = "at the element"
    ELSEWHERE = "elsewhere"
    AT_FILE = "at the file"
    UNDETERMINED = "undetermined"
    IN_STEP = "in step"
    ALIKE = "proved to do the same"
    NOISE = "noise"
    BROKEN = "broken"


@dataclass(frozen=True)
class Result:
    """What check said of one mutant."""

    kind: str
    example: str
    place: str
    said: Said
    told: tuple[str, ...] = ()

    def __str__(self) -> str:
        told = "; ".join(self.told[:2])
        return f"{self.kind}, {self.example} {self.place}: {self.said.value} {told}".rstrip()


@dataclass(frozen=True)
class Task:
    """All mutants of some kinds on one example; at most `most` of each, drawn by `seed`."""

    example: str
    kinds: tuple[str, ...]
    most: int
    seed: int
    dialect: str = "ros1-cpp"


def drawn(kind: Kind, package: Package, most: int, seed: int) -> list[Mutant]:
    """Mutants of a kind; which ones depends on nothing but names and the seed."""
    mutants = list(kind.mutants(package))
    if len(mutants) <= most:
        return mutants
    return random.Random(f"{seed} {package.name} {kind.name}").sample(mutants, most)


def results(tasks: Sequence[Task], jobs: int) -> Iterator[Result]:
    """What check says of all mutants of all tasks."""
    if jobs == 1:
        for task in tasks:
            yield from _done(task)
        return
    with ProcessPoolExecutor(jobs) as pool:
        for found in pool.map(_done, tasks):
            yield from found


def _done(task: Task) -> list[Result]:
    package = Package(task.example, task.dialect)
    kinds = named(task.dialect)
    with tempfile.TemporaryDirectory() as folder, _cache(f"{folder}/cache"):
        root = Path(folder, task.example)
        written(package, root)
        return [
            told(package, name, mutant, root)
            for name in task.kinds
            for mutant in drawn(kinds[name], package, task.most, task.seed)
        ]


def written(package: Package, root: Path) -> None:
    """Writes a copy of an example with the package in its dialect."""
    if package.dialect == "ros1-cpp":
        shutil.copytree(package.example, root)
        return
    shutil.copytree(package.example, root, ignore=shutil.ignore_patterns(package.name))
    for path, text in generated(package.name, package.dialect).items():
        _write(root / package.name / path, text)


def _write(target: Path, text: str) -> None:
    """A file of a package, executable where it is a script."""
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(text.encode("utf-8"))
    target.chmod(0o755 if text.startswith("#!") else 0o644)


@contextmanager
def _cache(folder: str) -> Iterator[None]:
    """A cache of its own, so that what others have read does not count; as the CLI, uncollected."""
    before, collects = os.environ.get("REBSYNC_CACHE"), gc.isenabled()
    os.environ["REBSYNC_CACHE"] = folder
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()
        if before is None:
            del os.environ["REBSYNC_CACHE"]
        else:
            os.environ["REBSYNC_CACHE"] = before


def told(package: Package, kind: str, mutant: Mutant, root: Path) -> Result:
    """What check says of a mutant in a copy of its example, which is put back afterwards."""
    home = root / package.name
    try:
        for path, text in mutant.files.items():
            if text is None:
                (home / path).unlink()
            else:
                (home / path).parent.mkdir(parents=True, exist_ok=True)
                (home / path).write_bytes(text.encode("utf-8"))
        (managed,) = find([str(root)])
        try:
            said, lines = _said(check(managed), mutant)
        except RebsyncError as error:
            said, lines = Said.BROKEN, [d.message for f in error.findings for d in f.diagnostics]
        return Result(kind, package.name, mutant.place, said, tuple(lines))
    finally:
        for path in mutant.files:
            (home / path).unlink(missing_ok=True)
            if path in package.files:
                _write(home / path, package.files[path])


def _said(found: CheckResult, mutant: Mutant) -> tuple[Said, list[str]]:
    messages = [d.message for f in found.findings for d in f.diagnostics]
    if found.drift is None or found.drift.verdict is Verdict.IN_STEP:
        is_clean = status_of(found.findings) is Status.CLEAN
        is_proved = any(d.code == "RS970" for f in found.findings for d in f.diagnostics)
        is_step = Said.ALIKE if is_proved else Said.IN_STEP
        return is_step if is_clean else Said.NOISE, messages
    differences = [d for d, _ in found.drift.differences]
    lines = [f"{d.element}" for d in differences] + messages
    paths = {d.element.path for d in differences}
    if any(_is_at(path, element) for path in paths for element in mutant.elements):
        return Said.AT_ELEMENT, lines
    if found.drift.verdict is Verdict.UNDETERMINED:
        told = {f.source.path.rpartition("/")[2] for f in found.findings}
        is_there = any(path.rpartition("/")[2] in told for path in mutant.files)
        return Said.AT_FILE if is_there else Said.UNDETERMINED, lines
    return Said.ELSEWHERE if mutant.elements else Said.AT_ELEMENT, lines


def _is_at(path: str, element: str) -> bool:
    return path == element or path.startswith(f"{element}.")
