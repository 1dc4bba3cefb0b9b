"""What a user names as one of two sides: a model, a package, or a revision of either in git."""

from __future__ import annotations

import os
import posixpath
import subprocess
from dataclasses import replace
from itertools import islice
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from rebsync.diagnostics import RebsyncError
from rebsync.files import STANDARD_INPUT, decode, read_bytes
from rebsync.roundtrip.difference import Place
from rebsync.roundtrip.models import Code, model_given, parsed
from rebsync.roundtrip.sides import Given, Unread
from rebsync.source import Source

if TYPE_CHECKING:
    from rebsync.reverse.files.reading import Chosen

MODEL = ".rebeca"
MANIFEST = "package.xml"
_FORMS = "wanted is a model, a package, or REVISION:PATH as git has it, such as HEAD~3:robots"


def read_side(name: str) -> Code:
    """The model that a name stands for, with what of the code is not in it exactly.

    RebsyncError: there is no such path or revision, it is not readable, or it has no model.
    """
    if name == STANDARD_INPUT:
        return Code(model_given(name), ())
    if os.path.lexists(name):
        return _path(name, name)
    revision, colon, path = name.partition(":")
    if not colon or not revision:
        raise RebsyncError.of(name, "RS801", "no such file or directory", _FORMS)
    return _revision(name, revision, path)


def _path(path: str, shown: str, root: tuple[str, str] | None = None) -> Code:
    """What a path has; `root` is a directory around it, and what that is called."""
    if not Path(path).is_dir():
        return _model(path, shown) if path.endswith(MODEL) else _code(path, shown, root)
    models = sorted(p.name for p in Path(path).iterdir() if p.suffix == MODEL and p.is_file())
    if models and not (Path(path) / "package.xml").is_file():
        if len(models) == 1:
            return _model(str(Path(path, models[0])), _below(shown, models[0]))
        hint = f"name one of them: {', '.join(models)}"
        raise RebsyncError.of(shown, "RS943", "there are several models here", hint)
    return _code(path, shown, root)


def _below(shown: str, inside: str) -> str:
    """A path in a directory, as the user named that."""
    return f"{shown}{inside}" if shown.endswith((":", "/")) else f"{shown}/{inside}"


def _model(path: str, shown: str) -> Code:
    if path == shown:
        return Code(model_given(path), ())
    source = decode(shown, read_bytes(path))
    return Code(Given(parsed(source), source), ())


def _code(path: str, shown: str, root: tuple[str, str] | None) -> Code:
    """What the code of a package or of one file says."""
    from rebsync.reverse.findings import Grade
    from rebsync.reverse.recovery import extract
    from rebsync.reverse.report import diagnostics

    chosen = _chosen(path, shown, root or (path, shown))
    extracted = extract(chosen.files, chosen.only)
    if not extracted.model.classes:
        raise RebsyncError.of(shown, "RS943", "no class of a model was found here")
    findings = (*chosen.findings, *extracted.findings)
    unread = tuple(
        Unread(Place(f.source, f.span), f.why, f.within)
        for f in findings
        if f.grade is Grade.UNREADABLE
    )
    partial = chosen.only is not None and extracted.model.main is None
    given = Given(extracted.model, Source(shown, ""), unread, partial)
    return Code(given, diagnostics(findings))


def _chosen(path: str, shown: str, root: tuple[str, str]) -> Chosen:
    """The files of the one package that a path stands for, under the names to be told."""
    from rebsync.reverse.files.reading import packages, read
    from rebsync.roundtrip.units import both_at

    def named(source: Source) -> Source:
        inside = source.path.removeprefix(root[0]).lstrip("/")
        return Source(_below(root[1], inside) if inside else root[1], source.text)

    both = both_at(path)
    found = [read(both)] if both is not None else list(islice(packages([path]), 2))
    if not found:
        raise RebsyncError.of(shown, "RS943", "no class of a model was found here")
    if len(found) > 1:
        roots = [f"{shown}{f.root.removeprefix(path)}" for f in found]
        hint = f"name one of them, such as {' or '.join(roots)}"
        raise RebsyncError.of(shown, "RS943", "there are several packages here", hint)
    if path == shown:
        return found[0]
    files = {inside: named(source) for inside, source in found[0].files.items()}
    findings = tuple(replace(f, source=named(f.source)) for f in found[0].findings)
    return replace(found[0], files=files, findings=findings, root=shown)


