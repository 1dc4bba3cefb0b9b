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
from rebsync.roundtrip.settings import changed_settings
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from rebsync.roundtrip.verdict import Drift


_READ = frozenset({"ros1-cpp", "ros2-cpp"})


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


def check(kept: Kept, depth: str = "equal") -> Checked:
    """How a package stands; a RebsyncError says why that cannot be told."""
    record = _record(kept)
    if record is None:
        assert kept.model is not None
        return _compared(kept, kept.model, None, standing(kept, None), depth)
    model = model_of(kept, record)
    now = standing(kept, record)
    if not (now.is_as_generated and _is_unchanged(model, record)):
        return _compared(kept, model, record, now, depth)
    findings = (*changed_settings(model, record), *_about_base(kept, record))
    return Checked(kept, model, record, now, findings=findings)


def _record(kept: Kept) -> Record | None:
    """What is recorded; nothing need be where it is known which model it is."""
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
    """A base model that is missing or not as recorded: without it nobody knows who has moved."""
    if is_base_whole(kept, record):
        return ()
    message = "the model as of the last time in step is missing, or not as recorded"
    hint = "`rebsync generate` writes it anew, once model and code are in step"
    found = Diagnostic("RS964", NOWHERE, message, hint, severity=Severity.WARNING)
    return (Findings(Source(f"{kept.root}/{BASE_MODEL}", ""), (found,)),)


def _refuse_dialect(kept: Kept, record: Record | None) -> None:
    """Code that cannot be read back yet must not look as if it said nothing."""
    target = record.options.get("target", "ros1-cpp") if record is not None else "ros1-cpp"
    if record is not None and record.options.get("targets"):
        target = "several languages"
    if target not in _READ:
        message = f"code in {target} cannot be read yet"
        hint = "`rebsync generate` still takes changes of the model into it"
        raise RebsyncError.of(kept.root, "RS709", message, hint)


def _compared(kept: Kept, model: str, record: Record | None, now: Standing, depth: str) -> Checked:
    _refuse_dialect(kept, record)
    from rebsync.roundtrip.judged import judged
    from rebsync.roundtrip.runtime import edited
    from rebsync.roundtrip.verdict import undetermined
    from rebsync.roundtrip.wiring import odd_wiring

    has_base = record is not None and is_base_whole(kept, record)
    found = judged(kept, model, record.digest if record and has_base else None, now, depth)
    drift, findings = found.drift, found.findings
    if record is not None:
        unknown = edited(kept, record, now)
        if found.of_code is not None:
            odd = odd_wiring(kept, record, now, found.of_code)
            unknown += tuple(f for f in odd if f.diagnostics[0].message not in record.accepted)
        drift = undetermined(drift) if unknown else drift
        about = (*_about_base(kept, record), *changed_settings(model, record))
        findings = (*about, *findings, *unknown)
    return Checked(kept, model, record, now, drift, findings)
