"""The three models of a verdict: the one of last time, today's, and the one that the code tells.

What was read once is kept in the user's cache, so that only what has changed is read again.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rebsync import model as m
from rebsync.diagnostics import Findings, RebsyncError
from rebsync.files import read_source
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Place
from rebsync.roundtrip.diff.operands import SourcedModel, UnreadPlace
from rebsync.roundtrip.package.cache.store import key_of, load, save
from rebsync.roundtrip.package.digests import digest_of
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.record import conflict_in
from rebsync.roundtrip.package.state import PackageState
from rebsync.roundtrip.package.units import as_one
from rebsync.source import Source
from rebsync.terminal import encoded

if TYPE_CHECKING:
    from rebsync.reverse.findings import Finding


@dataclass(frozen=True, slots=True)
class CodeModel:
    """What the code of a package tells: a model, and what is not in it exactly.

    `findings` are all these places, of which those in `given.unread` the model lacks.
    """

    given: SourcedModel
    findings: tuple[Findings, ...]


def read_model(path: str) -> SourcedModel:
    """The model in a file. RebsyncError: it cannot be read, or has mistakes."""
    source = read_source(path)
    key = key_of("model", digest_of(encoded(source.text)))
    model = load(key, m.Model)
    if model is None:
        model = parsed(source)
        save(key, model)
    return SourcedModel(model, source)


def parsed(source: Source) -> m.Model:
    """The model that a text is. RebsyncError: it has mistakes, or conflicts of a merge."""
    if (found := conflict_in(source)) is not None:
        raise RebsyncError([found])
    from rebsync.grammars.parser import parse_model
    from rebsync.static import analyse

    parsed = parse_model(source)
    analysis = analyse(parsed.model, incomplete=not parsed.ok)
    findings = Findings(source, (*parsed.diagnostics, *analysis.diagnostics))
    if findings.errors:
        raise RebsyncError([Findings(source, tuple(dict.fromkeys(findings.errors)))])
    return parsed.model


def read_code(package: ManagedPackage, state: PackageState) -> CodeModel:
    """What the code of a package tells. RebsyncError: a merge left conflicts in it."""
    key = key_of("code", package.root, *state.told)
    code = load(key, CodeModel)
    if code is None:
        code = _extracted(state)
        save(key, code)
    return code


def _extracted(state: PackageState) -> CodeModel:
    from rebsync.reverse.files.reading import read
    from rebsync.reverse.recovery import extract
    from rebsync.roundtrip.package.cache.classes import ClassCache

    chosen = read(as_one(state.listing))
    if conflicts := [c for s in chosen.files.values() if (c := conflict_in(s)) is not None]:
        raise RebsyncError(conflicts)
    extracted = extract(chosen.files, memory=ClassCache())
    return code_model(state.listing.root, extracted.model, (*chosen.findings, *extracted.findings))


def code_model(
    path: str, model: m.Model, findings: Sequence[Finding], *, partial: bool = False
) -> CodeModel:
    """An extracted model, whose spans without a file are of `path`, with what is not in it."""
    from rebsync.reverse.findings import Grade
    from rebsync.reverse.report import diagnostics

    unread = tuple(
        UnreadPlace(Place(f.source, f.span), f.why, f.within)
        for f in findings
        if f.grade is Grade.UNREADABLE
    )
    given = SourcedModel(model, Source(path, ""), unread, partial)
    return CodeModel(given, tuple(diagnostics(findings)))
