"""Which packages are in a directory: their files by name, nothing of them read yet."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from dataclasses import field, replace
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import operating_on, os_mistake
from rebsync.records import dataclass
from rebsync.reverse.files.python_files import SUFFIX, is_script, may_be_script
from rebsync.reverse.files.stores import Disk, Entry, Store, join
from rebsync.trees import is_within, tree_of_code

MANIFEST = "package.xml"
BESIDE = (
    "~/"  # how the path of a file begins that another package of the workspace has: after all own
)
HEADERS = frozenset({".h", ".hh", ".hpp", ".hxx", ".cuh", ".ipp", ".tpp", ".inl", ".H"})
CODE = HEADERS | {".c", ".cc", ".cpp", ".cxx", ".c++", ".C", ".cu"}
_EXECUTABLE = 0o111
_OTHERS = frozenset(
    {".launch", ".msg", ".srv", ".action", ".yaml", ".yml", ".xml", ".cmake", ".in"}
)
_NAMED = frozenset({"CMakeLists.txt", "rebsync.toml", "setup.cfg"})
IGNORING = frozenset({"CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"})
# What a build leaves in a directory of its own: by this it is told from code of the same name.
_BUILT = frozenset({"CMakeCache.txt", ".catkin", "_setup_util.py", "local_setup.sh", ".built_by"})
_BUILDS = frozenset({"build", "devel", "install", "log"})
_TESTS = frozenset({"test", "tests"})
_DISK = Disk()
LEADS_OUT = "a link that leads out of the tree"


@dataclass(slots=True)
class Listing:
    """The files of a package, or of a directory that is none, by their paths in it.

    `only` is the file that is asked for, if it is one; `odd` are the files that cannot be read,
    each with the reason; `size` is that of all code in bytes. Paths have slashes, and are text
    whatever the bytes of the names. `linked` are the real paths of what is behind links, in the
    directory `tree`; `store` is where the files are, if not on the disk; `programs` are the files
    that may be executed.
    """

    root: str
    files: dict[str, str]
    only: str | None = None
    odd: dict[str, str] = field(default_factory=dict)
    is_package: bool = True
    size: int = 0
    linked: dict[str, str] = field(default_factory=dict)
    tree: str = ""
    store: Store | None = None
    programs: set[str] = field(default_factory=set)


def listings(path: str, within: str | None = None, store: Store | None = None) -> Iterator[Listing]:
    """The packages in a directory, one at a time; or a file with the package around it.

    A file belongs to the nearest package above it. Files outside of all packages come first, as
    one listing. What links lead to outside of the directory `within`, or else of the tree that a
    package is in, is not read but listed as odd; without `within`, a link to a package is that
    package. RebsyncError: there is no such path, or it may not be read.
    """
    files = store or _DISK
    with operating_on(path):
        if not files.is_folder(path):
            yield _around(path, store)
            return
    walk = _Walk(path, store, os.path.realpath(within) if within is not None else None)
    waiting = [path]
    while waiting:
        listing, inner = walk.package(waiting.pop())
        waiting += reversed(inner)
        if listing.files or listing.odd:
            yield listing


def _around(path: str, store: Store | None) -> Listing:
    """A file together with the package that it is in, if it is in one."""
    if store is not None:
        return _around_in(store, path)
    here = Path(path) if ".." not in Path(path).parts else Path(path).resolve()
    root = next((d for d in _above(here) if _DISK.exists(f"{d}/{MANIFEST}")), None)
    if root is None:
        return Listing(str(here.parent), {here.name: path}, here.name, is_package=False)
    inside = here.absolute().relative_to(root.absolute()).as_posix()
    listing, _ = _Walk(str(here.parent)).package(str(root))
    return replace(listing, files={**listing.files, inside: path}, only=inside)


def _around_in(store: Store, path: str) -> Listing:
    """The same of a file that is not on the disk."""
    root, found = path, False
    while "/" in root and not found:
        root = root.rpartition("/")[0]
        found = store.exists(f"{root}/{MANIFEST}")
    if not found:
        root = f"{path.partition(':')[0]}:"
        found = store.exists(f"{root}{MANIFEST}")
    inside = path.removeprefix(root).lstrip("/")
    if not found:
        return Listing(root, {inside: path}, inside, is_package=False, store=store)
    listing, _ = _Walk(root, store).package(root)
    return replace(listing, files={**listing.files, inside: path}, only=inside)


def _above(file: Path) -> Iterator[Path]:
    """The directories above a file: as it was named, then up to the root."""
    yield from file.parents
    yield from file.absolute().parents


@dataclass(slots=True)
class _Walk:
    """Goes through directories, into each once, whatever links there are.

    What links lead to outside of the real directory `within` is left out; where that is not given,
    outside of the tree of the package that is gone through, or of the directory `named`.
    """

    named: str
    store: Store | None = None
    within: str | None = None
    seen: set[object] = field(default_factory=set)

    @property
    def files(self) -> Store:
        return self.store or _DISK

    def package(self, root: str) -> tuple[Listing, list[str]]:
        """The files under a directory but for those of packages within, and these packages."""
        is_package = self._has_manifest(root)
        tree = self.within or ("" if self.store is not None else tree_of_code(root, self.named))
        listing = Listing(root, {}, is_package=is_package, tree=tree, store=self.store)
        inner: list[str] = []
        waiting = [(root, "", "")]
        while waiting:
            folder, inside, real = waiting.pop()
            folders = []
            for entry in self._entries(listing, folder, inside):
                where = f"{real}/{entry.name}" if real else ""
                if entry.is_symlink():
                    where = os.path.realpath(entry.path)
                    if self._is_left_out(listing, entry, where, inside):
                        continue
                if _is_folder(entry):
                    folders.append((entry, where))
                else:
                    _add(listing, entry, inside, where, self.files)
            for entry, where in reversed(folders):
                if self._has_manifest(entry.path):
                    inner.append(entry.path)
                elif not self._is_built(entry):
                    waiting.append((entry.path, f"{inside}{shown(entry.name)}/", where))
        return listing, sorted(inner)

    def _entries(self, listing: Listing, folder: str, inside: str) -> list[Entry]:
        """What is in a directory that was not seen before, in an order that is always the same."""
        try:
            found = self.files.identity(folder)
            if found in self.seen:
                return []
            self.seen.add(found)
            every = sorted(self.files.entries(folder), key=lambda e: e.name)
        except OSError as error:
            if not inside:
                raise os_mistake(folder, error) from None
            listing.odd[inside] = _reason(folder, error)
            return []
        if inside and any(e.name in IGNORING for e in every):
            return []
        return [e for e in every if not e.name.startswith(".") and e.name != "node_modules"]

    def _is_left_out(self, listing: Listing, entry: Entry, real: str, inside: str) -> bool:
        """Whether a link is not followed; it is listed as odd if there may be code behind it."""
        if self.store is None:
            if is_within(real, listing.tree):
                return False
            if self.within is None and _is_folder(entry) and self._has_manifest(entry.path):
                return False
        if self.store is not None or _is_folder(entry) or is_read(entry.name, inside):
            listing.odd[inside + shown(entry.name)] = LEADS_OUT
        return True

    def _has_manifest(self, folder: str) -> bool:
        return self.files.exists(join(folder, MANIFEST))

    def _is_built(self, entry: Entry) -> bool:
        """Whether a directory holds what a build made."""
        if entry.name not in _BUILDS:
            return False
        return any(self.files.exists(f"{entry.path}/{name}") for name in _BUILT)


def is_read(name: str, inside: str) -> bool:
    """Whether a file of this name in a directory (with a slash after it) is read at all."""
    suffix = suffix_of(name)
    if suffix in CODE or suffix == SUFFIX:
        return True
    return (suffix in _OTHERS or name in _NAMED) and not _TESTS & set(inside.split("/"))


def owner_of(path: str, package: str) -> str:
    """The name of the package that a file is of, by its path among those of a package.

    Of another one it is `~/NAME/path`, whatever directory that is in.
    """
    return path.split("/", 2)[1] if path.startswith(BESIDE) else package


def suffix_of(path: str) -> str:
    """As that of a `Path`: making one for each of many thousand files takes long."""
    name = path.rpartition("/")[2]
    at = name.rfind(".")
    return name[at:] if at > 0 and name != "." * len(name) else ""


def _add(listing: Listing, entry: Entry, inside: str, real: str, files: Store) -> None:
    """Puts a file among those to read, or those that cannot be; `real` is its path if linked."""
    if not is_read(entry.name, inside) and not _is_script(entry, real, files):
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
        if found.st_mode & _EXECUTABLE or os.name == "nt":  # there, no file has the bits
            listing.programs.add(name)
        listing.size += found.st_size if suffix in CODE or suffix == SUFFIX else 0
        if real:
            listing.linked[name] = real
    else:
        listing.odd[name] = "this is no regular file"


def _is_script(entry: Entry, real: str, files: Store) -> bool:
    """Whether a file without a suffix says in its first line that Python runs it.

    A link to a file that has one is another name for it.
    """
    if not may_be_script(entry.name) or real.endswith(SUFFIX):
        return False
    try:
        if not stat.S_ISREG(entry.stat().st_mode):
            return False
        return is_script(files.head(real or entry.path))
    except (OSError, RebsyncError):
        return False  # nothing says that it is code


def _is_folder(entry: Entry) -> bool:
    try:
        return entry.is_dir()
    except OSError:
        return False  # then reading it says why


def shown(path: str) -> str:
    """A path as text that can be printed, bytes that are no UTF-8 as `\\xff`."""
    return path.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def _reason(path: str, error: OSError) -> str:
    """Why a file cannot be read, as the user is told."""
    mistake: RebsyncError = os_mistake(path, error)
    return mistake.findings[0].diagnostics[0].message
