"""The verdict on a package as it lies on the disk, and all that there is to say with it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.roundtrip.package.digests import is_text_of
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE, BASE_MODEL
from rebsync.roundtrip.package.model_file import model_of, moved_model
from rebsync.roundtrip.package.record import Record, read_record, told_in_step
from rebsync.roundtrip.package.seals import is_attested
from rebsync.roundtrip.package.state import PackageState, edited_base, is_base_whole, package_state
from rebsync.roundtrip.verdict.result import CheckResult, StartedCheck
from rebsync.roundtrip.verdict.settings import changed_settings
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from rebsync.roundtrip.diff.difference import Changed, Comparison
    from rebsync.roundtrip.verdict.wiring.facts import Odd


def check(package: ManagedPackage, depth: str = "equal") -> CheckResult:
    """How a package stands; a RebsyncError says why that cannot be told."""
    begun = begin(package, depth)
    return begun if isinstance(begun, CheckResult) else finish_proved(begun, depth)


def check_merged(package: ManagedPackage) -> CheckResult:
    """The same of a package of which a merge may have left both manifests."""
    from rebsync.roundtrip.package.record_merge import read_merged_record

    begun = begin(package, read=read_merged_record)
    return begun if isinstance(begun, CheckResult) else finish(begun, "equal")


def begin(
    package: ManagedPackage, depth: str = "equal", read: Callable[[str], Record] = read_record
) -> CheckResult | StartedCheck:
    """How a package stands, if digests tell. RebsyncError: it cannot be told."""
    record = _record(package, read)
    if record is None:
        assert package.model is not None
        return StartedCheck(package, package.model, None, package_state(package, None))
    model = model_of(package, record)
    now = package_state(package, record)
    is_known = (now.is_as_generated and not record.is_merged) or _was_in_step(record, now, depth)
    if not (is_known and _is_unchanged(model, record) and is_attested(package.root)):
        return StartedCheck(package, model, record, now)
    return CheckResult(package, model, record, now, findings=_about_records(package, model, record))


def _record(package: ManagedPackage, read: Callable[[str], Record]) -> Record | None:
    """What is recorded; nothing need be where it is known which model it is."""
    try:
        return read(package.root)
    except RebsyncError as error:
        if package.model is None or error.findings[0].diagnostics[0].code != "RS961":
            raise
        return None


def _was_in_step(record: Record, now: PackageState, depth: str) -> bool:
    """Whether a sync left this very code, edited as it is, in step with the model of then."""
    return (
        depth == "equal"
        and bool(record.in_step)
        and record.in_step == told_in_step(record, now.told)
    )


def _is_unchanged(model: str, record: Record) -> bool:
    from rebsync.files import read_bytes

    return is_text_of(read_bytes(model), record.digest)


def _about_records(package: ManagedPackage, model: str, record: Record) -> tuple[Findings, ...]:
    """What is to be said of where a model, its settings and the one of last time are."""
    moved = moved_model(package, record, model)
    return (*moved, *_about_base(package, record), *changed_settings(model, record))


def _about_base(package: ManagedPackage, record: Record) -> tuple[Findings, ...]:
    """A base model that is missing or not as recorded: without it nobody knows who has moved."""
    if is_base_whole(package, record):
        return ()
    message = "the model as of the last time in step is missing, or not as recorded"
    hint = "`rebsync generate` writes it anew, once model and code are in step"
    found = Diagnostic("RS964", NOWHERE, message, hint, severity=Severity.WARNING)
    return (Findings(Source(f"{package.root}/{BASE_MODEL}", ""), (found,)),)


def _edited_base(package: ManagedPackage, record: Record) -> Iterator[Findings]:
    """The texts that were generated, as far as somebody has edited what is kept of them.

    They count where code and model are compared: as long as neither has changed, nothing does.
    """
    for name in edited_base(package, record):
        message = "this is kept as it was generated, and has been edited"
        hint = "`rebsync generate` writes it anew, once model and code are in step"
        found = Diagnostic("RS964", NOWHERE, message, hint, severity=Severity.WARNING)
        yield Findings(Source(f"{package.root}/{BASE}{name}", ""), (found,))


def _refuse_dialect(package: ManagedPackage, record: Record | None) -> None:
    """Code that cannot be read must not look as if it said nothing."""
    from rebsync.config import TARGETS

    target = record.options.get("target", TARGETS[0]) if record is not None else TARGETS[0]
    if target not in TARGETS:
        message = f'code in "{target}" cannot be read'
        hint = f"this rebsync knows {', '.join(TARGETS)}"
        raise RebsyncError.of(package.root, "RS709", message, hint)


def finish_proved(begun: StartedCheck, depth: str) -> CheckResult:
    """The same as `finish`; undetermined where the records of the package cannot be believed."""
    from rebsync.roundtrip.verdict.authenticity import undetermined_unless_authentic

    return undetermined_unless_authentic(finish(begun, depth))


def finish(begun: StartedCheck, depth: str) -> CheckResult:
    """How a package stands, from its models. RebsyncError: one of these cannot be read."""
    from rebsync.roundtrip.verdict.cached import cached_verdict
    from rebsync.roundtrip.verdict.drift import undetermined, with_changes_of_code
    from rebsync.roundtrip.verdict.missing_files import missing_files
    from rebsync.roundtrip.verdict.runtime import edited

    package, model, record, now = begun.package, begun.model, begun.record, begun.state
    _refuse_dialect(package, record)
    has_base = record is not None and is_base_whole(package, record)
    found = cached_verdict(
        package, model, record.digest if record and has_base else None, now, depth
    )
    drift, findings = found.drift, found.findings
    if record is not None:
        renamed = found.of_code.renamed_classes if found.of_code is not None else {}
        unknown = [*edited(package, record, now, renamed), *missing_files(package, record, now)]
        odd = _odd(begun, record, found.of_code) if found.of_code is not None else []
        drift = with_changes_of_code(drift, tuple(c for _, changes in odd for c in changes))
        known = [o.finding for o, changes in odd if o.is_known and changes]
        unknown += [o.finding for o, _ in odd if o.finding not in known]
        drift = undetermined(drift) if unknown else drift
        records = (*_about_records(package, model, record), *_edited_base(package, record))
        findings = (*records, *findings, *unknown, *known)
        return _as_sync_says(CheckResult(package, model, record, now, drift, findings), record)
    return CheckResult(package, model, record, now, drift, findings)


def _as_sync_says(checked: CheckResult, record: Record) -> CheckResult:
    """The same, undetermined where `rebsync sync` takes nothing out of the model for a lost file.

    It would go on to generate the file anew, or wait until it parses.
    """
    from rebsync.roundtrip.diff.difference import Changed, Comparison, Removed
    from rebsync.roundtrip.verdict.drift import undetermined

    drift = checked.drift
    apart = tuple(d for d, _ in drift.differences) if drift is not None else ()
    of_system = (d.element.kind in ("rebec", "env") and isinstance(d, Changed) for d in apart)
    if drift is None or not (any(isinstance(d, Removed) for d in apart) or any(of_system)):
        return checked
    from rebsync.roundtrip.package.models import read_code
    from rebsync.roundtrip.verdict.missing_sources import MissingSources

    gone, code = MissingSources(checked, record), read_code(checked.package, checked.state).given
    causes = (*gone.without_cause(Comparison(apart), code.model), *gone.unparsed())
    if not causes:
        return checked
    told = {(f.source.path, d) for f in checked.findings for d in f.diagnostics}
    new = [*causes, *gone.files()]
    left = tuple(f for f in new if not {(f.source.path, d) for d in f.diagnostics} <= told)
    findings = (*checked.findings, *dict.fromkeys(left))
    return replace(checked, drift=undetermined(drift), findings=findings)


def _odd(
    begun: StartedCheck, record: Record, of_code: Comparison
) -> list[tuple[Odd, tuple[Changed, ...]]]:
    """Where nodes are joined otherwise, unless that is accepted; the differences that each is.

    There are none where the model has no element for it.
    """
    from rebsync.roundtrip.verdict.wiring.facts import odd_facts

    found = odd_facts(begun.package, record, begun.state, of_code)
    left = [o for o in found if o.finding.diagnostics[0].message not in record.accepted]
    if not left:
        return []
    from rebsync.roundtrip.package.models import read_model
    from rebsync.roundtrip.verdict.wiring.differences import told

    today = read_model(begun.model)
    return [(o, told([o], today)) for o in left]
