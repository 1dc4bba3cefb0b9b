"""The three models of a package compared; kept in the user's cache as long as none has changed."""

from __future__ import annotations

from functools import partial

from rebsync.diagnostics import Findings
from rebsync.files import read_bytes
from rebsync.records import dataclass
from rebsync.roundtrip.difference import Comparison, Depth
from rebsync.roundtrip.digests import Standing, digest_of, is_text_of
from rebsync.roundtrip.extraction_cache import keep, kept, key_of
from rebsync.roundtrip.kept import Kept
from rebsync.roundtrip.manifest import BASE_MODEL
from rebsync.roundtrip.verdict import Drift, judge


@dataclass(frozen=True, slots=True)
class Judged:
    """The verdict, what the code has changed (None without a base), and what is not exact.

    Bodies that are written otherwise than the model's and do the same are among the findings.
    """

    drift: Drift
    of_code: Comparison | None
    findings: tuple[Findings, ...]


def judged(package: Kept, model: str, base: str | None, now: Standing, depth: str) -> Judged:
    """The verdict on a package; `base` is the digest of the model of last time, if that is there.

    RebsyncError: one of the models cannot be read.
    """
    data = read_bytes(model)
    told = (package.root, model, digest_of(data), base or "", depth, *now.told)
    key = key_of("judged", *told)
    found = kept(key, Judged)
    if found is None:
        found = _judged(package, model, base, now, Depth(depth), same=_is(data, base))
        keep(key, found)
    return found


def _is(data: bytes, base: str | None) -> bool:
    return base is not None and is_text_of(data, base)


def _judged(
    package: Kept, model: str, base: str | None, now: Standing, depth: Depth, *, same: bool
) -> Judged:
    """`same` says that the model has not changed."""
    from rebsync.roundtrip.differences import compare
    from rebsync.roundtrip.models import code_given, model_given
    from rebsync.roundtrip.rewritten import compared_with_code, told

    today = model_given(model)
    code = code_given(package, now)
    before = today if same else model_given(f"{package.root}/{BASE_MODEL}") if base else None
    found = compared_with_code(today, code.given, before, partial(compare, depth=depth), depth)
    drift = judge(found.apart, found.of_model, found.of_code)
    return Judged(drift, found.of_code, (*code.findings, *told(found.written)))
