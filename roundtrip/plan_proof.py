"""Whether files that generation merges with edits by hand say what the model says."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.roundtrip.digests import is_base_whole, standing
from rebsync.roundtrip.kept import Kept
from rebsync.roundtrip.manifest import BASE_MODEL
from rebsync.roundtrip.merge_models import whole
from rebsync.roundtrip.plan import Action, Step
from rebsync.roundtrip.recorded import read_record
from rebsync.roundtrip.sides import Given
from rebsync.source import Source
from rebsync.trees import tree_of

_WAY_OUT = "--force keeps edited files as FILE.orig"
_EDITED = (Action.KEEP, Action.MERGE)
_WRITTEN = (Action.CREATE, Action.UPDATE, Action.MERGE, Action.DELETE)


def wrong_in(folder: Path, steps: tuple[Step, ...], today: Source) -> tuple[Findings, ...]:
    """The elements that the files would not have as the model has them, once `steps` are taken.

    What somebody has changed in the code before, and the model has not, stays as it is in the
    code: of that `rebsync check` tells. Without the records of last time that is not known, and
    nothing is told here.
    """
    own = [s for s in steps if not s.path.startswith(".rebsync/")]
    is_mixed = any(s.action in _EDITED for s in own) and any(s.action in _WRITTEN for s in own)
    if not is_mixed:
        return ()
    kept = Kept(str(folder), tree_of(str(folder)), today.path)
    try:
        record = read_record(kept.root)
        if not is_base_whole(kept, record):
            return ()
        return tuple(_wrong(kept, own, today))
    except RebsyncError:
        return ()


def _wrong(kept: Kept, steps: list[Step], today: Source) -> Iterator[Findings]:
    from rebsync.roundtrip.differences import compare
    from rebsync.roundtrip.merge_check import read_with, wrongly_merged
    from rebsync.roundtrip.models import code_given, model_given, parsed

    now = standing(kept, read_record(kept.root))
    code = code_given(kept, now).given
    before = compare(model_given(f"{kept.root}/{BASE_MODEL}"), code)
    texts = {s.path: s.new for s in steps if s.action in _WRITTEN}
    model = Given(parsed(today), today)
    after = compare(model, read_with(now.listing, texts).given)
    changed = {whole(d.element) for d in before.differences}
    yield from wrongly_merged(after, changed, _WAY_OUT)
