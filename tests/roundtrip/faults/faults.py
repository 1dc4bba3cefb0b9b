"""The faults, each with the exit status and the code that tell of it."""

from __future__ import annotations

import ctypes
import json
import os
import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from rebsync.roundtrip.text_merge import decided
from tests.roundtrip.faults.package import (
    EDITS,
    MANIFEST,
    MODEL_FILE,
    SOURCE,
    Ended,
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


def outcome(fault: Fault, made: Path, folder: Path) -> tuple[Ended, list[str]]:
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
    wrong += _lost(folder, before)
    if fault.mend is not None or fault.arguments:
        if fault.mend is not None:
            fault.mend(folder)
        again = run(folder, "sync", *fault.arguments)
        if again.status != 0:
            wrong.append(f"mended, {again.status}: {again.told}")
    return ended, wrong


def _lost(folder: Path, before: dict[str, bytes]) -> list[str]:
    """The edits of users that are nowhere any more."""
    after = b"\n".join(data for name, data in snapshot(folder).items() if "/.rebsync/" not in name)
    there = b"\n".join(before.values())
    edits = [new for _, _, new in EDITS]
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


def _half(file: str) -> str:
    return file[: len(file) // 2]


_BASE = "patrol/.rebsync/base.rebeca"
_OURS = ("--conflict", "ours")
_MODEL_HERE = ("--model", MODEL_FILE)
_SYNTAX = text(MODEL_FILE, lambda t: t.replace("main {", "main"))

FAULTS = (
    Fault("no fault", _nothing, 0),
    Fault("manifest damaged", text(MANIFEST, lambda t: t.replace('"model"', '"mod')), 2, "RS962"),
    Fault("manifest half written", text(MANIFEST, _half), 2, "RS962"),
    Fault("manifest empty", text(MANIFEST, lambda t: ""), 2, "RS962"),
    Fault("manifest without a part", text(MANIFEST, lambda t: "{}"), 2, "RS962"),
    Fault("manifest of a newer rebsync", text(MANIFEST, _newer), 2, "RS963"),
    Fault("manifest deleted", gone(MANIFEST), 2, "RS961"),
    Fault("manifest with conflict markers", text(MANIFEST, lambda t: _CONFLICT + t), 2, "RS966"),
    Fault("all records deleted", gone("patrol/.rebsync"), 2, "RS960"),
    Fault("base model deleted", gone(_BASE), 1, "RS964", _OURS, text(MODEL_FILE, _decided)),
    Fault("base model damaged", text(_BASE, _half), 1, "RS964", _OURS, text(MODEL_FILE, _decided)),
    Fault("base texts deleted", gone("patrol/.rebsync/base"), 0, mend=_nothing),
    Fault("model deleted", gone(MODEL_FILE), 2, "RS965"),
    Fault(
        "model moved",
        moved(MODEL_FILE, "deep/er/other.rebeca"),
        2,
        "RS965",
        ("--model", "deep/er/other.rebeca"),
    ),
    Fault("model with mistakes", _SYNTAX, 2, "RS1"),
    Fault("model with conflict markers", text(MODEL_FILE, lambda t: _CONFLICT + t), 2, "RS966"),
    Fault("model that is not UTF-8", text(MODEL_FILE, lambda t: f"// \udcff\n{t}"), 2, "RS804"),
    Fault("package moved", moved("patrol", "src/robots/patrol"), 2, "RS965", _MODEL_HERE),
    Fault("package renamed", moved("patrol", "patrol_two"), 0),
    Fault("code with conflict markers", text(SOURCE, lambda t: t + _CONFLICT), 2, "RS966"),
    Fault(
        "code with conflict markers, decided",
        text(SOURCE, lambda t: t + _CONFLICT),
        2,
        "RS966",
        mend=text(SOURCE, _without_conflict),
    ),
    Fault("code that is not UTF-8", text(SOURCE, lambda t: f"// \udcff\n{t}"), 2, "RS804"),
    Fault("a source deleted", gone(SOURCE), 4, "RS969"),
    Fault("the launch file deleted", gone("patrol/launch/patrol.launch"), 4, "RS969"),
    Fault("files with CRLF", all_of(text(SOURCE, _crlf), text(MODEL_FILE, _crlf)), 0),
    Fault(
        "settings with mistakes", lambda f: _write(f / "rebsync.toml", "package = ["), 2, "RS807"
    ),
    Fault(
        "settings with another package",
        lambda f: _write(f / "rebsync.toml", 'package = "other"\n'),
        1,
        "RS955",
    ),
    Fault("a model that is read-only", mode(MODEL_FILE, 0o444), 2, "RS803", is_user=True),
    Fault("a source that is read-only", mode(SOURCE, 0o444), 2, "RS803", is_user=True),
    Fault("a directory that is read-only", mode("patrol/src", 0o555), 2, "RS803", is_user=True),
    Fault("records that are read-only", mode("patrol/.rebsync", 0o555), 2, "RS803", is_user=True),
    Fault("a source that may not be read", mode(SOURCE, 0), 4, "RS941", is_user=True),
    Fault("a manifest that may not be read", mode(MANIFEST, 0), 2, "RS803", is_user=True),
    Fault("a link in the tree", linked(SOURCE, is_out=False), 0),
    Fault("a link out of the tree", linked(SOURCE, is_out=True), 4, "RS941"),
    Fault("a model that is a link out of the tree", linked(MODEL_FILE, is_out=True), 2, "RS806"),
    Fault(
        "a link that leads nowhere",
        lambda f: (f / "patrol/src/x.cpp").symlink_to("nowhere"),
        4,
        "RS941",
    ),
    Fault("a link to itself", lambda f: (f / "patrol/src/loop").symlink_to("."), 0),
    Fault(
        "what a killed sync left",
        lambda f: _write(f / "patrol/src/.robot.cpp.0123abcd.rebsync.tmp", "x"),
        0,
    ),
)


def _write(path: Path, content: str) -> None:
    path.write_text(content, encoding="utf-8")
