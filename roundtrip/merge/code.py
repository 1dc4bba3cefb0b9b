"""Merges generated code with what somebody has made of it, file by file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from rebsync.diagnostics import Diagnostic, Findings
from rebsync.files import source_below
from rebsync.records import dataclass
from rebsync.reverse.scaffold.stand_ins import STAND_IN
from rebsync.roundtrip.merge.models import Favour
from rebsync.roundtrip.merge.moved_files import renamed_files
from rebsync.roundtrip.merge.source import merged_source
from rebsync.roundtrip.merge.text import MergedText
from rebsync.roundtrip.package.markers import user_blocks, with_user_blocks
from rebsync.roundtrip.package.state import is_of_model
from rebsync.source import NOWHERE, Source

_INTERFACES = (".msg", ".srv", ".action")
LABELS = ("as edited", "as generated now")


@dataclass(frozen=True, slots=True)
class Stages:
    """The three texts of a conflict in a file: last time, and both of today."""

    base: str
    ours: str
    theirs: str


@dataclass(frozen=True, slots=True)
class MergedCode:
    """The files of a package that change, by path; a text of None: the file goes.

    `conflicts` are those with conflict markers; `refused` says why others cannot be merged.
    """

    texts: dict[str, str | None]
    conflicts: dict[str, Stages]
    refused: tuple[Findings, ...] = ()


def merged_code(
    root: str,
    base: Mapping[str, str],
    theirs: Mapping[str, str],
    favour: Favour,
    moved: Mapping[str, str],
    recorded: Mapping[str, str],
) -> MergedCode:
    """The files of a package with what is generated now for today's model.

    `base` is what would be generated for what the files say now, so that only what the model has
    changed is different from it; the files are as people have left them, some of them `moved` to
    another path. `recorded` was generated last time.
    """
    texts: dict[str, str | None] = {}
    conflicts: dict[str, Stages] = {}
    refused: list[Findings] = []
    renamed = renamed_files(root, base, theirs)
    for new, old in renamed.items():
        texts[new], stages = _renamed(root, old, base[old], theirs[new], favour)
        texts[old] = None
        conflicts |= {new: stages} if stages is not None else {}
    for path in sorted({*base, *theirs} - {*renamed, *renamed.values()}):
        text = theirs.get(path)
        if base.get(path) == text:
            is_new = path.endswith(_INTERFACES) and path not in recorded
            if text is not None and is_new and source_below(root, path) is None:
                texts[path] = text  # of a message that a node only sends itself
            continue
        here = moved.get(path, path)
        last = recorded.get(path)
        merged = _file(root, here, base.get(path), theirs.get(path), last, favour)
        match merged:
            case Findings():
                refused.append(merged)
            case (str() as text, stages):
                texts[here] = text
                if isinstance(stages, Stages):
                    conflicts[here] = stages
            case _:
                texts[here] = None
    return MergedCode(texts, conflicts, tuple(refused))


def _file(
    root: str,
    name: str,
    base: str | None,
    theirs: str | None,
    recorded: str | None,
    favour: Favour,
) -> tuple[str, Stages | None] | Findings | None:
    """The text of one file, its conflict if there is one; None where it goes."""
    path, source = Path(root, name), source_below(root, name)
    if not is_of_model(name) and favour is Favour.MARKERS:
        favour = Favour.CODE  # what nothing is read from stays as its people want it
    if source is None:
        if theirs is None or (base is not None and not is_of_model(name)):
            return None
        if base is None or favour is Favour.MODEL:
            return theirs, None
        return _refusal(path, "this generated file is to change, and it is not there")
    ours = source.text
    base, theirs = (as_here(t, ours) if t is not None else None for t in (base, theirs))
    if theirs is None:
        if ours == base or favour is Favour.MODEL:
            return None
        if favour is Favour.CODE:
            return ours, None
        return _refusal(path, "this file is generated no more, and it was edited by hand")
    is_edited = recorded is None or ours != as_here(recorded, ours)
    merged = merged_file(name, (ours, base or "", theirs), is_edited, favour)
    stages = Stages(base or "", ours, theirs) if merged.conflicts else None
    return merged.text, stages


def merged_file(
    name: str, texts: tuple[str, str, str], is_edited: bool, favour: Favour = Favour.MARKERS
) -> MergedText:
    """The merge of a file, `texts` being ours, the base and theirs.

    One that nobody has edited is generated anew rather than in conflict: then it lacks what the
    code has changed elsewhere, and theirs has that.
    """
    if not is_edited and merged_source(name, texts, LABELS).conflicts:
        return MergedText(texts[2])
    return merged_source(name, texts, LABELS, favour.value)


def _renamed(
    root: str, name: str, base: str, theirs: str, favour: Favour
) -> tuple[str, Stages | None]:
    """The edited file of a class that has another name now, with all that is generated now."""
    source = source_below(root, name)
    ours = source.text if source is not None else base
    base, theirs = (_with_line_ends(text, ours) for text in (base, theirs))
    merged = merged_source(name, (ours, base, theirs), LABELS, favour.value)
    return merged.text, Stages(base, ours, theirs) if merged.conflicts else None


def _with_line_ends(text: str, ours: str) -> str:
    return text.replace("\n", "\r\n") if "\r\n" in ours else text


def as_here(text: str, ours: str) -> str:
    """A generated text with the user's own blocks, and with the line ends of the file."""
    return with_user_blocks(_with_line_ends(text, ours), user_blocks(ours))


_HINT = "`--conflict ours` takes the model's side, `--conflict theirs` that of the code"


def _refusal(path: Path, message: str) -> Findings:
    return Findings(Source(str(path), ""), (Diagnostic("RS969", NOWHERE, message, _HINT),))


def ancestors(
    recorded: Mapping[str, str], before: Mapping[str, str], now: Mapping[str, str]
) -> dict[str, str]:
    """What would have been generated last time for what the code says now.

    `recorded` was generated last time, `before` is today's generation of the model of last time,
    and `now` that of the model with the changes of the code. Where the first two differ, rebsync
    or the settings have changed since: that is to come into the code as well. So is what changes
    in files that no model is read from, as the page about the package, and in a stand-in of a
    sensor, which plays as often as the class looks.
    """
    return dict(_ancestors(recorded, before, now))


def _ancestors(
    recorded: Mapping[str, str], before: Mapping[str, str], now: Mapping[str, str]
) -> Iterator[tuple[str, str]]:
    for path in sorted({*recorded, *now}):
        old, new = recorded.get(path), now.get(path)
        is_unread = STAND_IN.fullmatch(path) is not None or not is_of_model(path)
        if old is not None and new is not None and is_unread:
            yield path, old
        elif old is None or old == before.get(path):
            if new is not None:
                yield path, new
        elif new is None or new == before.get(path):
            yield path, old
        else:
            merged = merged_source(path, (old, before.get(path, ""), new), LABELS)
            yield path, new if merged.conflicts else merged.text
