"""The three models of a package compared; kept in the user's cache as long as none has changed."""

from __future__ import annotations

from functools import partial

from rebsync.diagnostics import Findings
from rebsync.files import read_bytes
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Comparison, Depth
from rebsync.roundtrip.package.cache.store import key_of, load, save
from rebsync.roundtrip.package.digests import digest_of, is_text_of
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE_MODEL
from rebsync.roundtrip.package.state import PackageState
from rebsync.roundtrip.verdict.drift import Drift, judge


@dataclass(frozen=True, slots=True)
class CachedVerdict:
    """The verdict, what the code has changed (None without a base), and what is not exact.

    Bodies that are written otherwise than the model's and do the same are among the findings.
    """

    drift: Drift
    of_code: Comparison | None
    findings: tuple[Findings, ...]


def cached_verdict(
    package: ManagedPackage, model: str, base: str | None, now: PackageState, depth: str
) -> CachedVerdict:
    """The verdict on a package; `base` is the digest of the model of last time, if that is there.

    RebsyncError: one of the models cannot be read.
    """
    data = read_bytes(model)
    told = (package.root, model, digest_of(data), base or "", depth, *now.told)
    key = key_of("judged", *told)
    found = load(key, CachedVerdict)
    if found is None:
        found = _judged(package, model, base, now, Depth(depth), same=_is(data, base))
        save(key, found)
    return found


def _is(data: bytes, base: str | None) -> bool:
    return base is not None and is_text_of(data, base)


def _judged(
    package: ManagedPackage,
    model: str,
    base: str | None,
    now: PackageState,
    depth: Depth,
    *,
    same: bool,
) -> CachedVerdict:
    """`same` says that the model has not changed."""
    from rebsync.roundtrip.diff.compare import compare
    from rebsync.roundtrip.diff.equivalence import compare_with_code, told
    from rebsync.roundtrip.package.models import read_code, read_model

    today = read_model(model)
    code = read_code(package, now)
    before = today if same else read_model(f"{package.root}/{BASE_MODEL}") if base else None
    found = compare_with_code(today, code.given, before, partial(compare, depth=depth), depth)
    drift = judge(found.apart, found.of_model, found.of_code)
    return CachedVerdict(drift, found.of_code, (*code.findings, *told(found.written)))
