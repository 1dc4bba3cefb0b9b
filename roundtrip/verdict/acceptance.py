"""Findings that a user has accepted, with a reason, in `.rebsync/accepted.toml`.

Accepted are places of which no verdict can be given, never what is known to differ. An entry holds
for the place as it was looked at: for the text of its lines, and for all that code and model say of
the element around it, which the place may stand for. What changes there brings the finding back.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from rebsync import model as m
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.files import source_below
from rebsync.printing import print_member, print_model
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Undetermined
from rebsync.roundtrip.package.digests import digest_of
from rebsync.roundtrip.package.manifest import ACCEPTED
from rebsync.roundtrip.package.models import read_code, read_model
from rebsync.roundtrip.verdict.drift import Drift, Verdict
from rebsync.roundtrip.verdict.result import AcceptedFinding, CheckResult
from rebsync.source import NOWHERE, Source, Span
from rebsync.terminal import encoded
from rebsync.toml import Table, read_toml

_CODES = frozenset({"RS941", "RS956"})
_WITHIN = re.compile(r" \(in ([\w.]+)\)\Z")
_KEYS = ("code", "path", "finding", "place", "reason")
_HEAD = """\
# Findings of `rebsync check` that were looked at and accepted (`rebsync accept`). To take one back,
# delete its entry. One that has changed since comes back by itself.
"""


def read_entries(root: str) -> tuple[AcceptedFinding, ...]:
    """The entries of a package. RebsyncError: the file is damaged, or cannot be read."""
    source = source_below(root, ACCEPTED)
    if source is None:
        return ()
    table = read_toml(source)
    found = tuple(map(_entry, table.tables("accepted")))
    table.finish()
    if table.diagnostics:
        raise RebsyncError([Findings(source, tuple(table.diagnostics))])
    return found


def _entry(table: Table) -> AcceptedFinding:
    for key in _KEYS:
        table.require(key)
    values = [table.text(key) or "" for key in _KEYS]
    table.finish()
    return AcceptedFinding(*values)


def entries_text(entries: Iterable[AcceptedFinding]) -> str:
    """The text of the file with some entries, each once, in a lasting order."""
    ordered = sorted(entries, key=lambda e: (e.path, e.finding, e.place, e.reason))
    tables = (
        "\n[[accepted]]\n" + "".join(f"{key} = {_quoted(getattr(e, key))}\n" for key in _KEYS)
        for e in ordered
    )
    return _HEAD + "".join(tables)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007F")


# --- findings -----------------------------------------------------------------------------------


def acceptable(checked: CheckResult) -> Iterator[tuple[Findings, Diagnostic, AcceptedFinding]]:
    """The findings that may be accepted, each with its entry but for the reason."""
    places = _Places(checked)
    known = {
        (place.source.path, place.span)
        for difference, _ in (checked.drift.differences if checked.drift is not None else ())
        if not isinstance(difference, Undetermined) and (place := difference.right) is not None
    }
    for found in checked.findings:
        for each in found.diagnostics:
            is_open = each.code in _CODES and each.severity is Severity.ERROR
            is_known = each.code == "RS956" and (found.source.path, each.span) in known
            if is_open and not is_known and each.span != NOWHERE and found.source.text:
                path = Path(found.source.path)
                if path.is_relative_to(checked.package.root):
                    inside = path.relative_to(checked.package.root).as_posix()
                    digest = places.digest(found.source, each)
                    yield found, each, AcceptedFinding(each.code, inside, each.message, digest)


@dataclass(frozen=True, slots=True)
class _Places:
    """Tells the places of findings of a package by digests."""

    checked: CheckResult

    def digest(self, source: Source, found: Diagnostic) -> str:
        """A digest of what a finding is about, which any change of that changes."""
        within = _WITHIN.search(found.message) if found.code == "RS941" else None
        if within is None:
            today = read_model(self.checked.model).model
            parts = [source.text, print_model(today) if found.code == "RS941" else ""]
        else:
            parts = [_lines(source, found.span), *self._elements(within[1])]
        return digest_of(encoded("\0".join(parts)))[:32]

    def _elements(self, path: str) -> Iterator[str]:
        """What code and model say of an element, which what is not known may stand for."""
        checked = self.checked
        code = read_code(checked.package, checked.state).given.model
        for model in (code, read_model(checked.model).model):
            yield "".join(_printed(model, path))


def _printed(model: m.Model, path: str) -> Iterator[str]:
    owner, _, name = path.partition(".")
    for each in model.classes:
        if each.name == owner and isinstance(each, m.ReactiveClass):
            yield from (print_member(x) for x in each.members if _is_called(x, name))


def _is_called(member: m.ClassMember, name: str) -> bool:
    """Whether a member has a name; without one all are meant."""
    return not name or getattr(member, "name", None) == name


def _lines(source: Source, span: Span) -> str:
    """The lines of a place without layout."""
    start = source.text.rfind("\n", 0, span.start) + 1
    end = source.text.find("\n", max(span.end - 1, span.start))
    return " ".join(source.text[start : end if end >= 0 else None].split())


# --- verdicts -----------------------------------------------------------------------------------


def with_accepted(checked: CheckResult) -> CheckResult:
    """The same without what was accepted; in step where nothing else kept that from being told."""
    entries = read_entries(checked.package.root)
    if not entries or checked.drift is None:
        return checked
    waiting = Counter(entry.key for entry in entries)
    taken: dict[Findings, set[Diagnostic]] = {}
    accepted = list[AcceptedFinding]()
    reasons = {entry.key: entry.reason for entry in entries}
    for found, each, entry in acceptable(checked):
        if waiting[entry.key] > 0:
            waiting[entry.key] -= 1
            taken.setdefault(found, set()).add(each)
            accepted.append(replace(entry, reason=reasons[entry.key]))
    left = tuple(_without(checked.findings, taken))
    stale = _stale(checked.package.root, (e for e in entries if waiting[e.key] > 0))
    drift = checked.drift
    if accepted and not any(f.errors for f in left) and _is_only_unknown(drift):
        drift = Drift(Verdict.IN_STEP)
    return replace(checked, drift=drift, findings=(*left, *stale), accepted=tuple(accepted))


def _without(
    findings: Iterable[Findings], taken: dict[Findings, set[Diagnostic]]
) -> Iterator[Findings]:
    for found in findings:
        left = tuple(d for d in found.diagnostics if d not in taken.get(found, ()))
        if left or not found.diagnostics:
            yield replace(found, diagnostics=left)


def _is_only_unknown(drift: Drift) -> bool:
    return drift.verdict is Verdict.UNDETERMINED and all(
        isinstance(difference, Undetermined) for difference, _ in drift.differences
    )


def _stale(root: str, entries: Iterable[AcceptedFinding]) -> Iterator[Findings]:
    """A note for entries that are for nothing any more."""
    for entry in dict.fromkeys(entries):
        message = f'what was accepted of {entry.path} is not there as it was: "{entry.finding}"'
        hint = "delete the entry; what is there now is to be accepted anew"
        note = Diagnostic("RS945", NOWHERE, message, hint, severity=Severity.NOTE)
        yield Findings(Source(f"{root}/{ACCEPTED}", ""), (note,))
