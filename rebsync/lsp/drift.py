"""What `rebsync check` finds in a package, as diagnostics and actions at the places of code."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types as lsp

from rebsync.diagnostics import RebsyncError
from rebsync.files import MODEL, PROPERTY, read_source
from rebsync.lsp.document import Text
from rebsync.lsp.findings import as_diagnostic
from rebsync.records import dataclass
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.verdict.check_all import check_all
from rebsync.roundtrip.verdict.outcome import Outcome
from rebsync.roundtrip.verdict.report.text import findings_of
from rebsync.roundtrip.verdict.result import CheckResult

SYNC = "rebsync.sync"
_INTO_MODEL, _FROM_MODEL = "Take into the model", "Take from the model"
_ACTIONS = {
    "RS951": ((_FROM_MODEL, "markers"),),
    "RS952": ((_INTO_MODEL, "markers"),),
    "RS953": ((_INTO_MODEL, "theirs"), (_FROM_MODEL, "ours")),
}


@dataclass(frozen=True, slots=True)
class PackageDrift:
    """The diagnostics of a package by the addresses of its files, its model included."""

    root: str
    diagnostics: dict[str, list[lsp.Diagnostic]]


def drift_of(package: ManagedPackage) -> PackageDrift:
    """Checks a package as it is on the disk."""
    (checked,) = check_all([package], "equal")
    if isinstance(checked, CheckResult):
        outcome = Outcome(package.root, checked)
    else:
        outcome = Outcome(package.root, None, RebsyncError(checked))
    by_file: dict[str, list[lsp.Diagnostic]] = {}
    for found in findings_of(outcome):
        uri = Path(found.source.path).absolute().as_uri()
        text = Text(uri, found.source)
        by_file.setdefault(uri, []).extend(as_diagnostic(text, d) for d in found.diagnostics)
    return PackageDrift(package.root, by_file)


def sync_actions(drift: PackageDrift, uri: str, at: lsp.Range) -> Iterator[lsp.CodeAction]:
    """What `rebsync sync` can do about what is different at a range."""
    for found in drift.diagnostics.get(uri, ()):
        if not (found.range.start <= at.end and at.start <= found.range.end):
            continue
        for title, favour in _ACTIONS.get(str(found.code), ()):
            command = lsp.Command(title, SYNC, arguments=[drift.root, favour])
            kind = lsp.CodeActionKind.QuickFix
            shown = f"{title} (rebsync sync)"
            yield lsp.CodeAction(shown, kind=kind, diagnostics=[found], command=command)


def sync_command(root: str, favour: str) -> list[str]:
    """The arguments of `rebsync` for a command of `sync_actions`."""
    return ["sync", root, "--conflict", favour]


def belongs_to(path: str, root: str) -> bool:
    """Whether a file is of a package, or a model or property file that may be its own."""
    return Path(path).is_relative_to(root) or path.endswith((MODEL, PROPERTY))


def is_saved(path: str, text: str) -> bool:
    """Whether an open text is as on the disk."""
    try:
        return read_source(path).text == text
    except RebsyncError:
        return False
