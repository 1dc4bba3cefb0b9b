"""What a generated package does that its model cannot say, for those who read its code alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.files import MODEL
from rebsync.roundtrip.diff.compare import compare
from rebsync.roundtrip.diff.difference import Place
from rebsync.roundtrip.diff.operands import UnreadPlace
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE_MODEL
from rebsync.roundtrip.package.models import CodeModel, read_code, read_model
from rebsync.roundtrip.package.record import Record, read_record
from rebsync.roundtrip.package.state import PackageState, is_base_whole, package_state
from rebsync.roundtrip.verdict.runtime import edited


def unmodelled_edits(path: str) -> tuple[Findings, ...]:
    """Where generated code that no model describes is not as generated, in packages at a path.

    That is the run-time part, of a package's own or shared, and programs. Code that people wrote
    has no records, and nothing is said of it.
    """
    return tuple(found for package in _packages(path) for found in _edits(package))


def _packages(path: str) -> Iterator[ManagedPackage]:
    try:
        yield from find([path])
    except RebsyncError:
        return


def _edits(package: ManagedPackage) -> tuple[Findings, ...]:
    try:
        record = read_record(package.root)
    except RebsyncError:
        return ()
    now = package_state(package, record)
    found = edited(package, record, now)
    if not found or not (renamed := _renamed_classes(package, record, now)):
        return found
    return edited(package, record, now, renamed)


def _renamed_classes(
    package: ManagedPackage, record: Record, now: PackageState
) -> Mapping[str, str]:
    """The classes of last time by which programs are told from those that were renamed since."""
    try:
        if not is_base_whole(package, record):
            return {}
        base = read_model(f"{package.root}/{BASE_MODEL}")
        return compare(base, read_code(package, now).given).renamed_classes
    except RebsyncError:
        return {}


def with_edits(path: str, side: CodeModel) -> CodeModel:
    """A side of a comparison, with edits of code that its model does not describe as unread.
    RebsyncError is not raised: a path that is no package has none.
    """
    if side.given.source.path.endswith(MODEL):
        return side
    places = tuple(
        UnreadPlace(Place(found.source, each.span), each.message, "")
        for found in unmodelled_edits(path)
        for each in found.diagnostics
    )
    if not places:
        return side
    return replace(side, given=replace(side.given, unread=(*side.given.unread, *places)))
