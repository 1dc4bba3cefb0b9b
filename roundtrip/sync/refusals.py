"""Why `rebsync sync` would refuse what has moved; kept in the user's cache until something moves.

`rebsync check` tells it beside the verdict, and is asked again and again.
"""

from __future__ import annotations

from rebsync.diagnostics import Findings
from rebsync.files import read_bytes
from rebsync.records import dataclass
from rebsync.roundtrip.package.cache.store import key_of, load, save
from rebsync.roundtrip.package.digests import digest_of
from rebsync.roundtrip.verdict.result import CheckResult

_MOVED = ("code ahead", "both moved")


@dataclass(frozen=True, slots=True)
class CachedRefusals:
    """What makes no model of the language, as findings; empty where a sync takes all."""

    findings: tuple[Findings, ...]


def cached_refusals(checked: CheckResult) -> tuple[Findings, ...]:
    """Why the changes of a package make no model; nothing where the code has not moved."""
    if checked.drift is None or checked.drift.verdict.value not in _MOVED:
        return ()
    base = checked.record.digest if checked.record is not None else ""
    told = (checked.package.root, checked.model, digest_of(read_bytes(checked.model)), base or "")
    key = key_of("refused", *told, *checked.state.told)
    found = load(key, CachedRefusals)
    if found is None:
        from rebsync.roundtrip.sync.sync import makes_no_model

        found = CachedRefusals(makes_no_model(checked))
        save(key, found)
    return found.findings
