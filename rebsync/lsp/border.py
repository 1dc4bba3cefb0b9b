"""Across the border: from an element of a model to the code that is generated from it, and back."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from lsprotocol import types as lsp

from rebsync.diagnostics import RebsyncError
from rebsync.files import read_source
from rebsync.lsp.document import ModelDocument, Text
from rebsync.lsp.occurrences import Entity
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.markers import MarkedElement, elements
from rebsync.roundtrip.package.model_file import model_of
from rebsync.roundtrip.package.record import read_record

CODE = (".cpp", ".h", ".hpp", ".py", ".launch")


def packages_of(path: str) -> list[ManagedPackage]:
    """The packages that are made from a model, or the one around a file; none where none is.

    Of a file of a run-time part that packages share they are all of these.
    """
    try:
        return list(find([path]))
    except RebsyncError:
        return []


def model_path(package: ManagedPackage) -> str | None:
    """The path of a package's model."""
    try:
        return package.model or model_of(package, read_record(package.root))
    except RebsyncError:
        return None


def in_code(
    document: ModelDocument, entity: Entity, packages: Iterable[ManagedPackage]
) -> list[lsp.Location]:
    """The places of generated code whose markers name an element of a model."""
    wanted = set(marker_names(document, entity))
    found = []
    for package in packages:
        for text in _generated(package):
            for element in elements(text.source.text):
                if element.name in wanted:
                    found.append(lsp.Location(text.uri, _lines(text, element)))
    return found


def in_model(text: Text, position: lsp.Position, document: ModelDocument) -> list[lsp.Location]:
    """The element of a model that the innermost marker around a place of code names."""
    line = position.line + 1
    around = [e for e in elements(text.source.text) if line in e.lines]
    for element in sorted(around, key=lambda e: len(e.lines)):
        for each in document.occurrences:
            if each.declares is None:
                continue
            if element.name in marker_names(document, each.entity):
                return [lsp.Location(document.uri, document.range(each.span))]
    return []


def _generated(package: ManagedPackage) -> Iterator[Text]:
    try:
        names = read_record(package.root).files
    except RebsyncError:
        return
    for name in names:
        path = Path(package.root, name).absolute()
        if name.endswith(CODE):
            try:
                yield Text(path.as_uri(), read_source(str(path)))
            except RebsyncError:
                continue


def marker_names(document: ModelDocument, entity: Entity) -> Iterator[str]:
    """How markers name an element: those of overridden servers each have a class of their own."""
    owners = [entity.owner]
    if entity.kind in ("msgsrv", "method"):
        found = document.families.items()
        owners = [
            owner for (owner, name), root in found if (root, name) == (entity.owner, entity.name)
        ]
    for owner in owners:
        yield f"{entity.kind} {f'{owner}.' if owner else ''}{entity.name}"


def _lines(text: Text, element: MarkedElement) -> lsp.Range:
    """The lines of an element behind the marker above it."""
    first = element.lines[min(1, len(element.lines) - 1)] - 1
    return lsp.Range(lsp.Position(first, 0), lsp.Position(element.lines[-1] - 1, 0))
