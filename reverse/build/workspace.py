"""What a package takes from the packages beside it in a workspace: libraries, modules, messages.

A base class, a helper or a wrapper of publishers is often in another package. Those files of the
packages that it depends on are read with it that its own code reaches: headers by `#include`, the
sources of library targets that include one of these, modules of Python that are imported, and all
messages and launch files, with what these load. Programs of other packages are none of it. A path
of such a file is `~/NAME/path/in/package`, whatever folder the package is in.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field, replace
from functools import cache

from rebsync.diagnostics import RebsyncError
from rebsync.records import dataclass
from rebsync.reverse.build.cmake import build_of
from rebsync.reverse.build.manifests import read_manifest
from rebsync.reverse.files.contents import contents
from rebsync.reverse.files.packages import (
    BESIDE,
    CODE,
    HEADERS,
    MANIFEST,
    Listing,
    listings,
    suffix_of,
)
from rebsync.reverse.files.python_files import SETUP, SUFFIX, has_shebang, is_launch
from rebsync.reverse.libraries import cpp, python
from rebsync.source import Source

_INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"]', re.MULTILINE)
_IMPORT = re.compile(rb"^[ \t]*(?:from|import)[ \t]+([A-Za-z_]\w*)", re.MULTILINE)
_IS_PROGRAM = re.compile(rb"__main__|\bint\s+main\s*\(")
_TEXTS = (".msg", ".launch", ".launch.xml", ".yaml", ".yml")
_CMAKE = ("CMakeLists.txt", ".cmake")


def in_workspace(found: Iterable[Listing]) -> Iterator[Listing]:
    """Packages, each with what it takes from others: of those that are found, or beside it.

    RebsyncError: a directory may not be read.
    """
    workspace = _Workspace()
    each = list(found)
    for listing in each:
        workspace.add(listing)
    for listing in each:
        taken = workspace.taken_by(listing)
        yield replace(listing, files={**listing.files, **taken}) if taken else listing


@dataclass(slots=True)
class _Shared:
    """A package that others may depend on: what they may take of it, each file by its path in it.

    `sources` are those of library targets, none where it is not known what a target compiles.
    """

    name: str
    listing: Listing
    depends: tuple[str, ...]
    headers: dict[str, frozenset[bytes]] = field(default_factory=dict)
    sources: dict[str, frozenset[bytes]] = field(default_factory=dict)
    modules: dict[str, frozenset[bytes]] = field(default_factory=dict)
    texts: tuple[str, ...] = ()  # messages, launch files, and parameters
    is_read: bool = False

    def read(self) -> None:
        """Reads what is in its files."""
        if self.is_read:
            return
        self.is_read = True
        files = (n for n in self.listing.files if not {"test", "tests"} & set(n.split("/")))
        self.texts = tuple(n for n in files if n.endswith(_TEXTS) or is_launch(n))
        data = dict(_data(self.listing, self.listing.files))
        built = _built(self.listing, data)
        for name, text in data.items():
            suffix = suffix_of(name)
            if _is_wrapper(text):
                continue
            if suffix in HEADERS:
                self.headers[name] = frozenset(_INCLUDE.findall(text))
            elif name in built and not _IS_PROGRAM.search(text):
                self.sources[name] = frozenset(_INCLUDE.findall(text))
            elif suffix == SUFFIX and not _is_program(name, text):
                self.modules[name] = frozenset(_IMPORT.findall(text))


def _is_wrapper(text: bytes) -> bool:
    """Whether a file defines functions or classes that are called as those of client libraries are.

    Calls are read by such names, whatever is around them.
    """
    return any(pattern.search(text) is not None for pattern in _wrappers())


@cache
def _wrappers() -> tuple[re.Pattern[bytes], ...]:
    names = "|".join(sorted({*cpp.node_methods(), *cpp.handle_methods()})).encode()
    nodes = {name.rpartition("::")[2] for name in cpp.node_names()}
    classes = "|".join(sorted({*cpp.own_classes(), *cpp.handles(), *nodes})).encode()
    in_python = "|".join(sorted(python.asking_names())).encode()
    return (
        re.compile(rb"\b(?:" + names + rb")\s*\(\s*(?:const\b|\w+::)[\w:<> ]+[&*\s]\s*\w+"),
        re.compile(rb"\b(?:class|struct)\s+(?:" + classes + rb")\b"),
        re.compile(rb"\bdef\s+(?:" + in_python + rb")\s*\("),
    )


def _is_program(name: str, text: bytes) -> bool:
    is_run = has_shebang(text) or bool(_IS_PROGRAM.search(text))
    return is_run or name == SETUP or is_launch(name)


def _data(listing: Listing, names: Iterable[str]) -> Iterator[tuple[str, bytes]]:
    """The bytes of some files, of those that can be read and matter."""
    with contents(listing) as files:
        for name in names:
            if suffix_of(name) in CODE or name.endswith((SUFFIX, *_CMAKE, MANIFEST)):
                try:
                    yield name, files.read(name)
                except (OSError, RebsyncError):
                    continue


def _built(listing: Listing, data: Mapping[str, bytes]) -> frozenset[str]:
    """The sources of libraries, if it is known of all targets what they compile."""
    texts = {n: data[n].decode("utf-8", "replace") for n in data if n.endswith(_CMAKE)}
    files = {n: Source(path, texts.get(n, "")) for n, path in listing.files.items()}
    build = build_of(files)
    if build is None or build.unknowns or any(t.missing for t in build.targets):
        return frozenset()
    return frozenset(s for t in build.targets if not t.executable for s in t.sources)


@dataclass(slots=True)
class _Workspace:
    """The packages that were found, by their names; others are looked for beside who needs them."""

    packages: dict[str, _Shared | None] = field(default_factory=dict)
    by_root: dict[str, _Shared] = field(default_factory=dict)

    def add(self, listing: Listing) -> _Shared | None:
        """Takes a package into account; None where it has no manifest with a name."""
        manifest = dict(_data(listing, [MANIFEST] if MANIFEST in listing.files else []))
        if not listing.is_package or not manifest:
            return None
        text = manifest[MANIFEST].decode("utf-8", "replace")
        read = read_manifest(Source(listing.files[MANIFEST], text))
        if read.name is None or "/" in read.name:
            return None
        shared = _Shared(read.name, listing, read.depends)
        self.packages.setdefault(read.name, shared)
        self.by_root[listing.root] = shared
        return shared

    def taken_by(self, listing: Listing) -> dict[str, str]:
        """The files that a package takes from others, by their names in it."""
        own = self.by_root.get(listing.root)
        if own is None or listing.store is not None:
            return {}
        needs = list(self._needs(own))
        for each in needs:
            each.read()
        taken = {(each.name, name) for each in needs for name in each.texts}
        if any(each.headers or each.modules for each in needs):
            code = [data for _, data in _data(listing, listing.files)]
            taken |= set(_reached(code, needs))
        roots = {each.name: each.listing for each in needs}
        return {
            f"{BESIDE}{package}/{name}": roots[package].files[name]
            for package, name in sorted(taken)
        }

    def _needs(self, own: _Shared) -> Iterator[_Shared]:
        """The packages that one depends on, and those that they do."""
        seen, waiting = {own.name}, list(own.depends)
        while waiting:
            name = waiting.pop()
            if name in seen:
                continue
            seen.add(name)
            found = self._package(name, own.listing.root)
            if found is not None:
                yield found
                waiting += found.depends

    def _package(self, name: str, beside: str) -> _Shared | None:
        """A package of this name; if it was not found before, in the directory beside another."""
        if name not in self.packages:
            self.packages[name] = None
            folder = posixpath.join(posixpath.dirname(posixpath.abspath(beside)), name)
            if "/" not in name and posixpath.isfile(posixpath.join(folder, MANIFEST)):
                found = next(listings(folder), None)
                shared = self.add(found) if found is not None else None
                self.packages[name] = shared if shared is not None and shared.name == name else None
        return self.packages[name]


def _reached(code: Iterable[bytes], needs: Iterable[_Shared]) -> Iterator[tuple[str, str]]:
    """The files of packages that some code leads to, by includes and imports."""
    by_include: dict[bytes, list[tuple[_Shared, str]]] = {}
    by_import: dict[bytes, list[tuple[_Shared, str]]] = {}
    users: dict[bytes, list[tuple[_Shared, str]]] = {}
    for each in needs:
        for name in each.headers:
            for end in _ends(name):
                by_include.setdefault(end, []).append((each, name))
        for name, included in each.sources.items():
            for include in included:
                users.setdefault(include.rpartition(b"/")[2], []).append((each, name))
        for name in each.modules:
            for word in name.split("/")[:-1]:
                by_import.setdefault(word.encode(), []).append((each, name))
    seen: set[tuple[str, str]] = set()
    waiting: list[tuple[_Shared, str]] = []
    for data in code:
        waiting += (x for i in set(_INCLUDE.findall(data)) for x in by_include.get(i, ()))
        waiting += (x for i in set(_IMPORT.findall(data)) for x in by_import.get(i, ()))
    while waiting:
        package, name = waiting.pop()
        if (package.name, name) in seen:
            continue
        seen.add((package.name, name))
        yield package.name, name
        for include in package.headers.get(name, package.sources.get(name, frozenset())):
            waiting += by_include.get(include, ())
            waiting += (x for x in _beside(name, include, package))
        for imported in package.modules.get(name, ()):
            waiting += by_import.get(imported, ())
        if name in package.headers:
            near = users.get(posixpath.basename(name).encode(), ())
            waiting += (x for x in near if x[0] is package)


def _ends(name: str) -> Iterator[bytes]:
    """The texts by which an include may mean a header: its path from any of its folders."""
    parts = name.split("/")
    return ("/".join(parts[at:]).encode() for at in range(len(parts)))


def _beside(name: str, include: bytes, package: _Shared) -> Iterator[tuple[_Shared, str]]:
    """A header by its path from that of the file that includes it."""
    path = posixpath.normpath(
        posixpath.join(posixpath.dirname(name), include.decode("utf-8", "replace"))
    )
    if path in package.headers:
        yield package, path
