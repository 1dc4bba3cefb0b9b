"""The faults, each with the exit status and the code that tell of it."""

from __future__ import annotations

import ctypes
import json
import os
import re
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from rebsync.roundtrip.merge.text import decided
from tests.roundtrip.faults.package import (
    MANIFEST,
    MODEL_FILE,
    PATROLS,
    Ended,
    Patrol,
    copied,
    run,
    snapshot,
)

_VERSION = 0x20080522  # of the structures of capset(2)
_CONFLICT = "<<<<<<< mine\na\n=======\nb\n>>>>>>> theirs\n"


@dataclass(frozen=True)
class Fault:
    """Something wrong: how it comes about, the exit status of sync, and the code that it tells.

    `arguments` are those of a second run that goes well, `mend` what its user does before;
    `is_user` says that the commands run without the rights of an administrator.
    """

    name: str
    make: Callable[[Path], None]
    status: int
    code: str = ""
    arguments: tuple[str, ...] = ()
    mend: Callable[[Path], None] | None = None
    is_user: bool = False


def outcome(
    fault: Fault, made: Path, folder: Path, patrol: Patrol = PATROLS["ros1-cpp"]
) -> tuple[Ended, list[str]]:
    """How sync ends with a fault, and all that is not as it should be."""
    copied(made, folder)
    fault.make(folder)
    before = snapshot(folder)
    ended = run(folder, "sync", before=_as_user if fault.is_user else None)
    wrong = []
    if ended.status != fault.status or fault.code not in ended.told or "Traceback" in ended.told:
        wrong.append(f"status {ended.status}: {ended.told}")
    if "wrote" not in ended.told and snapshot(folder) != before:
        wrong.append("something was written")
    wrong += _lost(folder, before, patrol)
    if fault.mend is not None or fault.arguments:
        if fault.mend is not None:
            fault.mend(folder)
        again = run(folder, "sync", *fault.arguments)
        if again.status != 0:
            wrong.append(f"mended, {again.status}: {again.told}")
    return ended, wrong


def _lost(folder: Path, before: dict[str, bytes], patrol: Patrol) -> list[str]:
    """The edits of users that are nowhere any more."""
    after = b"\n".join(data for name, data in snapshot(folder).items() if "/.rebsync/" not in name)
    there = b"\n".join(before.values())
    edits = [new for _, _, new in patrol.edits]
    return [f"lost: {e}" for e in edits if e.encode() in there and e.encode() not in after]


def _as_user() -> None:
    """Gives up an administrator's right to read and write everything, in this process."""
    if os.getuid() == 0:
        header = (ctypes.c_uint32 * 2)(_VERSION, 0)
        if ctypes.CDLL(None, use_errno=True).capset(header, (ctypes.c_uint32 * 6)()) != 0:
            raise OSError(ctypes.get_errno(), "capset")


# --- makers -------------------------------------------------------------------------------------


def text(path: str, change: Callable[[str], str]) -> Callable[[Path], None]:
    """Writes a file anew."""

    def make(folder: Path) -> None:
        file = folder / path
        file.write_bytes(
            change(file.read_bytes().decode("utf-8")).encode("utf-8", "surrogateescape")
        )

    return make


def gone(path: str) -> Callable[[Path], None]:
    """Deletes a file or a directory."""

    def make(folder: Path) -> None:
        if (folder / path).is_dir():
            shutil.rmtree(folder / path)
        else:
            (folder / path).unlink()

    return make


def moved(old: str, new: str) -> Callable[[Path], None]:
    """Moves a file or a directory."""

    def make(folder: Path) -> None:
        (folder / new).parent.mkdir(parents=True, exist_ok=True)
        (folder / old).rename(folder / new)

    return make


def mode(path: str, bits: int) -> Callable[[Path], None]:
    """Sets who may do what with a file or a directory."""
    return lambda folder: (folder / path).chmod(bits)


def all_of(*makers: Callable[[Path], None]) -> Callable[[Path], None]:
    """One after the other."""

    def make(folder: Path) -> None:
        for each in makers:
            each(folder)

    return make


