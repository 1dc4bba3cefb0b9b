"""The state of a package on the disk against its records, by digests: nothing is parsed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import operating_on, read_bytes
from rebsync.folder import LARGEST, Folder, content_of
from rebsync.records import dataclass
from rebsync.reverse.files.contents import contents
from rebsync.reverse.files.packages import Listing, is_read
from rebsync.reverse.files.python_files import may_be_script
from rebsync.reverse.files.stores import Disk, join
from rebsync.roundtrip.package.digests import digest_of, is_text_of
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE, BASE_MODEL
from rebsync.roundtrip.package.overriding_files import overriding_files
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.package.shared_runtime import is_shared, path_beside
from rebsync.roundtrip.package.units import both_at, listing_of

NOT_EXECUTABLE = "not executable: "  # before the digest of a generated program that has lost it


@dataclass(frozen=True, slots=True)
class PackageState:
    """How a package stands: the files that a model is read from, each with the digest it has.

    `changed` are those that are not as generated, or that were not generated, `missing` those that
    are no longer there. Line ends and byte order marks do not count.
    """

    listing: Listing
    digests: dict[str, str]
    changed: tuple[str, ...]
    missing: tuple[str, ...]

    @property
    def is_as_generated(self) -> bool:
        """Whether all code is what was generated."""
        return not (self.changed or self.missing or self.listing.odd)

    @property
    def told(self) -> tuple[str, ...]:
        """All that what the code says depends on, as texts."""
        files = (f"{name} {digest}" for name, digest in sorted(self.digests.items()))
        odd = (f"{name} {why}" for name, why in sorted(self.listing.odd.items()))
        return (*files, "odd", *odd)


def package_state(package: ManagedPackage, record: Record | None) -> PackageState:
    """How a package stands against what its manifest records; without one, all is changed."""
    wanted = record.files if record is not None else {}
    both = both_at(package.root) if record is None else None
    listing = both or listing_of(package.root, package.tree_of_code, wanted)
    if package.root == ".":  # as servers name the files of a change
        listing.files = {name: path.removeprefix("./") for name, path in listing.files.items()}
    shared = {name: path_beside(package.root, name) for name in wanted if is_shared(name)}
    listing.files |= {name: path for name, path in shared.items() if Path(path).is_file()}
    listing.odd |= overriding_files(listing, wanted)
    digests: dict[str, str] = {}
    changed = []
    for name, data in _contents(listing):
        if isinstance(data, str):
            digests[name] = f"unreadable: {data}"
            changed.append(name)
            continue
        digest = digest_of(data)
        if name in wanted and data.startswith(b"#!") and name not in listing.programs:
            digest = f"{NOT_EXECUTABLE}{digest}"
        digests[name] = digest
        known = wanted.get(name, "")
        is_as_known = digest == known or is_text_of(data, known)
        if not is_as_known or digest.startswith(NOT_EXECUTABLE):
            changed.append(name)
    lost = (name for name in wanted if name not in digests)
    missing = [name for name in lost if is_of_model(name) or _is_lost_marker(listing, name)]
    return PackageState(listing, digests, tuple(changed), tuple(missing))


def _contents(listing: Listing) -> Iterator[tuple[str, bytes | str]]:
    """The bytes of each file, or why it has none."""
    with operating_on(listing.root), contents(listing) as files:
        for name in listing.files:
            try:
                data: bytes | str = files.read(name)
            except OSError as error:
                data = str(error.strerror)
            except RebsyncError as error:
                data = error.findings[0].diagnostics[0].message
            yield name, data


def is_of_model(name: str) -> bool:
    """Whether a file that was generated is one that a model is read from."""
    parts = name.split("/")
    if any(part.startswith(".") for part in parts):
        return False
    inside = "".join(f"{part}/" for part in parts[:-1])
    return is_read(parts[-1], inside) or (inside.endswith("scripts/") and may_be_script(parts[-1]))


def _is_lost_marker(listing: Listing, name: str) -> bool:
    """Whether it is the empty file by which ROS finds a package of Python, and it is gone."""
    if name.rpartition("/")[0].rpartition("/")[2] != "resource":
        return False
    return not (listing.store or Disk()).exists(join(listing.root, name))


def is_base_whole(package: ManagedPackage, record: Record) -> bool:
    """Whether the model as of the last time that both were in step is as it was recorded."""
    try:
        return is_text_of(read_bytes(f"{package.root}/{BASE_MODEL}"), record.digest)
    except RebsyncError:
        return False


def edited_base(package: ManagedPackage, record: Record) -> list[str]:
    """The files of which the texts that were generated last time are kept, but no longer so."""
    found = []
    with operating_on(f"{package.root}/{BASE}"), Folder(package.root) as folder:
        for name, digest in record.files.items():
            with suppress(FileNotFoundError, NotADirectoryError):
                if not is_text_of(content_of(folder.open(BASE + name), LARGEST), digest):
                    found.append(name)
    return found
