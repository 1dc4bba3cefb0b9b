"""Writes what brings a package in step: model, code, and last of all the records."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.roundtrip.manifest import BASE_MODEL, MANIFEST
from rebsync.roundtrip.merge_code import Stages
from rebsync.roundtrip.sync import Sync, relative
from rebsync.roundtrip.sync_records import marked
from rebsync.source import Source
from rebsync.stamps import Stamps
from rebsync.writing import replace_tree


def write(sync: Sync, before: Stamps) -> tuple[str, ...]:
    """Writes it all or nothing; gives the paths of model and code that are written.

    `before` are the files from when it was begun. RebsyncError: a file cannot be written, somebody
    has changed it since, or a link leads out of what belongs together.
    """
    root = os.path.realpath(sync.checked.kept.root)
    model = relative(os.path.realpath(sync.checked.model), root)
    shown = {model: sync.checked.model}
    texts: dict[str, str] = {}
    if sync.model_text is not None:
        texts[model] = sync.model_text
    texts |= {p: t for p, t in sync.texts.items() if t is not None}
    for path in texts:
        _refuse_link(Path(shown.get(path) or Path(root, path)), sync.checked.kept.tree)
        texts[path] = marked(Path(root, path), texts[path])
    # Last what is only true when all the rest is there.
    ordered = sorted(sync.records.items(), key=lambda r: (r[0] == MANIFEST, r[0] == BASE_MODEL))
    texts |= {path: text for path, text in ordered if text is not None}
    gone = [p for each in (sync.texts, sync.records) for p, t in each.items() if t is None]

    def refuse_changed() -> None:
        before.refuse_changed(str(Path(root, path)) for path in (*texts, *gone))

    try:
        written = replace_tree(root, texts, remove=gone, ready=refuse_changed)
    except RebsyncError as error:
        raise RebsyncError([_as_shown(f, root, sync, shown) for f in error.findings]) from None
    _tell_git(sync)
    own = (path for path in written if not path.startswith(".rebsync/"))
    return tuple(shown.get(p) or f"{sync.checked.kept.root}/{p}" for p in own)


def _as_shown(found: Findings, root: str, sync: Sync, shown: Mapping[str, str]) -> Findings:
    """A finding with the path of its file as the user knows it."""
    name = relative(os.path.normpath(found.source.path), root)
    path = shown.get(name) or f"{sync.checked.kept.root}/{name}"
    return Findings(Source(path, found.source.text), found.diagnostics)


def _refuse_link(file: Path, tree: str) -> None:
    """What is behind a link that leads out of the tree is not ours to change."""
    if file.is_symlink() and Path(tree).resolve() not in file.resolve().parents:
        message = "this is a link that leads out of the tree, and it would have to change"
        raise RebsyncError.of(str(file), "RS806", message, "put the file itself here")


# --- git ----------------------------------------------------------------------------------------


def _tell_git(sync: Sync) -> None:
    """Puts conflicts into the index of a repository, as a merge of its own does.

    So `git status` shows them and `git mergetool` opens them. Files that git does not know are
    left alone.
    """
    root = sync.checked.kept.root
    for path, stages in sync.conflicts.items():
        file = Path(root, path) if path else Path(sync.checked.model)
        _stage(file, stages)


def _stage(file: Path, stages: Stages) -> None:
    folder = str(file.parent)
    listed = _git(folder, "ls-files", "--stage", "--full-name", "-z", "--", file.name)
    if not listed:
        return
    about, _, name = listed.split(b"\0")[0].partition(b"\t")
    mode = about.split()[0]
    lines = [b"0 " + b"0" * 40 + b"\t" + name]
    for number, text in enumerate((stages.base, stages.ours, stages.theirs), start=1):
        made = _git(folder, "hash-object", "-w", "--stdin", given=text.encode("utf-8"))
        if not made:
            return
        lines.append(b"%s %s %d\t%s" % (mode, made.strip(), number, name))
    top = _git(folder, "rev-parse", "--show-toplevel")
    if top:
        given = b"\0".join([*lines, b""])
        _git(os.fsdecode(top.rstrip(b"\n")), "update-index", "-z", "--index-info", given=given)


def _git(folder: str, *arguments: str, given: bytes = b"") -> bytes | None:
    """What a command of git prints; None where it fails, or there is no git."""
    try:
        done = subprocess.run(
            ["git", *arguments], cwd=folder, input=given, capture_output=True, check=False
        )
    except OSError:
        return None
    return done.stdout if done.returncode == 0 else None