def linked(path: str, is_out: bool) -> Callable[[Path], None]:
    """Puts a link in place of a file, to a copy in the tree or out of it."""

    def make(folder: Path) -> None:
        file = folder / path
        target = (folder.parent if is_out else folder) / f"elsewhere.{file.name}"
        shutil.copyfile(file, target)
        file.unlink()
        file.symlink_to(target)

    return make


def linked_folder(path: str, target: str) -> Callable[[Path], None]:
    """Puts a link in place of a directory, to where it is now, in the tree."""

    def make(folder: Path) -> None:
        moved(path, target)(folder)
        (folder / path).symlink_to(target)

    return make


def entry(path: str, make: Callable[[Path], None]) -> Callable[[Path], None]:
    """Puts something where nothing is."""
    return lambda folder: make(folder / path)


def _newer(manifest: str) -> str:
    return json.dumps({**json.loads(manifest), "format": 99, "rebsync": "9.0.0"})


def _without_conflict(file: str) -> str:
    return re.sub(r"<<<<<<< .*?>>>>>>> \w+\n", "", file, flags=re.DOTALL)


def _decided(file: str) -> str:
    return decided(file, ("model", "code"), True)


def _nothing(folder: Path) -> None:
    pass


def _crlf(file: str) -> str:
    return file.replace("\n", "\r\n")


def _bom(file: str) -> str:
    return f"\ufeff{file}"


def _unended(file: str) -> str:
    return file.rstrip("\n")


