"""Which packages are in a directory: their files by name, nothing of them read yet."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from dataclasses import field
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import operating_on, os_mistake
from rebsync.records import dataclass
from rebsync.reverse.files.python_files import SUFFIX, is_script, may_be_script

MANIFEST = "package.xml"
HEADERS = frozenset({".h", ".hh", ".hpp", ".hxx", ".cuh", ".ipp", ".tpp", ".inl", ".H"})
CODE = HEADERS | {".c", ".cc", ".cpp", ".cxx", ".c++", ".C", ".cu"}
_OTHERS = frozenset({".launch", ".msg", ".srv", ".action", ".yaml", ".yml", ".xml"})
_NAMED = frozenset({"CMakeLists.txt", "rebsync.toml", "setup.cfg"})
_IGNORING = frozenset({"CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"})
# What a build leaves in a directory of its own: by this it is told from code of the same name.
_BUILT = frozenset({"CMakeCache.txt", ".catkin", "_setup_util.py", "local_setup.sh", ".built_by"})
_BUILDS = frozenset({"build", "devel", "install", "log"})
_TESTS = frozenset({"test", "tests"})
LEADS_OUT = "a link that leads out of the tree"


@dataclass(slots=True)
class Listing:
    """The files of a package, or of a directory that is none, by their paths in it.

    `only` is the file that is asked for, if it is one; `odd` are the files that cannot be read,
    each with the reason; `size` is that of all code in bytes. Paths have slashes, and are text
    whatever the bytes of the names.
    """

    root: str
    files: dict[str, str]
    only: str | None = None
    odd: dict[str, str] = field(default_factory=dict)
    is_package: bool = True
    size: int = 0


def listings(path: str, within: str | None = None) -> Iterator[Listing]:
    """The packages in a directory, one at a time; or a file with the package around it.

    A file belongs to the nearest package above it. Files outside of all packages come first, as
    one listing. What links lead to outside of the directory `within` is not read but listed as
    odd. RebsyncError: there is no such path, or it may not be read.
    """
    with operating_on(path):
        if not stat.S_ISDIR(Path(path).stat().st_mode):
            yield _around(path)
            return
    walk = _Walk(os.path.realpath(within) if within is not None else None)
    waiting = [path]
    while waiting:
        listing, inner = walk.package(waiting.pop())
        waiting += reversed(inner)
        if listing.files or listing.odd:
            yield listing


def _around(path: str) -> Listing:
    """A file together with the package that it is in, if it is in one."""
    here = Path(path) if ".." not in Path(path).parts else Path(path).resolve()
    root = next((d for d in _above(here) if _has_manifest(str(d))), None)
    if root is None:
        return Listing(str(here.parent), {here.name: path}, here.name, is_package=False)
    inside = here.absolute().relative_to(root.absolute()).as_posix()
    listing, _ = _Walk().package(str(root))
    return Listing(listing.root, {**listing.files, inside: path}, inside, listing.odd)


def _above(file: Path) -> Iterator[Path]:
    """The directories above a file: as it was named, then up to the root."""
    yield from file.parents
    yield from file.absolute().parents


@dataclass(slots=True)
class _Walk:
    """Goes through directories, into each once, whatever links there are.

    What links lead to outside of the directory `within` is left out, if there is one.
    """

    within: str | None = None
    seen: set[tuple[int, int]] = field(default_factory=set)

    def package(self, root: str) -> tuple[Listing, list[str]]:
        """The files under a directory but for those of packages within, and these packages."""
        listing = Listing(root, {}, is_package=_has_manifest(root))
        inner: list[str] = []
        waiting = [(root, "")]
        while waiting:
            folder, inside = waiting.pop()
            folders = []
            for entry in self._entries(listing, folder, inside):
                if self._leads_out(entry):
                    if _is_folder(entry) or is_read(entry.name, inside):
                        listing.odd[inside + shown(entry.name)] = LEADS_OUT
                elif _is_folder(entry):
                    folders.append(entry)
                else:
                    _add(listing, entry, inside)
            for entry in reversed(folders):
                if _has_manifest(entry.path):
                    inner.append(entry.path)
                elif not _is_built(entry):
                    waiting.append((entry.path, f"{inside}{shown(entry.name)}/"))
        return listing, sorted(inner)

    def _entries(self, listing: Listing, folder: str, inside: str) -> list[os.DirEntry[str]]:
        """What is in a directory that was not seen before, in an order that is always the same."""
        try:
            found = os.stat(folder)  # noqa: PTH116
            if (found.st_dev, found.st_ino) in self.seen:
                return []
            self.seen.add((found.st_dev, found.st_ino))
            with os.scandir(folder) as entries:
                every = sorted(entries, key=lambda e: e.name)
        except OSError as error:
            if not inside:
                raise os_mistake(folder, error) from None
            listing.odd[inside] = _reason(folder, error)
            return []
        if inside and any(e.name in _IGNORING for e in every):
            return []
        return [e for e in every if not e.name.startswith(".") and e.name != "node_modules"]

    def _leads_out(self, entry: os.DirEntry[str]) -> bool:
        if self.within is None or not entry.is_symlink():
            return False
        real = os.path.realpath(entry.path)
        return real != self.within and not real.startswith(self.within.rstrip(os.sep) + os.sep)


def is_read(name: str, inside: str) -> bool:
    """Whether a file of this name in a directory (with a slash after it) is read at all."""
    suffix = suffix_of(name)
    if suffix in CODE or suffix == SUFFIX:
        return True
    return (suffix in _OTHERS or name in _NAMED) and not _TESTS & set(inside.split("/"))


def suffix_of(path: str) -> str:
    """As that of a `Path`: making one for each of many thousand files takes long."""
    name = path.rpartition("/")[2]
    at = name.rfind(".")
    return name[at:] if at > 0 and name != "." * len(name) else ""


def _add(listing: Listing, entry: os.DirEntry[str], inside: str) -> None:
    """Puts a file among those to read, or those that cannot be."""
    if not is_read(entry.name, inside) and not _is_script(entry):
        return
    suffix = suffix_of(entry.name)
    name = inside + shown(entry.name)
    try:
        found = entry.stat()
    except OSError as error:
        listing.odd[name] = _reason(entry.path, error)
        return
    if stat.S_ISREG(found.st_mode):
        listing.files[name] = entry.path
        listing.size += found.st_size if suffix in CODE or suffix == SUFFIX else 0
    else:
        listing.odd[name] = "this is no regular file"


def _is_script(entry: os.DirEntry[str]) -> bool:
    """Whether a file without a suffix says in its first line that Python runs it.

    A link to a file that has one is another name for it.
    """
    if not may_be_script(entry.name):
        return False
    try:
        if entry.is_symlink() and os.path.realpath(entry.path).endswith(SUFFIX):
            return False
        if not stat.S_ISREG(entry.stat().st_mode):
            return False
        with Path(entry.path).open("rb") as file:
            return is_script(file.read(80))
    except OSError:
        return False  # nothing says that it is code


def _is_built(entry: os.DirEntry[str]) -> bool:
    """Whether a directory holds what a build made."""
    if entry.name not in _BUILDS:
        return False
    return any(_exists(f"{entry.path}/{name}") for name in _BUILT)


def _has_manifest(folder: str) -> bool:
    return _exists(f"{folder}/{MANIFEST}")


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir()
    except OSError:
        return False  # then reading it says why


def _exists(path: str) -> bool:
    return os.path.exists(path)  # noqa: PTH110 - a path object for each of many costs more


def shown(path: str) -> str:
    """A path as text that can be printed, bytes that are no UTF-8 as `\\xff`."""
    return path.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def _reason(path: str, error: OSError) -> str:
    """Why a file cannot be read, as the user is told."""
    mistake: RebsyncError = os_mistake(path, error)
    return mistake.findings[0].diagnostics[0].message