# --- revisions ----------------------------------------------------------------------------------


def _revision(name: str, revision: str, path: str) -> Code:
    """A model or package of a revision: `path` is from the top of the repository, or from here."""
    if _git(name, "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}") is None:
        message = f'no such file, and git knows no revision "{revision}" here'
        raise RebsyncError.of(name, "RS801", message, _FORMS)
    for tried in dict.fromkeys((path, f"./{path}")):
        kind = _git(name, "cat-file", "-t", f"{revision}:{tried}")
        if kind is not None:
            return _object(name, f"{revision}:{tried}", path, kind.decode().strip())
    message = f'the revision "{revision}" has no "{path}"'
    raise RebsyncError.of(name, "RS801", message, _earlier(name, revision, path))


def _earlier(name: str, revision: str, path: str) -> str | None:
    """The hint that a file had another name in a revision, if git can tell."""
    here = (_git(name, "rev-parse", "--show-prefix") or b"").decode().strip()
    renamed = _git(name, "diff", "--name-status", "-z", "--diff-filter=R", "-M", revision) or b""
    parts = os.fsdecode(renamed).split("\0")
    for old, new in zip(parts[1::3], parts[2::3], strict=False):
        if new in (path, f"{here}{path}"):
            return f"there it was {old}: {revision}:{old}"
    return None


def _object(name: str, object_: str, path: str, kind: str) -> Code:
    """The model or package that a blob or a tree of git holds."""
    with TemporaryDirectory(prefix="rebsync-") as folder:
        if kind == "tree":
            _write_tree(name, object_, folder)
            return _path(folder, name)
        if not path.endswith(MODEL) and (around := _around(name, object_)) is not None:
            _write_tree(name, around, folder)
            inside = _full(name, object_).removeprefix(f"{around.partition(':')[2]}/")
            return _path(str(Path(folder, inside)), name, (folder, around))
        target = Path(folder, PurePosixPath(path).name)
        target.write_bytes(_git(name, "cat-file", "blob", object_) or b"")
        return _path(str(target), name)


def _full(name: str, object_: str) -> str:
    """The path of an object of git from the top of the repository."""
    path = object_.partition(":")[2]
    if not path.startswith("./"):
        return path
    here = (_git(name, "rev-parse", "--show-prefix") or b"").decode().strip()
    return posixpath.normpath(f"{here}{path}")


def _around(name: str, object_: str) -> str | None:
    """The nearest package around a file of a revision."""
    revision, _, _ = object_.partition(":")
    for folder in PurePosixPath(_full(name, object_)).parents:
        inside = "" if str(folder) == "." else f"{folder}/"
        if _git(name, "cat-file", "-e", f"{revision}:{inside}{MANIFEST}") is not None:
            return f"{revision}:{inside.rstrip('/')}"
    return None


def _write_tree(name: str, object_: str, folder: str) -> None:
    """Writes the regular files of a tree; links and submodules are left out."""
    listed = _git(name, "ls-tree", "-r", "-z", "--full-tree", object_) or b""
    lines = (line for line in listed.split(b"\0") if line.startswith(b"100"))
    rows = [line.partition(b"\t") for line in lines]
    hashes = b"".join(about.split()[2] + b"\n" for about, _, _ in rows)
    data = _git(name, "cat-file", "--batch", given=hashes) or b""
    at = 0
    for _, _, path in rows:
        end = data.index(b"\n", at)
        size = int(data[at:end].split()[2])
        target = Path(folder, os.fsdecode(path))
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data[end + 1 : end + 1 + size])
        at = end + size + 2


def _git(name: str, *arguments: str, given: bytes = b"") -> bytes | None:
    """What a command of git prints; None where it fails. RebsyncError: there is no git."""
    try:
        done = subprocess.run(["git", *arguments], input=given, capture_output=True, check=False)
    except OSError as error:
        message = f"git cannot be run: {error.strerror}"
        raise RebsyncError.of(name, "RS806", message) from None
    return done.stdout if done.returncode == 0 else None
