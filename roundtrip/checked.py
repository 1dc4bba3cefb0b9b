"""The verdict on a package as it lies on the disk, and all that there is to say with it."""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.records import dataclass
from rebsync.roundtrip.digests import Standing, is_base_whole, is_text_of, standing
from rebsync.roundtrip.manifest import BASE_MODEL
from rebsync.roundtrip.model_file import model_of
from rebsync.roundtrip.packages import Kept
from rebsync.roundtrip.recorded import Record, read_record
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from rebsync.roundtrip.models import Code
    from rebsync.roundtrip.sides import Given
    from rebsync.roundtrip.verdict import Drift


@dataclass(frozen=True, slots=True)
class Checked:
    """A package, and how it stands to its model.

    `drift` is None where digests alone tell that both are in step. `findings` are the places of
    the code that a model cannot tell exactly, and whatever else is to be put right.
    """

    kept: Kept
    model: str
    record: Record | None
    standing: Standing
    drift: Drift | None = None
    findings: tuple[Findings, ...] = field(default=())
    code: Code | None = None
    today: Given | None = None


def check(kept: Kept, depth: str = "equal") -> Checked:
    """How a package stands; a RebsyncError says why that cannot be told."""
    record = _record(kept)
    model = kept.model if record is None or kept.model is not None else model_of(kept, record)
    assert model is not None
    now = standing(kept, record)
    if record is not None and now.is_as_generated and _is_unchanged(model, record):
        return Checked(kept, model, record, now, findings=_about_base(kept, record))
    return _compared(kept, model, record, now, depth)


def _record(kept: Kept) -> Record | None:
    """What is recorded; nothing need be where a user says which model it is."""
    try:
        return read_record(kept.root)
    except RebsyncError as error:
        if kept.model is None or error.findings[0].diagnostics[0].code != "RS961":
            raise
        return None


def _is_unchanged(model: str, record: Record) -> bool:
    from rebsync.files import read_bytes

    return is_text_of(read_bytes(model), record.digest)


def _about_base(kept: Kept, record: Record) -> tuple[Findings, ...]:
    """A base model that is missing or not as recorded costs nothing yet, but it will."""
    if is_base_whole(kept, record):
        return ()
    message = "the model as of the last time in step is missing, or not as recorded"
    hint = "`rebsync generate` writes it anew, now that model and code are in step"
    found = Diagnostic("RS964", NOWHERE, message, hint, severity=Severity.WARNING)
    return (Findings(Source(f"{kept.root}/{BASE_MODEL}", ""), (found,)),)


def _compared(kept: Kept, model: str, record: Record | None, now: Standing, depth: str) -> Checked:
    from rebsync.roundtrip.difference import Depth
    from rebsync.roundtrip.differences import compare
    from rebsync.roundtrip.models import base_given, code_given, model_given
    from rebsync.roundtrip.runtime import edited
    from rebsync.roundtrip.verdict import judge, undetermined

    today = model_given(model)
    findings: list[Findings] = []
    base = None
    try:
        base = base_given(kept)
    except RebsyncError as error:
        findings += map(_as_warning, error.findings)
    code = code_given(kept, now)
    how = Depth(depth)
    of_model = compare(base, today, how) if base is not None else None
    of_code = compare(base, code.given, how) if base is not None else None
    drift = judge(compare(today, code.given, how), of_model, of_code)
    unknown = edited(kept, record, now)
    if unknown:
        drift = undetermined(drift)
    findings += [*code.findings, *unknown]
    return Checked(kept, model, record, now, drift, tuple(findings), code, today)


def _as_warning(findings: Findings) -> Findings:
    from dataclasses import replace

    changed = (replace(d, severity=Severity.WARNING) for d in findings.diagnostics)
    return replace(findings, diagnostics=tuple(changed))
