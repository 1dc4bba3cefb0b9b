"""Where the model of a package is: as recorded, or where it has moved to within the repository."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.files import STANDARD_INPUT
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import FOLDER, made_from
from rebsync.roundtrip.package.model_search import Search, is_alike, search
from rebsync.roundtrip.package.record import Record, read_record
from rebsync.roundtrip.package.seals import remember_model, remembered_model
from rebsync.source import NOWHERE, Source
from rebsync.trees import repository, tree_of

_NEAR = ("..", ".", "../models", "../model", "models", "model")


def model_of(package: ManagedPackage, record: Record) -> str:
    """The path of a model: where its user or the manifest says, or else where it has moved to.

    RebsyncError: it is in none of these places, or in several.
    """
    if package.model is not None:
        return package.model
    if (placed := placed_model(package, record)) is not None:
        return placed
    found = search(package, record)
    if found.model is not None:
        return found.model
    raise _lost(package, record, found)


def properties_beside(model: str) -> str | None:
    """The property file of a model: the one of its name; None where there is none."""
    path = Path(model).with_suffix(".property")
    return str(path) if os.path.lexists(path) else None


def placed_model(package: ManagedPackage, record: Record) -> str | None:
    """The model in the place that is recorded, or near the package; None where none is there.

    RebsyncError: that is outside of what belongs together.
    """
    if (known := _remembered(package.root, record)) is not None:
        return known if Path(package.root).is_absolute() else os.path.relpath(known)
    for path in filter(os.path.lexists, _tried(package.root, record)):
        if package.holds(os.path.realpath(path)):
            return path
        raise _outside(package, path)
    return None


def other_model(root: str, model: str, name: str) -> str | None:
    """The other model that a package was made from, by which `model` must not go; None if none.

    `name` is how `model` is recorded. One that is gone may have become this one.
    """
    try:
        record = read_record(root)
        package = ManagedPackage(root, tree_of(root))
        placed = placed_model(package, record) if model != STANDARD_INPUT else None
    except RebsyncError:
        other = made_from(Path(root))
        return other if other != name else None
    if placed is not None:
        is_same = os.path.realpath(placed) == os.path.realpath(model)
        return None if is_same else placed
    is_known = record.model == name or (model != STANDARD_INPUT and is_alike(model, root))
    return None if is_known else record.model


def former_packages(folder: str, model: str) -> tuple[Findings, ...]:
    """Notes of packages beside a new one that were made from its model by another name."""
    hint = 'to go on with that one, write `package = "{}"` in rebsync.toml'
    return tuple(
        _note(root, f"this was made from {model} when it was {name}", hint.format(Path(root).name))
        for root, name in _siblings(folder, model)
    )


def _siblings(folder: str, model: str) -> Iterator[tuple[str, str]]:
    """The packages beside a folder that were made from a model, with the name that it had then."""
    for records in sorted(Path(folder).parent.glob(f"*/{FOLDER}")):
        root = str(records.parent)
        package = ManagedPackage(root, tree_of(root))
        with suppress(RebsyncError):
            record = read_record(root)
            if Path(model).name != record.model and Path(model_of(package, record)).samefile(model):
                yield root, record.model


def moved_model(package: ManagedPackage, record: Record, model: str) -> tuple[Findings, ...]:
    """A note where a model was found, but not where the manifest says."""
    tried = next(filter(os.path.lexists, _tried(package.root, record)), None)
    if package.model is not None or tried == model or is_recorded(package.root, record, model):
        return ()
    message = f"its model is {model}, which its manifest does not say"
    hint = f"`rebsync sync {package.root}` records that"
    return (_note(package.root, message, hint),)


def _note(path: str, message: str, hint: str) -> Findings:
    note = Diagnostic("RS965", NOWHERE, message, hint, severity=Severity.NOTE)
    return Findings(Source(path, ""), (note,))


def is_recorded(root: str, record: Record, model: str) -> bool:
    """Whether the records of a package lead to a model, so that nobody has to say which it is."""
    if model == STANDARD_INPUT:
        return True
    known = _remembered(root, record)
    places = [known] if known is not None else _tried(root, record)
    first = next(filter(os.path.lexists, places), None)
    return first is not None and os.path.realpath(first) == os.path.realpath(model)


def remember(root: str, manifest: str, model: str) -> None:
    """Notes for this user where a model is to which the manifest of its package cannot lead."""
    told = json.loads(manifest)["model"]
    beside = Path(os.path.realpath(root)).parent / told["name"]
    if model == STANDARD_INPUT or os.path.realpath(model) == str(beside):
        return
    if not _leads(root, told.get("path", "")):
        remember_model(root, manifest, model)


def _leads(root: str, path: str) -> bool:
    """Whether a path of a manifest is believed, as one within a repository is."""
    return bool(path) and repository(os.path.realpath(root)) is not None


def _remembered(root: str, record: Record) -> str | None:
    known = remembered_model(root) if not _leads(root, record.path) else None
    return known if known is not None and Path(known).is_file() else None


def _outside(package: ManagedPackage, path: str) -> RebsyncError:
    """A package may not say of a file elsewhere that this is its model."""
    from rebsync.writing import told

    where = f"the repository {package.tree}"
    if repository(package.tree) is None:
        where = f"{package.tree}, and no repository is there"
    message = f"its model would be {told(path)}, which is outside of {where}"
    return RebsyncError.of(
        package.root, "RS815", message, f"if that is meant, --model {path} says so"
    )


def _tried(root: str, record: Record) -> list[str]:
    """Where a model may be, the likeliest place first."""
    start = os.path.realpath(root) if Path(root).is_symlink() else root
    places = [record.path] if record.path else [f"{folder}/{record.model}" for folder in _NEAR]
    if record.path:
        places.append(f"../{record.model}")
    whole = (os.path.join(start, place) for place in places)  # noqa: PTH118 - of many packages
    return list(dict.fromkeys(map(os.path.normpath, whole)))


def _lost(package: ManagedPackage, record: Record, found: Search) -> RebsyncError:
    """The mistake of a model that is in none of the places, or in several of them."""
    message = f"the model {record.model}, from which this package was made, is not there"
    records = "`rebsync sync --model {} {}` brings both in step and records it"
    if len(found.copies) > 1:
        message += f", and may be any of {', '.join(found.copies)}"
        hint = f"say which: {records.format('FILE', package.root)}"
    elif found.likely is not None:
        hint = f"if it is {found.likely} now, {records.format(found.likely, package.root)}"
    else:
        tried = ", ".join(_tried(package.root, record))
        hint = f"looked for {tried}; say where it is with --model FILE"
    return RebsyncError.of(package.root, "RS965", message, hint)
