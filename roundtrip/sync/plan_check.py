"""Whether files that generation merges with edits by hand say what the model says."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.merge.models import whole
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE_MODEL
from rebsync.roundtrip.package.record import read_record
from rebsync.roundtrip.package.state import is_base_whole, package_state
from rebsync.roundtrip.sync.plan import Action, Step
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
    package = ManagedPackage(str(folder), tree_of(str(folder)), today.path)
    try:
        record = read_record(package.root)
        if not is_base_whole(package, record):
            return ()
        return tuple(_wrong(package, own, today))
    except RebsyncError:
        return ()


def _wrong(package: ManagedPackage, steps: list[Step], today: Source) -> Iterator[Findings]:
    from rebsync.roundtrip.diff.compare import compare
    from rebsync.roundtrip.merge.check import read_with, wrongly_merged
    from rebsync.roundtrip.package.models import parsed, read_code, read_model

    now = package_state(package, read_record(package.root))
    code = read_code(package, now).given
    before = compare(read_model(f"{package.root}/{BASE_MODEL}"), code)
    texts = {s.path: s.new for s in steps if s.action in _WRITTEN}
    model = SourcedModel(parsed(today), today)
    after = compare(model, read_with(now.listing, texts).given)
    changed = {whole(d.element) for d in before.differences}
    yield from wrongly_merged(after, changed, _WAY_OUT)
