"""Writes what brings a package in step: model, code, and last of all the records."""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.files import operating_on
from rebsync.git import git, git_without_files
from rebsync.git_own import is_own_repository
from rebsync.roundtrip.merge.code import Stages
from rebsync.roundtrip.package.manifest import BASE_MODEL, FOLDER, MANIFEST
from rebsync.roundtrip.package.model_file import remember
from rebsync.roundtrip.package.seals import attest
from rebsync.roundtrip.sync.records import marked
from rebsync.roundtrip.sync.result import Sync
from rebsync.roundtrip.sync.sync import relative
from rebsync.source import Source
from rebsync.stamps import Stamps
from rebsync.writing import real_path, replace_tree


def write(sync: Sync, before: Stamps) -> tuple[str, ...]:
    """Writes it all or nothing; gives the paths of model and code that are written.

    `before` are the files from when it was begun. RebsyncError: a file cannot be written, somebody
    has changed it since, or a link leads out of what belongs together.
    """
    root = sync.checked.package.to_write()
    texts = {p: marked(root, p, t) for p, t in sync.texts.items() if t is not None}
    # Last what is only true when all the rest is there.
    ordered = sorted(sync.records.items(), key=lambda r: (r[0] == MANIFEST, r[0] == BASE_MODEL))
    texts |= {path: text for path, text in ordered if text is not None}
    gone = [p for each in (sync.texts, sync.records) for p, t in each.items() if t is None]
    shown = {_to_write(sync, path): path for path in sync.beside}
    beside = {p: marked(*os.path.split(p), sync.beside[shown[p]]) for p in shown}

    def refuse_changed() -> None:
        before.refuse_changed([*beside, *(f"{root}/{path}" for path in (*texts, *gone))])

    try:
        written = replace_tree(
            root, texts, remove=gone, ready=refuse_changed, beside=beside, real=root
        )
    except RebsyncError as error:
        raise RebsyncError([_as_shown(f, root, sync, shown) for f in error.findings]) from None
    if (manifest := sync.records.get(MANIFEST)) is not None:
        attest(manifest)
        remember(root, manifest, sync.checked.model)
    _tell_git(sync)
    own = (path for path in written if not path.startswith(f"{FOLDER}/"))
    return tuple(shown.get(p, f"{sync.checked.package.root}/{p}") for p in own)


def _as_shown(found: Findings, root: str, sync: Sync, shown: Mapping[str, str]) -> Findings:
    """A finding with the path of its file as the user knows it."""
    path = shown.get(found.source.path)
    if path is None:
        path = f"{sync.checked.package.root}/{relative(os.path.normpath(found.source.path), root)}"
    return Findings(Source(path, found.source.text), found.diagnostics)


def _to_write(sync: Sync, path: str) -> str:
    """The real path of what lies beside the package. RebsyncError: it is a link out of the tree."""
    with operating_on(path):
        real = real_path(path)
    if Path(path).is_symlink() and not sync.checked.package.holds(real):
        message = "this is a link that leads out of the tree, and it would have to change"
        raise RebsyncError.of(path, "RS813", message, "put the file itself here")
    return real


# --- git ----------------------------------------------------------------------------------------


def _tell_git(sync: Sync) -> None:
    """Puts conflicts into the index of a repository, as a merge of its own does.

    So `git status` shows them and `git mergetool` opens them. Files that git does not know are
    left alone, and so is the index of a repository that is not that of the files.
    """
    root = sync.checked.package.root
    for path, stages in sync.conflicts.items():
        file = Path(root, path) if path else Path(sync.checked.model)
        with suppress(OSError, RebsyncError):  # without git, or with one that does not answer
            if is_own_repository(file.parent):
                _stage(file, stages)


def _stage(file: Path, stages: Stages) -> None:
    folder = str(file.parent)
    listed = git("ls-files", "--stage", "--full-name", "-z", "--", file.name, folder=folder)
    if not listed:
        return
    about, _, name = listed.split(b"\0")[0].partition(b"\t")
    mode, known, _ = about.split()
    lines = [b"0 " + b"0" * len(known) + b"\t" + name]
    for number, text in enumerate((stages.base, stages.ours, stages.theirs), start=1):
        data = text.encode("utf-8")
        made = git("hash-object", "-w", "--no-filters", "--stdin", folder=folder, given=data)
        if not made:
            return
        lines.append(b"%s %s %d\t%s" % (mode, made.strip(), number, name))
    given = b"\0".join([*lines, b""])
    git_without_files("update-index", "-z", "--index-info", folder=folder, given=given)
