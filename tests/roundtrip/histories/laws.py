"""What holds after every sync, told from the files as they were and as they are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from rebsync import model as m
from rebsync.grammars.parser import parse_model
from rebsync.reverse.files.reading import read
from rebsync.reverse.recovery import extract
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.difference import Difference, Renamed, Undetermined, explain
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.package.markers import user_blocks
from rebsync.roundtrip.package.units import as_one, listing_of
from rebsync.roundtrip.verdict.drift import Drift, Mover
from rebsync.source import Source
from tests.roundtrip.mutations.package import BODIES, Package, Part

Texts = Mapping[str, str]
_MODEL = (Mover.MODEL, Mover.CONFLICT, Mover.UNKNOWN)
_CODE = (Mover.CODE, Mover.CONFLICT, Mover.UNKNOWN)


def says_the_same(root: Path, model: Path) -> Iterator[str]:
    """Law 3: the code, read anew, says what the model says."""
    source = Source(str(model), model.read_text(encoding="utf-8"))
    files = (p.relative_to(root).as_posix() for p in root.rglob("package.xml"))
    generated = [name for name in files if not name.startswith(".rebsync/")]
    chosen = read(as_one(listing_of(str(root), str(root.parent), generated)))
    said = SourcedModel(extract(chosen.files).model, Source(str(root), ""))
    for difference in compare(SourcedModel(parse_model(source).model, source), said).differences:
        yield f"law 3: {difference.element}: {explain(difference)}"


def untouched_model(old: str, new: str, drift: Drift | None) -> Iterator[str]:
    """Law 5 for the model: bodies that the code has not changed keep their bytes."""
    moved = _moved(drift, _CODE)
    if not moved:
        if old != new:
            yield "law 5: the model's text has changed, and the code had not"
        return
    if _has_renames(drift):
        return
    touched = {d.element.path for d in moved}
    for path, text in _bodies(old):
        if not _is_touched(path, touched) and text not in new:
            yield f"law 5: {path} of the model is not as it was"


def untouched_code(
    package: Package, new: Texts, model: tuple[str, str], drift: Drift | None
) -> Iterator[str]:
    """Law 5 for the code: files and functions that the model has not changed keep their bytes.

    `model` is its text as it was and as it is; what has another layout there counts as changed.
    """
    moved = _moved(drift, _MODEL)
    if not moved and model[0] == model[1]:
        old = package.files
        yield from (f"law 5: {p} has changed" for p in sorted(old) if new.get(p) != old[p])
        return
    if _has_renames(drift):
        return
    touched = {d.element.path for d in moved}
    last = set(_bodies(model[0]))
    touched |= {path for path, text in _bodies(model[1]) if (path, text) not in last}
    whole = "\n".join(new.values())
    for part in parts_of(package):
        is_own = part.kind in BODIES and not _is_touched(part.element, touched)
        if is_own and package.files[part.path][part.start : part.end] not in whole:
            yield f"law 5: {part.element} of the code is not as it was"


def parts_of(package: Package) -> list[Part]:
    """The functions of a package; none where its layout is not what they are found by."""
    try:
        return package.parts
    except ValueError:
        return []


def own_blocks(old: Texts, new: Texts) -> Iterator[str]:
    """What users have in blocks of their own stays byte for byte, where the file does."""
    for path, text in old.items():
        if path in new and user_blocks(new[path]) != user_blocks(text):
            yield f"user blocks: {path} is not as it was"


def _moved(drift: Drift | None, whose: tuple[Mover, ...]) -> list[Difference]:
    told = drift.differences if drift is not None else ()
    return [d for d, mover in told if mover in whose and not isinstance(d, Undetermined)]


def _has_renames(drift: Drift | None) -> bool:
    """Whether something is called otherwise on one side, so that what names it changes too."""
    told = drift.differences if drift is not None else ()
    return any(isinstance(d, Renamed) for d, _ in told)


def _is_touched(path: str, touched: set[str]) -> bool:
    """Whether an element, one in it, or one that it is in is changed."""
    return any(path == t or path.startswith(f"{t}.") or t.startswith(f"{path}.") for t in touched)


def _bodies(text: str) -> Iterator[tuple[str, str]]:
    for owner in parse_model(Source("drawn.rebeca", text)).model.classes:
        if isinstance(owner, m.ReactiveClass):
            for each in owner.members:
                if isinstance(each, m.Constructor):
                    yield owner.name, text[each.span.start : each.span.end]
                elif isinstance(each, m.MessageServer | m.Method):
                    yield f"{owner.name}.{each.name}", text[each.span.start : each.span.end]
