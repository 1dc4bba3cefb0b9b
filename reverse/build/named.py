"""The files that the build files of a package name: without one it cannot be built."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from rebsync.records import dataclass
from rebsync.reverse.build.cmake import BUILD, build_of
from rebsync.reverse.build.manifests import name_in
from rebsync.reverse.files.python_files import SETUP
from rebsync.source import NOWHERE, Source, Span

_MANIFEST = "package.xml"
_MARKED = re.compile(r"""\bresource/""")


@dataclass(frozen=True, slots=True)
class Named:
    """A file that a build file names, and where; `path` is from the folder of the package."""

    path: str
    source: Source
    span: Span


def named(files: Mapping[str, Source]) -> Iterator[Named]:
    """The files that the build of a package names, whether they are there or not.

    `files` are those that were read, by their paths in the package.
    """
    yield from _by_cmake(files)
    yield from _by_setup(files)


def _by_cmake(files: Mapping[str, Source]) -> Iterator[Named]:
    """Sources of targets, interfaces and scripts."""
    build = build_of(files)
    if build is None:
        return
    for target in build.targets:
        yield from (Named(s, target.source, target.span) for s in target.sources)
    interfaces = (*build.messages, *build.services, *build.actions)
    for path in (*interfaces, *build.programs):
        found = re.search(rf"(?<![\w.]){re.escape(posixpath.basename(path))}", files[BUILD].text)
        span = Span(*found.span()) if found is not None else NOWHERE
        yield Named(path, files[BUILD], span)


def _by_setup(files: Mapping[str, Source]) -> Iterator[Named]:
    """The file by whose name a package of Python is found once it is installed."""
    if SETUP not in files or _MANIFEST not in files:
        return
    found, name = _MARKED.search(files[SETUP].text), name_in(files[_MANIFEST])
    if found is not None and name:
        yield Named(f"resource/{name}", files[SETUP], Span(*found.span()))
