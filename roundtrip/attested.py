"""Which records of packages are believed: those that this user's rebsync wrote or has proved.

`.rebsync/` is committed with the code, so that a branch can make it say anything: digests of edited
code under which nothing is looked at, or base texts that an edited run-time part equals. A manifest
that was written or proved here is known again by a seal in the user's cache. Any other is proved:
its files must be those that its own model and settings generate.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rebsync.cache import open_cache
from rebsync.config import Config, config_of_record
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.files import read_bytes, read_source
from rebsync.roundtrip.digests import digest_of, is_text_of
from rebsync.roundtrip.generated import generated
from rebsync.roundtrip.manifest import BASE, BASE_MODEL, MANIFEST
from rebsync.roundtrip.recorded import Record, recorded_base, told_in_step
from rebsync.source import NOWHERE, Source
from rebsync.terminal import encoded

if TYPE_CHECKING:
    from rebsync.roundtrip.checked import Checked

_PART = "records"
_PLACES = "models"  # where they are that no manifest leads to
_MOST = 10_000  # seals; when there are more, the older half goes
_MESSAGE = "these records are not what this rebsync writes for the model that they hold"
_HINT = (
    "if another rebsync made them, `rebsync generate` writes them anew; if somebody changed them,"
    " look at what git shows of .rebsync/"
)


def attest(manifest: str) -> None:
    """Notes that the text of a manifest is believed from now on."""
    cache = open_cache(_PART)
    if cache is not None:
        cache.store(digest_of(encoded(manifest)), b"")
        cache.tidy(_MOST)


def remember_model(root: str, manifest: str, model: str) -> None:
    """Notes for this user where the model is of a package whose manifest cannot say so."""
    cache = open_cache(_PLACES)
    if cache is not None:
        where = os.fsencode(os.path.realpath(model))
        cache.store(_place(root, digest_of(encoded(manifest))), where)
        cache.tidy(_MOST)


def remembered_model(root: str) -> str | None:
    """The real path of the model that a package was last written from, where that was noted."""
    cache = open_cache(_PLACES)
    if cache is None:
        return None
    try:
        digest = digest_of(read_bytes(f"{root}/{MANIFEST}"))
    except RebsyncError:
        return None
    found = cache.load(_place(root, digest))
    return os.fsdecode(found) if found is not None else None


def _place(root: str, digest: str) -> str:
    return digest_of(os.fsencode(os.path.realpath(root)) + digest.encode())


def is_attested(root: str) -> bool:
    """Whether the manifest of a package was written or proved here."""
    cache = open_cache(_PART)
    if cache is None:
        return False
    try:
        name = digest_of(read_bytes(f"{root}/{MANIFEST}"))
    except RebsyncError:
        return False
    return cache.load(name) is not None


def as_far_as_proved(checked: Checked) -> Checked:
    """The same, undetermined where a package's records cannot be believed.

    Records that are proved, and say nothing of code that is not there, are attested.
    """
    from rebsync.roundtrip.verdict import undetermined

    record, root = checked.record, checked.kept.root
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


def _is_in_step(checked: Checked, record: Record) -> bool:
    """Whether the code that a manifest names as in step is this code, and it is."""
    from rebsync.roundtrip.verdict import Verdict

    drift = checked.drift
    told = (d for f in checked.findings for d in f.diagnostics)
    agrees = drift is not None and drift.verdict is Verdict.IN_STEP
    agrees = agrees and all(d.severity is Severity.NOTE for d in told)
    return agrees and record.in_step == told_in_step(record, checked.standing.told)


def _is_genuine(checked: Checked, record: Record) -> bool:
    """Whether a manifest names the very files that its model and settings generate."""
    config = config_of_record(record.options) or Config()
    try:
        files = generated(_base(checked, record), config, Path(record.model).stem)
    except RebsyncError:
        return False
    return {path: digest_of(encoded(text)) for path, text in files.items()} == record.files


def _base(checked: Checked, record: Record) -> Source:
    """The model as of the last time in step: today's, where that is lost and has not changed."""
    path = f"{checked.kept.root}/{BASE_MODEL}"
    for each in (path, checked.model):
        try:
            if is_text_of(read_bytes(each), record.digest):
                return read_source(each)
        except RebsyncError:
            continue
    raise RebsyncError.of(path, "RS964", "the model as of the last time in step is missing")
