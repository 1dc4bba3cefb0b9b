"""What writing a package would do to the files that are there: nothing of the user's is lost."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from itertools import count
from pathlib import Path

from rebsync.files import names_below, source_below
from rebsync.patches import patch
from rebsync.records import dataclass
from rebsync.roundtrip.merge.code import LABELS
from rebsync.roundtrip.merge.source import merged_source
from rebsync.roundtrip.package.manifest import BASE, FOLDER
from rebsync.roundtrip.package.markers import user_blocks, with_user_blocks

_CRLF = "\r\n"


class Action(Enum):
    """What happens to one file."""

    CREATE = "create"
    UPDATE = "update"
    UNCHANGED = "unchanged"
    KEEP = "keep"  # edited by hand, and nothing new is generated for it
    CONFLICT = "conflict"  # edited by hand, and something new is generated for it
    DELETE = "delete"
    MERGE = "merge"  # edited by hand, and what is new goes in beside the edits


@dataclass(frozen=True, slots=True)
class Step:
    """The fate of one file: the text that is there (None: no file) and the one to be.

    `plain` is what is generated, without the edits that the new text keeps.
    """

    path: str
    action: Action
    old: str | None
    new: str | None
    plain: str | None = None

    def diff(self) -> str:
        """The change as a unified diff."""
        before = f"a/{self.path}" if self.old is not None else "/dev/null"
        after = f"b/{self.path}" if self.new is not None else "/dev/null"
        return patch(self.old or "", self.new or "", before, after)


def plan(folder: Path, files: Mapping[str, str]) -> tuple[Step, ...]:
    """One step for each file that is generated, and for each that once was.

    The records of `.rebsync/` follow what they are about: when the machine dies half-way, the
    next run must not take a file that was not reached for one that the user has edited.
    """
    ordered = sorted(files.items(), key=lambda file: (file[0].startswith(f"{FOLDER}/"), file[0]))
    steps = [_step(folder, path, text) for path, text in ordered]
    once = set(names_below(str(folder), BASE.rstrip("/")))
    for path in sorted(p for p in once if p not in files and BASE + p not in files):
        steps += _stale(folder, path)
    return tuple(steps)


def _step(folder: Path, path: str, text: str) -> Step:
    old = _read(folder, path)
    if old is None:
        return Step(path, Action.CREATE, None, text)
    if path.startswith(f"{FOLDER}/"):
        return Step(path, Action.UNCHANGED if old == text else Action.UPDATE, old, text)
    plain = _plain(old)
    if old != plain == plain.replace("\r", "") and old == plain.replace("\n", _CRLF):
        return _with_line_ends(_step_of(folder, path, plain, text), old)
    return _step_of(folder, path, old, text)


def _plain(text: str) -> str:
    """A text with the line ends that generated texts have."""
    return text.replace(_CRLF, "\n")


def _with_line_ends(step: Step, old: str) -> Step:
    """The same for a file all of whose lines end as git has them checked out on Windows."""
    new, plain = (t.replace("\n", _CRLF) if t is not None else None for t in (step.new, step.plain))
    return Step(step.path, step.action, old, new, plain)


def _step_of(folder: Path, path: str, old: str, text: str) -> Step:
    """The fate of a file with a text, of which `text` is generated."""
    new = with_user_blocks(text, user_blocks(old))
    if old == new:
        return Step(path, Action.UNCHANGED, old, new)
    base = _base(folder, path)
    if base is not None and old == with_user_blocks(base, user_blocks(old)):
        return Step(path, Action.UPDATE, old, new)
    if base == text:
        return Step(path, Action.KEEP, old, old, new)
    return _merged(path, old, base, text)


def _merged(path: str, old: str, base: str | None, text: str) -> Step:
    """A file that was edited and is generated anew: both, where they do not touch."""
    own = user_blocks(old)
    new = with_user_blocks(text, own)
    if base is not None:
        ends = ("\n", "\r\n") if "\r\n" in old else ("", "")
        theirs, last = (
            with_user_blocks(each.replace(*ends) if ends[0] else each, own) for each in (text, base)
        )
        merged = merged_source(path, (old, last, theirs), LABELS)
        if not merged.conflicts:
            return Step(path, Action.MERGE, old, merged.text, new)
    return Step(path, Action.CONFLICT, old, new)


def _stale(folder: Path, path: str) -> list[Step]:
    """A file that is generated no more goes, unless it was edited; so does its base."""
    old, base = _read(folder, path), _base(folder, path)
    steps = []
    if old is not None:
        edited = base is None or _plain(old) != base
        steps.append(Step(path, Action.CONFLICT if edited else Action.DELETE, old, None))
    return [*steps, Step(BASE + path, Action.DELETE, base, None)]


def aside(step: Step) -> Step:
    """The same without keeping edits in the file: they are set aside as those of a conflict are."""
    if step.action not in (Action.KEEP, Action.MERGE):
        return step
    return Step(step.path, Action.CONFLICT, step.old, step.plain)


def name_to_keep(folder: Path, step: Step) -> str:
    """The name under which an edited file is kept: `FILE.orig`, `FILE.orig.2` and so on."""
    for number in count(1):
        name = f"{step.path}.orig" + (f".{number}" if number > 1 else "")
        if not (folder / name).exists() or _read(folder, name) == step.old:
            return name
    raise AssertionError("count() does not end")


def _base(folder: Path, path: str) -> str | None:
    """What was generated for a file last time, if that is known."""
    base = _read(folder, BASE + path)
    return _plain(base) if base is not None else None


def _read(folder: Path, name: str) -> str | None:
    source = source_below(str(folder), name)
    return source.text if source is not None else None
