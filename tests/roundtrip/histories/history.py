"""One history: a package made of an example, edits of both sides, and a sync after each."""

from __future__ import annotations

import io
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from rebsync.cli import main
from rebsync.diagnostics import RebsyncError
from rebsync.roundtrip.merge.text import decided
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.package.manifest import FOLDER
from rebsync.roundtrip.verdict.check import check
from rebsync.roundtrip.verdict.drift import Drift
from tests.reverse.test_edits import BY_NAME
from tests.roundtrip.histories import laws
from tests.roundtrip.histories.code_edits import as_generated, edited_code
from tests.roundtrip.histories.model_edits import BEHAVIOUR, edited_model, number
from tests.roundtrip.mutations.package import Package

EXAMPLES = ("hello", "experiment1", "experiment3", "experiment1_unsafe", "experiment2", "warehouse")
_WEIGHTS = (30, 30, 15, 15, 6, 4)
_CODE = re.compile(r"\bRS\d{3}\b")
_MARKED = "<<<<<<< "
Files = dict[str, str]


@dataclass
class Step:
    """What was edited, what came of it, and each law that did not hold."""

    edits: tuple[str, ...]
    result: str = ""
    broken: list[str] = field(default_factory=list)


@dataclass
class History:
    """A sequence of steps, drawn by a seed."""

    seed: int
    example: str = ""
    steps: list[Step] = field(default_factory=list)


def history(
    seed: int, length: int, examples: tuple[str, ...] = EXAMPLES, dialect: str = "ros1-cpp"
) -> History:
    """Draws and carries out one history in a directory of its own."""
    rng = Random(seed)
    weights = [_WEIGHTS[EXAMPLES.index(e)] for e in examples]
    done = History(seed, rng.choices(examples, weights)[0])
    with TemporaryDirectory() as folder, _inside(folder):
        running = _Running(rng, done.example, dialect)
        for _ in range(length):
            step = running.step()
            done.steps.append(step)
            if step.broken:
                break
    return done


@contextmanager
def _inside(folder: str) -> Iterator[None]:
    here, cache, fsync = Path.cwd(), os.environ.get("REBSYNC_CACHE"), os.fsync
    os.chdir(folder)
    os.fsync = lambda fd: None  # a disk takes longer for this than all the rest
    os.environ["REBSYNC_CACHE"] = f"{folder}/.cache"
    try:
        yield
    finally:
        os.fsync = fsync
        os.chdir(here)
        del os.environ["REBSYNC_CACHE"]
        if cache is not None:
            os.environ["REBSYNC_CACHE"] = cache


def run(*arguments: str) -> tuple[int, str]:
    """The exit status of a command, and all that it prints."""
    out = io.StringIO()
    with redirect_stdout(out), redirect_stderr(out):
        status = main(list(arguments))
    return status, out.getvalue()