def _cut(file: str) -> str:
    return file[: len(file) // 2]


def _half(text: str) -> str:
    """The first half, up to the middle of a call: it does not parse."""
    return text[: text.index("(", len(text) // 2) + 1]


_BASE = "patrol/.rebsync/base.rebeca"
_OURS = ("--conflict", "ours")
_MODEL_HERE = ("--model", MODEL_FILE)
_SYNTAX = text(MODEL_FILE, lambda t: t.replace("main {", "main"))

# Those of what is the same in all dialects.
ALIKE = (
    Fault("no fault", _nothing, 0),
    Fault("manifest damaged", text(MANIFEST, lambda t: t.replace('"model"', '"mod')), 2, "RS962"),
    Fault("manifest half written", text(MANIFEST, _cut), 2, "RS962"),
    Fault("manifest empty", text(MANIFEST, lambda t: ""), 2, "RS962"),
    Fault("manifest without a part", text(MANIFEST, lambda t: "{}"), 2, "RS962"),
    Fault("manifest of a newer rebsync", text(MANIFEST, _newer), 2, "RS963"),
    Fault("manifest deleted", gone(MANIFEST), 2, "RS961"),
    Fault("manifest with conflict markers", text(MANIFEST, lambda t: _CONFLICT + t), 2, "RS966"),
    Fault("all records deleted", gone("patrol/.rebsync"), 2, "RS96"),
    Fault(
        "all records and settings deleted",
        all_of(gone("patrol/.rebsync"), gone("rebsync.toml")),
        2,
        "RS960",
    ),
    Fault("base model deleted", gone(_BASE), 1, "RS964", _OURS, text(MODEL_FILE, _decided)),
    Fault("base model damaged", text(_BASE, _cut), 1, "RS964", _OURS, text(MODEL_FILE, _decided)),
    Fault("base texts deleted", gone("patrol/.rebsync/base"), 0, mend=_nothing),
    Fault("model deleted", gone(MODEL_FILE), 2, "RS965"),
    Fault(
        "model moved",
        all_of(
            moved(MODEL_FILE, "deep/er/other.rebeca"), moved("rebsync.toml", "deep/er/rebsync.toml")
        ),
        2,
        "RS965",
        ("--model", "deep/er/other.rebeca"),
    ),
    Fault("model with mistakes", _SYNTAX, 2, "RS1"),
    Fault("model with conflict markers", text(MODEL_FILE, lambda t: _CONFLICT + t), 2, "RS966"),
    Fault("model that is not UTF-8", text(MODEL_FILE, lambda t: f"// \udcff\n{t}"), 2, "RS804"),
    Fault("package moved", moved("patrol", "src/robots/patrol"), 2, "RS965", _MODEL_HERE),
    Fault("package renamed", moved("patrol", "patrol_two"), 0),
    Fault(
        "settings with mistakes", lambda f: _write(f / "rebsync.toml", "package = ["), 2, "RS807"
    ),
    Fault(
        "settings with another package",
        text("rebsync.toml", lambda t: f'package = "other"\n{t}'),
        1,
        "RS955",
    ),
    Fault("a model that is read-only", mode(MODEL_FILE, 0o444), 2, "RS803", is_user=True),
    Fault("records that are read-only", mode("patrol/.rebsync", 0o555), 2, "RS803", is_user=True),
    Fault("a manifest that may not be read", mode(MANIFEST, 0), 2, "RS803", is_user=True),
    Fault("a model that is a link out of the tree", linked(MODEL_FILE, is_out=True), 2, "RS815"),
)


def faults(patrol: Patrol) -> tuple[Fault, ...]:
    """All faults of the package in a dialect."""
    return (*ALIKE, *of_code(patrol), *_of_entries(patrol))


def of_code(patrol: Patrol) -> Iterator[Fault]:
    """What can be wrong with what a source says, which each language reads in its own way."""
    source, written = patrol.source, patrol.edits[0][0]
    marked = text(source, lambda t: t + _CONFLICT)
    odd = text(written, lambda t: f"{patrol.comment} \udcff\n{t}")
    yield Fault("code with conflict markers", marked, 2, "RS966")
    decided = text(source, _without_conflict)
    yield Fault("code with conflict markers, decided", marked, 2, "RS966", mend=decided)
    yield Fault("code that is not UTF-8", odd, 2, "RS804")
    yield Fault("a source emptied", text(source, lambda t: ""), 4, "RS959")
    yield Fault("a launch file emptied", text(patrol.launch, lambda t: ""), 4, "RS959")
    # Whatever it lacks may be in what does not parse, and stays in the model.
    yield Fault("a source half written", text(source, _half), 4, "RS941")
    for name, change in (("CRLF", _crlf), ("a BOM", _bom), ("no end of line at the end", _unended)):
        both = (text(path, change) for path in dict.fromkeys((source, written, MODEL_FILE)))
        yield Fault(f"files with {name}", all_of(*both), 0)
    yield Fault("a source deleted", gone(source), 4, "RS969")
    yield Fault("the launch file deleted", gone(patrol.launch), 4, "RS969")


def _of_entries(patrol: Patrol) -> Iterator[Fault]:
    """What can be wrong with the entries of directories: of another's, links."""
    source, written = patrol.source, patrol.edits[0][0]
    folder, _, name = source.rpartition("/")
    suffix, above = name.rpartition(".")[2], written.rpartition("/")[0]
    yield Fault("a source that is read-only", mode(written, 0o444), 2, "RS803", is_user=True)
    yield Fault("a directory that is read-only", mode(above, 0o555), 2, "RS803", is_user=True)
    yield Fault("a source that may not be read", mode(source, 0), 4, "RS941", is_user=True)
    yield Fault("a link in the tree", linked(written, is_out=False), 2, "RS813")
    yield Fault("a link out of the tree", linked(source, is_out=True), 4, "RS941")
    nowhere = entry(f"{folder}/x.{suffix}", lambda p: p.symlink_to("nowhere"))
    away = linked_folder("patrol", "elsewhere/patrol")
    yield Fault("a package that is a link", away, 2, "RS965", _MODEL_HERE)
    yield Fault("a link that leads nowhere", nowhere, 4, "RS941")
    yield Fault("a link to itself", entry(f"{folder}/loop", lambda p: p.symlink_to(".")), 0)
    left = entry(f"{folder}/.{name}.0123abcd.rebsync.tmp", lambda p: _write(p, "x"))
    yield Fault("what a killed sync left", left, 0)


def _write(path: Path, content: str) -> None:
    path.write_text(content, encoding="utf-8")
