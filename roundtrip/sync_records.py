"""What a manifest says of code that people have edited, once it is in step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from rebsync.files import read_bytes
from rebsync.roundtrip.digests import Standing, digest_of, standing
from rebsync.roundtrip.manifest import FOLDER, MANIFEST
from rebsync.roundtrip.packages import Kept
from rebsync.roundtrip.recorded import Record, read_record, told_in_step, with_accepted
from rebsync.roundtrip.sync import Sync


def with_what_holds(sync: Sync, texts: Mapping[str, str]) -> dict[str, str | None]:
    """The records of a package whose files are going to be `texts`, by path.

    Servers that somebody has written by hand are joined otherwise than those that are generated;
    the model has them now, and the code is not to be told of as edited once more. And code that
    is wholly known to say what the model says is known again by its digest.
    """
    if sync.conflicts or MANIFEST not in sync.records:
        return sync.records
    if not _is_edited(sync, texts):
        return sync.records
    with _as_will_be(sync, texts) as kept:
        record = read_record(kept.root)
        now = standing(kept, record)
        accepted = _accepted(sync, kept, record, now)
        is_known = not (sync.findings or sync.is_undetermined)
        digest = told_in_step(record, now.told) if is_known else ""
    manifest = with_accepted(sync.records[MANIFEST] or "{}", accepted, digest)
    return {**sync.records, MANIFEST: manifest}


def _is_edited(sync: Sync, texts: Mapping[str, str]) -> bool:
    """Whether a file that a model is read from will not be as it is generated."""
    checked = sync.checked
    wanted = sync.records
    names = {*checked.standing.listing.files, *texts} - sync.texts.keys()
    for name in names | {n for n, t in sync.texts.items() if t is not None}:
        base = wanted.get(f"{FOLDER}/base/{name}")
        digest = digest_of(base.encode("utf-8")) if base is not None else ""
        if name in texts:
            own = digest_of(texts[name].encode("utf-8"))
        else:
            own = checked.standing.digests.get(name, "")
        if own != digest and not name.startswith(".."):
            return True
    return False


@contextmanager
def _as_will_be(sync: Sync, texts: Mapping[str, str]) -> Iterator[Kept]:
    """The package as it is going to be, in a directory for the time being."""
    files = {n: read_bytes(p) for n, p in sync.checked.standing.listing.files.items()}
    for changes in (sync.texts, sync.records):
        for name, text in changes.items():
            files.pop(name, None)
            if text is not None:
                files[name] = texts.get(name, text).encode("utf-8")
    with TemporaryDirectory(prefix="rebsync-") as folder:
        root = Path(folder, Path(sync.checked.kept.root).resolve().name)
        for name, data in files.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        yield Kept(str(root), folder, sync.checked.model)


def _accepted(sync: Sync, kept: Kept, record: Record, now: Standing) -> list[str]:
    """How nodes are joined otherwise than would be generated now, but for what is told anyway."""
    from rebsync.roundtrip.difference import Comparison
    from rebsync.roundtrip.wiring import odd_wiring

    odd = odd_wiring(kept, record, now, Comparison(()))
    told = {_subject(d.message) for f in sync.findings for d in f.diagnostics if d.code == "RS956"}
    messages = sorted({d.message for f in odd for d in f.diagnostics})
    return [message for message in messages if _subject(message) not in told]


def _subject(message: str) -> str:
    """What a message is about, whatever it is now."""
    return message.partition(" is ")[0]
