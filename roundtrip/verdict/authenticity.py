"""Proves the records of a package: its files are those that its own model and settings generate.

A verdict that is told from records that are neither sealed here nor proved is undetermined.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rebsync.config import Config, config_of_record
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.files import read_bytes, read_source
from rebsync.roundtrip.package.digests import digest_of, is_text_of
from rebsync.roundtrip.package.generation import generated
from rebsync.roundtrip.package.manifest import BASE, BASE_MODEL, MANIFEST
from rebsync.roundtrip.package.record import Record, recorded_base, told_in_step
from rebsync.roundtrip.package.seals import attest, is_attested
from rebsync.roundtrip.package.shared_runtime import shared_runtime
from rebsync.roundtrip.verdict.drift import Verdict, undetermined
from rebsync.roundtrip.verdict.result import CheckResult
from rebsync.source import NOWHERE, Source
from rebsync.terminal import encoded

_MESSAGE = "these records are not what this rebsync writes for the model that they hold"
_HINT = (
    "if another rebsync made them, `rebsync generate` writes them anew; if somebody changed them,"
    " look at what git shows of .rebsync/"
)


def undetermined_unless_authentic(checked: CheckResult) -> CheckResult:
    """The same, undetermined where a package's records cannot be believed.

    Records that are proved, and say nothing of code that is not there, are attested.
    """
    record, root = checked.record, checked.package.root
    if record is None or checked.drift is None:
        return checked
    base = recorded_base(root, BASE)
    is_whole = all(is_text_of(encoded(t), record.files.get(n, "")) for n, t in base.items())
    if is_whole and is_attested(root):
        return checked
    if is_whole and _is_genuine(checked, record):
        if not record.in_step or _is_in_step(checked, record):
            attest(read_source(f"{root}/{MANIFEST}").text)
        return checked
    unproved = Diagnostic("RS950", NOWHERE, _MESSAGE, _HINT)
    findings = (Findings(Source(f"{root}/{MANIFEST}", ""), (unproved,)), *checked.findings)
    return replace(checked, drift=undetermined(checked.drift), findings=findings)


def _is_in_step(checked: CheckResult, record: Record) -> bool:
    """Whether the code that a manifest names as in step is this code, and it is."""
    drift = checked.drift
    told = (d for f in checked.findings for d in f.diagnostics)
    agrees = drift is not None and drift.verdict is Verdict.IN_STEP
    agrees = agrees and all(d.severity is Severity.NOTE for d in told)
    return agrees and record.in_step == told_in_step(record, checked.state.told)


def _is_genuine(checked: CheckResult, record: Record) -> bool:
    """Whether a manifest names the very files that its model and settings generate."""
    config = config_of_record(record.options) or Config()
    try:
        files = generated(_base(checked, record), config, Path(record.model).stem)
    except RebsyncError:
        return False
    files |= shared_runtime(config)
    return {path: digest_of(encoded(text)) for path, text in files.items()} == record.files


def _base(checked: CheckResult, record: Record) -> Source:
    """The model as of the last time in step: today's, where that is lost and has not changed."""
    path = f"{checked.package.root}/{BASE_MODEL}"
    for each in (path, checked.model):
        try:
            if is_text_of(read_bytes(each), record.digest):
                return read_source(each)
        except RebsyncError:
            continue
    raise RebsyncError.of(path, "RS964", "the model as of the last time in step is missing")
