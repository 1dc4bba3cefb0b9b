"""The verdict on a package as it lies on the disk, and all that there is to say with it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.roundtrip.attested import is_attested
from rebsync.roundtrip.checked import Begun, Checked
from rebsync.roundtrip.digests import Standing, edited_base, is_base_whole, is_text_of, standing
from rebsync.roundtrip.kept import Kept
from rebsync.roundtrip.manifest import BASE, BASE_MODEL
from rebsync.roundtrip.model_file import model_of, moved_model
from rebsync.roundtrip.recorded import Record, read_record, told_in_step
from rebsync.roundtrip.settings import changed_settings
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from rebsync.roundtrip.difference import Comparison, Difference
    from rebsync.roundtrip.verdict import Mover


def check(kept: Kept, depth: str = "equal") -> Checked:
    """How a package stands; a RebsyncError says why that cannot be told."""
    begun = begin(kept, depth)
    return begun if isinstance(begun, Checked) else finish_proved(begun, depth)


def check_merged(kept: Kept) -> Checked:
    """The same of a package of which a merge may have left both manifests."""
    from rebsync.roundtrip.recorded_merge import read_merged_record

    begun = begin(kept, read=read_merged_record)
    return begun if isinstance(begun, Checked) else finish(begun, "equal")


def begin(
    kept: Kept, depth: str = "equal", read: Callable[[str], Record] = read_record
) -> Checked | Begun:
    """How a package stands, if digests tell. RebsyncError: it cannot be told."""
    record = _record(kept, read)
    if record is None:
        assert kept.model is not None
        return Begun(kept, kept.model, None, standing(kept, None))
    model = model_of(kept, record)
    now = standing(kept, record)
    is_known = (now.is_as_generated and not record.is_merged) or _was_in_step(record, now, depth)
    if not (is_known and _is_unchanged(model, record) and is_attested(kept.root)):
        return Begun(kept, model, record, now)
    return Checked(kept, model, record, now, findings=_about_records(kept, model, record))


def _record(kept: Kept, read: Callable[[str], Record]) -> Record | None:
    """What is recorded; nothing need be where it is known which model it is."""
    try:
        return read(kept.root)
    except RebsyncError as error:
        if kept.model is None or error.findings[0].diagnostics[0].code != "RS961":
            raise
        return None


def _was_in_step(record: Record, now: Standing, depth: str) -> bool:
    """Whether a sync left this very code, edited as it is, in step with the model of then."""
    return (
        depth == "equal"
        and bool(record.in_step)
        and record.in_step == told_in_step(record, now.told)
    )


def _is_unchanged(model: str, record: Record) -> bool:
    from rebsync.files import read_bytes

    return is_text_of(read_bytes(model), record.digest)


def _about_records(kept: Kept, model: str, record: Record) -> tuple[Findings, ...]:
    """What is to be said of where a model, its settings and the one of last time are."""
    moved = moved_model(kept, record, model)
    return (*moved, *_about_base(kept, record), *changed_settings(model, record))


def _about_base(kept: Kept, record: Record) -> tuple[Findings, ...]:
    """A base model that is missing or not as recorded: without it nobody knows who has moved."""
    if is_base_whole(kept, record):
        return ()
    message = "the model as of the last time in step is missing, or not as recorded"
    hint = "`rebsync generate` writes it anew, once model and code are in step"
    found = Diagnostic("RS964", NOWHERE, message, hint, severity=Severity.WARNING)
    return (Findings(Source(f"{kept.root}/{BASE_MODEL}", ""), (found,)),)


def _edited_base(kept: Kept, record: Record) -> Iterator[Findings]:
    """The texts that were generated, as far as somebody has edited what is kept of them.

    They count where code and model are compared: as long as neither has changed, nothing does.
    """
    for name in edited_base(kept, record):
        message = "this is kept as it was generated, and has been edited"
        hint = "`rebsync generate` writes it anew, once model and code are in step"
        found = Diagnostic("RS964", NOWHERE, message, hint, severity=Severity.WARNING)
        yield Findings(Source(f"{kept.root}/{BASE}{name}", ""), (found,))


def _refuse_dialect(kept: Kept, record: Record | None) -> None:
    """Code that cannot be read must not look as if it said nothing."""
    from rebsync.config import TARGETS

    target = record.options.get("target", TARGETS[0]) if record is not None else TARGETS[0]
    if target not in TARGETS:
        message = f'code in "{target}" cannot be read'
        hint = f"this rebsync knows {', '.join(TARGETS)}"
        raise RebsyncError.of(kept.root, "RS709", message, hint)


def finish_proved(begun: Begun, depth: str) -> Checked:
    """The same as `finish`; undetermined where the records of the package cannot be believed."""
    from rebsync.roundtrip.attested import as_far_as_proved

    return as_far_as_proved(finish(begun, depth))


def finish(begun: Begun, depth: str) -> Checked:
    """How a package stands, from its models. RebsyncError: one of these cannot be read."""
    from rebsync.roundtrip.judged import judged
    from rebsync.roundtrip.lacking import lacking
    from rebsync.roundtrip.runtime import edited
    from rebsync.roundtrip.verdict import undetermined

    kept, model, record, now = begun.kept, begun.model, begun.record, begun.standing
    _refuse_dialect(kept, record)
    has_base = record is not None and is_base_whole(kept, record)
    found = judged(kept, model, record.digest if record and has_base else None, now, depth)
    drift, findings = found.drift, found.findings
    if record is not None:
        unknown = (*edited(kept, record, now), *lacking(kept, record, now))
        if found.of_code is not None:
            odd, changes = _odd(begun, record, found.of_code)
            unknown += odd
            drift = replace(drift, differences=(*drift.differences, *changes))
        drift = undetermined(drift) if unknown else drift
        records = (*_about_records(kept, model, record), *_edited_base(kept, record))
        findings = (*records, *findings, *unknown)
        return _as_sync_says(Checked(kept, model, record, now, drift, findings), record)
    return Checked(kept, model, record, now, drift, findings)


def _as_sync_says(checked: Checked, record: Record) -> Checked:
    """The same, undetermined where `rebsync sync` takes nothing out of the model for a lost file.

    It would go on to generate the file anew, or wait until it parses.
    """
    from rebsync.roundtrip.difference import Changed, Comparison, Removed
    from rebsync.roundtrip.verdict import undetermined

    drift = checked.drift
    apart = tuple(d for d, _ in drift.differences) if drift is not None else ()
    of_system = (d.element.kind in ("rebec", "env") and isinstance(d, Changed) for d in apart)
    if drift is None or not (any(isinstance(d, Removed) for d in apart) or any(of_system)):
        return checked
    from rebsync.roundtrip.gone import Gone
    from rebsync.roundtrip.models import code_given

    gone, code = Gone(checked, record), code_given(checked.kept, checked.standing).given
    causes = (*gone.without_cause(Comparison(apart), code.model), *gone.unparsed())
    if not causes:
        return checked
    told = {(f.source.path, d) for f in checked.findings for d in f.diagnostics}
    new = [*causes, *gone.files()]
    left = tuple(f for f in new if not {(f.source.path, d) for d in f.diagnostics} <= told)
    findings = (*checked.findings, *dict.fromkeys(left))
    return replace(checked, drift=undetermined(drift), findings=findings)


def _odd(
    begun: Begun, record: Record, of_code: Comparison
) -> tuple[tuple[Findings, ...], tuple[tuple[Difference, Mover], ...]]:
    """Where nodes are joined otherwise, as findings and as differences, unless that is accepted."""
    from rebsync.roundtrip.verdict import Mover
    from rebsync.roundtrip.wiring import odd_facts

    found = odd_facts(begun.kept, record, begun.standing, of_code)
    odd = [o for o in found if o.finding.diagnostics[0].message not in record.accepted]
    if not odd:
        return (), ()
    from rebsync.roundtrip.models import model_given
    from rebsync.roundtrip.wiring_told import told

    changes = told(odd, model_given(begun.model))
    return tuple(o.finding for o in odd), tuple((change, Mover.CODE) for change in changes)