class _Running:
    """The files of a history, and its steps."""

    def __init__(self, rng: Random, name: str, dialect: str) -> None:
        self.rng, self.name, self.dialect = rng, name, dialect
        self.model, self.root = Path(f"{name}.rebeca"), Path(name)
        text = (BY_NAME[name] / self.model.name).read_text(encoding="utf-8")
        self.model.write_text(text, encoding="utf-8")
        status, told = run("generate", str(self.model), "--target", dialect)
        assert status == 0, told
        (self.root / "notes.txt").write_bytes(b"mine\r\n\xff\n")
        (self.root / "scripts").mkdir(exist_ok=True)
        (self.root / "scripts/plot").write_text("print(1)  \n")

    def step(self) -> Step:
        """Edits, sync, laws."""
        before = self._all()
        step = Step(self._edits())
        edited = self._all()
        drift = self._drift()
        status, told = run("sync")
        step.result = self._result(status, told, edited)
        step.broken += laws.own_blocks(_texts(edited, self.root), _texts(self._all(), self.root))
        match step.result.split(":")[0]:
            case "merged" | "in step":
                step.broken += self._after(before, edited, drift)
            case "conflict":
                step.broken += self._decided(edited, told)
            case "as far as read":
                step.broken += self._again(status)
                self._put(before)
            case "refused" | "undetermined":
                step.broken += self._refused(edited)
                self._put(before)
            case _:
                step.broken.append(f"{step.result}: {told}")
        return step

    # --- edits --------------------------------------------------------------------------------

    def _edits(self) -> tuple[str, ...]:
        text, files = self.model.read_text(encoding="utf-8"), self._code()
        way = self.rng.choices(("model", "code", "both", "same", "touching"), (25, 25, 35, 5, 10))
        names: list[str] = []
        match way[0]:
            case "same":
                name, new = edited_model(self.rng, text, BEHAVIOUR)
                names.append(f"both the same: {name}")
                self._write(new, as_generated(self.name, files, text, new, self.dialect) or files)
            case "touching":
                self._touching(text, files)
                names.append("both the same place")
            case side:
                new = text
                for _ in range(self.rng.choice((1, 1, 2, 3)) if side != "code" else 0):
                    name, new = edited_model(self.rng, new)
                    names.append(f"model: {name}")
                for _ in range(self.rng.choice((1, 1, 2)) if side != "model" else 0):
                    name, files = edited_code(self.rng, self.name, files, text, self.dialect)
                    names.append(name)
                self._write(new, files)
        return tuple(names)

    def _touching(self, text: str, files: Files) -> None:
        """The same number changed on both sides, in two ways or in one."""
        state = self.rng.getstate()
        _, mine = edited_model(self.rng, text, {"number": number})
        self.rng.setstate(state)
        _, same = edited_model(self.rng, text, {"number": number})
        theirs = edited_model(self.rng, same, {"number": number})[1]
        self._write(mine, as_generated(self.name, files, text, theirs, self.dialect) or files)

    # --- laws ---------------------------------------------------------------------------------

    def _after(
        self, before: dict[str, bytes], edited: dict[str, bytes], drift: Drift | None
    ) -> Iterator[str]:
        """What holds where all was merged."""
        last, old = (files[self.model.name].decode() for files in (before, edited))
        new = self.model.read_text(encoding="utf-8")
        yield from laws.says_the_same(self.root, self.model)
        yield from laws.untouched_model(old, new, drift)
        package = Package(self.name, self.dialect)
        package.files = _texts(edited, self.root)
        yield from laws.untouched_code(package, self._code(), (last, old), drift)
        yield from self._again(0)

    def _again(self, wanted: int) -> Iterator[str]:
        """The next check and sync say the same, and write nothing."""
        now = self._all()
        status, told = run("check")
        if status != wanted:
            yield f"check after sync: {status}: {told}"
        status, told = run("sync")
        if status != wanted:
            yield f"a second sync: {status}: {told}"
        for path, data in self._all().items():
            if now.get(path) != data:
                yield f"a second sync changes {path}"

    def _refused(self, edited: dict[str, bytes]) -> Iterator[str]:
        if self._all() != edited:
            yield "refused, and something was written"

    def _decided(self, edited: dict[str, bytes], told: str) -> Iterator[str]:
        """A conflict is marked, stays until it is decided, and can be decided for either side."""
        marked = [p for p in self._paths() if _MARKED in p.read_bytes().decode("utf-8", "replace")]
        if not marked:
            yield f"a conflict without markers: {told}"
        if (again := run("sync")[0]) not in (1, 2):
            yield f"a conflict is left, and sync says {again}"
        side = self.rng.choice(("ours", "theirs"))
        if self.rng.random() < 0.5:
            self._put(edited)
            status, told = run("sync", "--conflict", side)
        else:
            status, told = self._by_hand(marked, side == "ours")
        if status not in (0, 4) and not _is_refusal(told):
            yield f"decided for {side}: {status}: {told}"
        elif status:
            self._put(edited)
            self._give_up()
        else:
            yield from laws.says_the_same(self.root, self.model)
            yield from self._again(0)

    def _by_hand(self, marked: list[Path], first: bool) -> tuple[int, str]:
        status, told = 1, ""
        for _ in range(3):
            for path in marked:
                text = path.read_text(encoding="utf-8")
                is_model = path == self.model
                text = decided(text, _SIDES if is_model else _LABELS, is_model and first)
                path.write_text(text, encoding="utf-8")
            status, told = run("sync")
            marked = [p for p in self._paths() if _MARKED in p.read_text("utf-8", "replace")]
            if not marked:
                break
        return status, told

    def _give_up(self) -> None:
        """Starts anew from the code: nothing else is left to try."""
        status, told = run("generate", str(self.model), "--force", "--target", self.dialect)
        assert status == 0, told

    # --- files --------------------------------------------------------------------------------

    def _result(self, status: int, told: str, edited: dict[str, bytes]) -> str:
        codes = ", ".join(sorted(set(_CODE.findall(told)) - {"RS941", "RS942", "RS947"}))
        if "nothing was written" in told:
            return f"{'undetermined' if status == 4 else 'refused'}: {codes}"
        if status == 0:
            return "in step" if self._all(records=False) == _own(edited) else "merged"
        if status == 1 and "RS966" in codes:
            return "conflict"
        if status == 4 and self._all(records=False) != _own(edited):
            return f"as far as read: {codes}"
        if status == 4 or _is_refusal(told):
            return f"refused: {codes}"
        return f"failed with {status}"

    def _drift(self) -> Drift | None:
        (package,) = find(["."])
        try:
            return check(package).drift
        except RebsyncError:
            return None

    def _paths(self) -> list[Path]:
        return [self.model, *(p for p in sorted(self.root.rglob("*")) if p.is_file())]

    def _all(self, records: bool = True) -> dict[str, bytes]:
        found = {p.as_posix(): p.read_bytes() for p in self._paths()}
        return found if records else _own(found)

    def _code(self) -> Files:
        return _texts(self._all(), self.root)

    def _put(self, files: dict[str, bytes]) -> None:
        for path in self._paths():
            if path.as_posix() not in files:
                path.unlink()
        for name, data in files.items():
            Path(name).parent.mkdir(parents=True, exist_ok=True)
            Path(name).write_bytes(data)

    def _write(self, model: str, files: Files) -> None:
        self.model.write_text(model, encoding="utf-8")
        old = self._code()
        for path in old.keys() - files.keys():
            (self.root / path).unlink()
        for path, text in files.items():
            if old.get(path) != text:
                (self.root / path).parent.mkdir(parents=True, exist_ok=True)
                (self.root / path).write_bytes(text.encode())


_SIDES = ("model", "code")
_LABELS = ("as edited", "as generated now")


def _is_refusal(told: str) -> bool:
    return any(code in told for code in ("RS955", "RS959", "RS967", "RS968", "RS969"))


def _own(files: dict[str, bytes]) -> dict[str, bytes]:
    """The files but for the records."""
    return {path: data for path, data in files.items() if f"/{FOLDER}/" not in path}


def _texts(files: dict[str, bytes], root: Path) -> Files:
    """The files of a package that rebsync may look at, by their paths in it."""
    found: Files = {}
    for path, data in _own(files).items():
        name = path.removeprefix(f"{root.as_posix()}/")
        if name != path and name not in ("notes.txt", "scripts/plot"):
            found[name] = data.decode("utf-8")
    return found
