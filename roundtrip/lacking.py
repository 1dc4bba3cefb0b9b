"""What a package that was generated needs and lacks, so that its nodes cannot be built or run."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.files import read_source
from rebsync.reverse.files.packages import CODE, MANIFEST
from rebsync.reverse.files.python_files import SETUP, SUFFIX
from rebsync.reverse.files.stores import Disk, join
from rebsync.roundtrip.digests import Standing
from rebsync.roundtrip.manifest import BASE
from rebsync.roundtrip.packages import Kept
from rebsync.roundtrip.recorded import Record
from rebsync.roundtrip.units import folders_of
from rebsync.source import NOWHERE, Source, Span

if TYPE_CHECKING:
    from rebsync.reverse.build.named import Named

BUILD = "CMakeLists.txt"
_READ = frozenset({BUILD, MANIFEST, SETUP})
_STATE = "State.msg"
_FIELD = re.compile(r"^[ \t]*[\w/\[\]]+[ \t]+(\w+)[ \t]*(?:#.*)?$", re.MULTILINE)
_CODE = (*sorted(CODE), SUFFIX)
_FOUND = re.compile(r"\bfind_package\s*\(([^)]*)\)")
_HASH = re.compile(r"#[^\n]*")
# By what code names a package, where that is not its own name.
_NAMED = {"roscpp": "ros"}
_OF_MESSAGES = re.compile(r"message_(?:generation|runtime)|rosidl_default_\w+")
_INTERFACES = (".msg", ".srv", ".action")
_HINT = "put it back, or take out by hand all that belongs to it"


def lacking(kept: Kept, record: Record, now: Standing) -> tuple[Findings, ...]:
    """What was generated and is gone while the build names it, or code uses it."""
    return (*_files(record, now), *_fields(kept, record, now), *_packages(kept, record, now))


def _files(record: Record, now: Standing) -> Iterator[Findings]:
    if not now.missing:
        return
    from rebsync.reverse.build.named import named

    listing = now.listing
    store = listing.store or Disk()
    for folder in folders_of(listing.files) or ("",):
        prefix = f"{folder}/" if folder else ""
        own = (n for n in listing.files if n.startswith(prefix))
        inside = {name.removeprefix(prefix): listing.files[name] for name in own}
        files = {name: _read(path, name) for name, path in inside.items()}
        for each in named(files):
            name = f"{prefix}{each.path}"
            path = join(listing.root, name)
            if each.path not in files and name in record.files and not store.exists(path):
                yield _gone(path, each)


def _gone(path: str, each: Named) -> Findings:
    by = f"{each.source.path}:{each.source.position(each.span.start).line}"
    found = Diagnostic("RS956", NOWHERE, f"this is gone, and {by} names it", _HINT)
    return Findings(Source(path, ""), (found,))


def _read(path: str, name: str) -> Source:
    """A build file; of others only the path matters."""
    if name.rpartition("/")[2] in _READ:
        with suppress(RebsyncError):  # what cannot be read, extraction lists
            return read_source(path)
    return Source(path, "")


def _fields(kept: Kept, record: Record, now: Standing) -> Iterator[Findings]:
    """The fields that messages of state lost and that code still sets."""
    files = now.listing.files
    for name in now.changed:
        if not name.endswith(_STATE) or name not in record.files or name not in files:
            continue
        with suppress(RebsyncError):
            before, source = read_source(f"{kept.root}/{BASE}{name}"), read_source(files[name])
            has = set(_FIELD.findall(source.text))
            lost = [f for f in _FIELD.findall(before.text) if f not in has]
            yield from (_lost(f, source) for f in lost if any(_sets(p, f) for p in files.values()))


def _sets(path: str, field: str) -> bool:
    if not path.endswith(_CODE):
        return False
    with suppress(RebsyncError):
        return re.search(rf"\bmsg\s*\.\s*{field}\b", read_source(path).text) is not None
    return False


def _lost(field: str, source: Source) -> Findings:
    last = len(source.text.rstrip())
    message = f"the field {field} is gone, and code sets it"
    return Findings(source, (Diagnostic("RS956", Span(max(last - 1, 0), last), message, _HINT),))


def _packages(kept: Kept, record: Record, now: Standing) -> Iterator[Findings]:
    """The packages that a build file no longer asks for, and that code still needs."""
    files = now.listing.files
    for name in now.changed:
        last = name.rpartition("/")[2]
        if last not in (BUILD, MANIFEST) or name not in record.files or name not in files:
            continue
        with suppress(RebsyncError):
            before, source = read_source(f"{kept.root}/{BASE}{name}"), read_source(files[name])
            asked = _asked_by_cmake if last == BUILD else _asked_by_manifest
            for package in sorted(asked(before) - asked(source)):
                if any(_needs(n, path, package) for n, path in files.items()):
                    message = f"this no longer asks for {package}, and code needs it"
                    found = Diagnostic("RS956", Span(0, 1), message, _HINT)
                    yield Findings(source, (found,))


def _asked_by_cmake(source: Source) -> set[str]:
    text = _HASH.sub("", source.text)
    return {word for m in _FOUND.finditer(text) for word in m[1].split() if not word.isupper()}


def _asked_by_manifest(source: Source) -> set[str]:
    from rebsync.reverse.build.manifests import read_manifest

    return set(read_manifest(source).depends)


def _needs(name: str, path: str, package: str) -> bool:
    """Whether a file imports, includes or is of what a package offers."""
    if _OF_MESSAGES.fullmatch(package):
        return name.endswith(_INTERFACES)
    if not name.endswith(_CODE):
        return False
    word = re.escape(_NAMED.get(package, package))
    with suppress(RebsyncError):
        text = read_source(path).text
        return (
            re.search(rf"(?:#\s*include\s*[<\"]|\bfrom\s+|\bimport\s+){word}\b", text) is not None
        )
    return False
