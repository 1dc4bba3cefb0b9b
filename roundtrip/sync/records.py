"""What a manifest says of code that people have edited, once it is in step."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.files import BOM, read_bytes
from rebsync.folder import Folder
from rebsync.roundtrip.package.digests import digest_of
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE, MANIFEST
from rebsync.roundtrip.package.record import Record, read_record, told_in_step, with_accepted
from rebsync.roundtrip.package.shared_runtime import is_shared, path_beside
from rebsync.roundtrip.package.state import PackageState, package_state
from rebsync.source import Source
from rebsync.terminal import encoded

if TYPE_CHECKING:
    from rebsync.roundtrip.sync.result import Sync
    from rebsync.roundtrip.verdict.wiring.facts import Odd

_NAME = re.compile(r"\w+")
_LISTS = ("mailbox/rebecs", "mailbox/instances")


def with_what_holds(sync: Sync) -> Sync:
    """The same with what holds of the package when all is written.

    Servers that somebody has written by hand are joined otherwise than those that are generated;
    the model has them now, and the code is not to be told of as edited once more. What is edited
    and in no model is told only if it is not what is generated now. And code that is wholly known
    to say what the model says is known again by its digest.
    """
    if sync.conflicts or sync.refused or MANIFEST not in sync.records:
        return sync
    told = [f for f in sync.findings if _is_odd(f)]
    findings = tuple(f for f in sync.findings if not _is_odd(f))
    if not _is_edited(sync):
        return replace(sync, findings=findings)
    with _as_will_be(sync) as package:
        record = read_record(package.root)
        now = package_state(package, record)
        accepted, known, left = _odd(package, record, now, {_subject(f) for f in told})
    root = sync.checked.package.root
    findings += tuple(_in(root, package.root, f) for f in (*left, *known))
    is_known = not (findings or sync.is_undetermined)
    before = sync.checked.record.in_step if sync.checked.record is not None else ""
    digest = told_in_step(record, now.told) if is_known else before
    manifest = with_accepted(sync.records[MANIFEST] or "{}", accepted, digest)
    records = {**sync.records, MANIFEST: manifest}
    unknown = sync.is_undetermined or bool(left)
    return replace(
        sync,
        findings=findings,
        records=records,
        is_undetermined=unknown,
        is_joined_otherwise=bool(known),
    )


def marked(root: str, name: str, text: str) -> str:
    """A text with the byte order mark that its file has."""
    with suppress(OSError), Folder(root) as folder:
        if folder.read(name).startswith(BOM):
            return BOM.decode("utf-8") + text
    return text


def _is_odd(found: Findings) -> bool:
    return all(d.code == "RS956" for d in found.diagnostics)


def _is_edited(sync: Sync) -> bool:
    """Whether a file that a model is read from will not be as it is generated."""
    now = sync.checked.state
    digests = {name: digest for name, digest in now.digests.items() if name not in sync.texts}
    root = sync.checked.package.root
    for name, text in sync.texts.items():
        if text is not None:
            digests[name] = digest_of(encoded(marked(root, name, text)))
    if any(sync.texts.get(name) is None for name in now.missing):
        return True
    wanted = {n: digest_of(encoded(t)) for n, t in sync.records.items() if t is not None}
    return any(wanted.get(BASE + name) != digest for name, digest in digests.items())


@contextmanager
def _as_will_be(sync: Sync) -> Iterator[ManagedPackage]:
    """The package as it is going to be, in a directory for the time being."""
    own = Path(sync.checked.package.root)
    listing = sync.checked.state.listing
    listed = listing.files.items()
    files = {name: read_bytes(path) for name, path in listed if name not in listing.odd}
    generated = sync.checked.record.files if sync.checked.record is not None else {}
    for name in generated.keys() - files.keys():
        with suppress(RebsyncError):  # what nothing is read from may be gone
            files[name] = read_bytes(str(own / name))
    for changes in (sync.texts, sync.records):
        for name, text in changes.items():
            files.pop(name, None)
            if text is not None:
                files[name] = encoded(marked(str(own), name, text))
    with TemporaryDirectory(prefix="rebsync-") as folder:
        root = Path(folder, own.resolve().name)
        for name, data in files.items():
            path = Path(path_beside(str(root), name)) if is_shared(name) else root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
            if name in listing.programs or name not in listing.files:
                path.chmod(0o755)
        yield ManagedPackage(str(root), folder, sync.checked.model)


def _odd(
    package: ManagedPackage, record: Record, now: PackageState, told: set[str]
) -> tuple[list[str], list[Findings], list[Findings]]:
    """How nodes are joined that is to be accepted, and what is left to tell of edits.

    The latter are those that are known to differ from the model, and those of which that cannot be
    said. `told` is what was told of before; to go on from there is not to accept it. A list of
    rebecs must name those of a class of which it names others.
    """
    from rebsync.roundtrip.diff.difference import Comparison
    from rebsync.roundtrip.verdict.missing_files import missing_files
    from rebsync.roundtrip.verdict.runtime import edited
    from rebsync.roundtrip.verdict.wiring.facts import odd_facts

    accepted, known = set[str](), list[Findings]()
    left = [*edited(package, record, now), *missing_files(package, record, now)]
    for odd in odd_facts(package, record, now, Comparison(())):
        is_accepted = odd.finding.diagnostics[0].message in record.accepted
        if _subject(odd.finding) in told or (not is_accepted and _is_needed(odd, package, now)):
            (known if odd.is_known else left).append(odd.finding)
        else:
            accepted.add(odd.finding.diagnostics[0].message)
    if accepted:  # which keeps no lost message from being told
        by_then = replace(record, accepted=frozenset(accepted))
        for odd in odd_facts(package, by_then, now, Comparison(())):
            is_seen = odd.finding in (*left, *known)
            if odd.is_lost or _subject(odd.finding) in told:
                left += [] if is_seen else [odd.finding]
            elif not is_seen:  # what is joined by what the model no longer sends
                accepted.add(odd.finding.diagnostics[0].message)
    return sorted(accepted), known, left


def _is_needed(odd: Odd, package: ManagedPackage, now: PackageState) -> bool:
    """Whether messages are lost, or nodes wait for others, or choose, by a list that lacks one."""
    facts = *odd.before, *odd.now
    if not facts:
        return True  # somebody sends what nobody takes in, or what others take in
    if not facts[0].name.startswith(_LISTS):
        return False
    from rebsync.roundtrip.package.models import read_code

    main = read_code(package, now).given.model.main
    classes = {r.name: r.type.name for r in main.rebecs} if main is not None else {}
    wanted, listed = (
        {n for f in facts for n in _NAME.findall(f.value)} for facts in (odd.before, odd.now)
    )
    of_listed = {classes[name] for name in listed & classes.keys()}
    return any(classes[name] in of_listed for name in (wanted - listed) & classes.keys())


def _subject(found: Findings) -> str:
    """What a message is about, whatever it is now."""
    return found.diagnostics[0].message.partition(" is ")[0]


def _in(root: str, other: str, found: Findings) -> Findings:
    """A finding in another directory."""
    path = found.source.path
    if path.startswith(f"{other}/"):
        path = f"{root}{path.removeprefix(other)}"
    else:
        path = path_beside(root, path.removeprefix(f"{Path(other).parent}/"))
    return Findings(Source(path, found.source.text), found.diagnostics)
