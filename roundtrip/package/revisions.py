"""What a user names as one of two sides: a model, a package, or a revision of either in git."""

from __future__ import annotations

import os
import posixpath
import stat
from collections.abc import Iterator
from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from rebsync.diagnostics import RebsyncError
from rebsync.files import STANDARD_INPUT, decode, operating_on
from rebsync.git import finished, git, git_without_files
from rebsync.git_objects import revision as objects_of
from rebsync.reverse.files.stores import Disk, Store, join
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.package.models import CodeModel, code_model, parsed, read_model

if TYPE_CHECKING:
    from rebsync.reverse.files.reading import Chosen

MODEL = ".rebeca"
MANIFEST = "package.xml"
_FORMS = "wanted is a model, a package, or REVISION:PATH as git has it, such as HEAD~3:robots"


def read_side(name: str) -> CodeModel:
    """The model that a name stands for, with what of the code is not in it exactly.

    RebsyncError: there is no such path or revision, it is not readable, or it has no model.
    """
    if name == STANDARD_INPUT:
        return CodeModel(read_model(name), ())
    if os.path.lexists(name):
        return _path(name)
    revision, colon, path = name.partition(":")
    if not colon or not revision:
        raise RebsyncError.of(name, "RS801", "no such file or directory", _FORMS)
    return _revision(name, revision, path)


def _path(path: str, store: Store | None = None) -> CodeModel:
    """What a path has, on the disk or in a revision."""
    files = store or Disk()
    with operating_on(path):
        if not files.is_folder(path):
            return _model(path, store) if path.endswith(MODEL) else _code(path, store)
        models = sorted(_models(files, path))
    if models and not files.exists(join(path, MANIFEST)):
        if len(models) == 1:
            return _model(_below(path, models[0]), store)
        hint = f"name one of them: {', '.join(models)}"
        raise RebsyncError.of(path, "RS943", "there are several models here", hint)
    return _code(path, store)


def _models(files: Store, folder: str) -> Iterator[str]:
    """The names of the models in a directory."""
    for entry in files.entries(folder):
        if Path(entry.name).suffix == MODEL:
            with suppress(OSError):  # a link that leads nowhere
                if stat.S_ISREG(entry.stat().st_mode):
                    yield entry.name


def _below(folder: str, name: str) -> str:
    """A path in a directory, as the user named that."""
    return f"{folder}{name}" if folder.endswith("/") else join(folder, name)


def _model(path: str, store: Store | None) -> CodeModel:
    if store is None:
        return CodeModel(read_model(path), ())
    source = decode(path, store.read(path))
    return CodeModel(SourcedModel(parsed(source), source), ())


def _code(path: str, store: Store | None) -> CodeModel:
    """What the code of a package or of one file says."""
    from rebsync.reverse.recovery import extract

    chosen = _chosen(path, store)
    extracted = extract(chosen.files, chosen.only)
    if not extracted.model.classes:
        raise RebsyncError.of(path, "RS943", "no class of a model was found here")
    findings = (*chosen.findings, *extracted.findings)
    partial = chosen.only is not None and extracted.model.main is None
    return code_model(path, extracted.model, findings, partial=partial)


def _chosen(path: str, store: Store | None) -> Chosen:
    """The files of the one package that a path stands for."""
    from rebsync.reverse.files.reading import packages, read
    from rebsync.roundtrip.package.units import both_at

    both = both_at(path, store)
    found = [read(both)] if both is not None else list(islice(packages([path], store), 2))
    if not found:
        raise RebsyncError.of(path, "RS943", "no class of a model was found here")
    if len(found) > 1:
        hint = f"name one of them, such as {' or '.join(f.root for f in found)}"
        raise RebsyncError.of(path, "RS943", "there are several packages here", hint)
    return found[0]


# --- revisions ----------------------------------------------------------------------------------


def _revision(name: str, revision: str, path: str) -> CodeModel:
    """A model or package of a revision: `path` is from the top of the repository, or from here."""
    top = None if revision.startswith("-") else _id(name, f"{revision}^{{commit}}^{{tree}}")
    if top is None:
        message = f'no such file, and git knows no revision "{revision}" here'
        raise RebsyncError.of(name, "RS801", message, _trust() or _FORMS)
    here = _told(name, "rev-parse", "--show-prefix")
    with objects_of(revision, top) as files:
        for tried in dict.fromkeys((path, f"{here}{path}")):
            inside = posixpath.normpath(tried).strip("/") if tried else ""
            whole = files.path("" if inside == "." else inside)
            if files.exists(whole):
                return _path(whole, files)
    message = f'the revision "{revision}" has no "{path}"'
    raise RebsyncError.of(name, "RS801", message, _earlier(revision, path, here))


def _earlier(revision: str, path: str, here: str) -> str | None:
    """The hint that a file had another name in a revision, if git can tell."""
    asked = ("--cached", "--name-status", "-z", "--diff-filter=R", "-M")
    listed = git_without_files("diff-index", "--no-ext-diff", "--no-textconv", *asked, revision)
    rows = os.fsdecode(listed or b"").split("\0")
    for old, new in zip(rows[1::3], rows[2::3], strict=False):
        if new in (path, f"{here}{path}"):
            return f"there it was {old}: {revision}:{old}"
    return None


def _trust() -> str | None:
    """The hint of git where it does not trust a repository, as it is somebody else's."""
    with suppress(OSError):
        said = os.fsdecode(finished("rev-parse", "--git-dir").stderr)
        if "safe.directory" in said:
            return f"git does not trust this repository: {said.splitlines()[0]}"
    return None


def _id(name: str, object_: str) -> str | None:
    """The id of an object of git; None where it knows none."""
    return _told(name, "rev-parse", "--verify", "--quiet", object_).strip() or None


def _told(name: str, *arguments: str) -> str:
    """What a command of git prints, nothing where it fails. RebsyncError: there is no git."""
    try:
        return os.fsdecode(git(*arguments) or b"").removesuffix("\n")
    except OSError as error:
        message = f"git cannot be run: {error.strerror}"
        raise RebsyncError.of(name, "RS806", message) from None
