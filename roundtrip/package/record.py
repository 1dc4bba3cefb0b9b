"""What `.rebsync/` of a package says, read with care: it may be damaged, or from the future."""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterable
from typing import Any

from rebsync import __version__
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.files import names_below, read_source, source_below
from rebsync.records import dataclass
from rebsync.roundtrip.package.manifest import FORMAT, MANIFEST
from rebsync.source import NOWHERE, Source, Span

_AGAIN = "`rebsync generate` writes it anew"
_MARK = "<<<<<<< "
# Nearly all paths: to look at the parts of each of many thousand takes long.
_PLAIN = re.compile(r"(?:[\w-][\w.-]*/)*[\w-][\w.-]*", re.ASCII)


@dataclass(frozen=True, slots=True)
class Record:
    """The manifest of a package: from which model it was made, how, and what was generated.

    `model` is the name of the model's file; `path` leads to it from the package's folder, empty
    where that is not recorded. `digest` is that of the model's text, `files` those of the texts
    that were generated. `accepted` is how nodes are joined otherwise than generated, as a change
    of the code that is in the model since. `in_step` is the digest of edited code and this model
    when all of it was last looked at and both said the same, empty where that was not so.
    `is_merged`: it is put together from what a merge left, and is to be written anew.
    """

    model: str
    path: str
    digest: str
    options: dict[str, Any]
    files: dict[str, str]
    accepted: frozenset[str] = frozenset()
    in_step: str = ""
    is_merged: bool = False


def read_record(root: str) -> Record:
    """The manifest of a package.

    RebsyncError: it is not there, damaged, or in a format of a newer rebsync.
    """
    path = f"{root}/{MANIFEST}"
    if not os.path.lexists(path):
        message = "the manifest is missing: what the package was made from is not known"
        raise RebsyncError.of(path, "RS961", message, _AGAIN)
    source = read_source(path)
    try:
        data = json.loads(source.text)
    except json.JSONDecodeError as error:
        place = Span(error.pos, error.pos + 1)
        raise _damaged(source, place, f"it is no JSON: {error.msg}") from None
    except RecursionError:
        raise _damaged(source, NOWHERE, "it is nested too deeply") from None
    return record_in(source, data)


def _damaged(source: Source, span: Span, why: str) -> RebsyncError:
    hint = "`rebsync sync` puts both sides together, once model and code have no conflicts"
    if (found := conflict_in(source, hint)) is not None:
        return RebsyncError([found])
    message = f"the manifest is damaged: {why}"
    return RebsyncError([Findings(source, (Diagnostic("RS962", span, message, _AGAIN),))])


_DECIDE = "decide which side is right, and take the markers out"


def conflict_in(source: Source, hint: str = _DECIDE) -> Findings | None:
    """What a merge left in a text that people are to decide, if anything."""
    text = source.text
    at = 0 if text.startswith(_MARK) else text.find(f"\n{_MARK}") + 1
    if not text.startswith(_MARK, at) or f"\n{'>' * 7}" not in text[at:]:
        return None
    message = "a merge left a conflict here"
    end = text.find("\n", at)
    span = Span(at, end if end >= 0 else len(text))
    return Findings(source, (Diagnostic("RS966", span, message, hint),))


def record_in(source: Source, data: object) -> Record:
    """What the data of a manifest say. RebsyncError: they are damaged, or of a newer format."""
    match data:
        case {"format": int(version), "rebsync": by_version} if version > FORMAT:
            message = (
                f"the manifest has format {version}; this rebsync knows formats up to {FORMAT}"
            )
            hint = f"install rebsync {by_version} or newer"
            raise RebsyncError.of(source.path, "RS963", message, hint)
        case {
            "format": int(),
            "model": {"name": str(name), "digest": str(digest)},
            "options": dict(options),
            "files": dict(files),
        } if _is_name(name) and all(map(_is_file, files.items())):
            path, known = _path(data), _in_step(data)
            if not _are_settings(options):
                raise _damaged(source, NOWHERE, "its options are no settings that generate knows")
            return Record(name, path, digest, options, files, _accepted(data), known)
        case _:
            raise _damaged(source, NOWHERE, "a part of it is missing or of the wrong kind")


def recorded_base(root: str, folder: str) -> dict[str, str]:
    """The texts that were generated last time, as far as they are kept."""
    names = names_below(root, folder.rstrip("/"))
    found = ((name, source_below(root, folder + name)) for name in names)
    return {name: source.text for name, source in found if source is not None}


def _are_settings(options: dict[str, Any]) -> bool:
    """Whether recorded options are of the kinds that they have; a newer rebsync's may be there."""
    from rebsync.config import TARGETS, config_of_record

    target = options.get("target", TARGETS[0])
    known = {**options, "target": TARGETS[0]}  # which others there are is told elsewhere
    return isinstance(target, str) and config_of_record(known) is not None


def _is_name(name: str) -> bool:
    """Whether this is the name of a file, and no path that leads elsewhere."""
    return name not in ("", ".", "..") and not {"/", "\0"} & set(name)


def _is_file(item: tuple[object, object]) -> bool:
    """Whether this is a file of a package with its digest."""
    match item:
        case (str() as path, str()):
            if _PLAIN.fullmatch(path):
                return True
            parts = path.split("/")
            return all(map(_is_name, parts)) and ".git" not in (p.casefold() for p in parts)
        case _:
            return False


def _path(data: object) -> str:
    match data:
        case {"model": {"path": str(path)}}:
            return path
        case _:
            return ""


def _accepted(data: object) -> frozenset[str]:
    match data:
        case {"accepted": [*told]}:
            return frozenset(each for each in told if isinstance(each, str))
        case _:
            return frozenset()


def _in_step(data: object) -> str:
    match data:
        case {"in_step": str(digest)}:
            return digest
        case _:
            return ""


def with_accepted(manifest: str, accepted: Iterable[str], in_step: str = "") -> str:
    """The text of a manifest that accepts how some nodes are joined, and knows code by a digest."""
    told = {"accepted": sorted(accepted), "in_step": in_step}
    data = {k: v for k, v in json.loads(manifest).items() if k not in told}
    whole = {**data, **{k: v for k, v in told.items() if v}}
    return json.dumps(whole, indent=2, ensure_ascii=False) + "\n"


def told_in_step(record: Record, told: Iterable[str]) -> str:
    """The digest of code and a model that say the same; `told` is all that the code depends on.

    Another version of rebsync may read code otherwise, so that it does not know it by this.
    """
    parts = (__version__, record.digest, *told)
    return hashlib.sha256("\0".join(parts).encode("utf-8", "surrogateescape")).hexdigest()
