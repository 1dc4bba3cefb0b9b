"""What stands before each source of C++ as the build compiles it: the macros that it sets."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from rebsync.reverse.build.build_files import BuildFiles
from rebsync.reverse.build.cmake import build_of
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.findings import Finding, Grade
from rebsync.source import Source

_HEADER = "<command-line>.h"
_CODE = tuple(sorted(CODE))
_HINT = "set it in the code, where it is read"


def compiled_with(files: Mapping[str, Source]) -> tuple[Source | None, list[Finding]]:
    """The macros that the build defines, as a header that all files see; and what is not known.

    A macro that is not defined in one way for all sources has no value that is known.
    """
    build = build_of(files)
    if build is None or not any(path.endswith(_CODE) for path in files):
        return None, []
    listed = [
        Finding(Grade.UNREADABLE, u.source, u.span, f"{u.what}: {u.why}", _HINT) for u in build.odd
    ]
    listed += _written(build, files)
    text = "".join(line for macro in build.macros for line in macro.directives)
    return (Source(_HEADER, text) if text else None), listed


def _written(build: BuildFiles, files: Mapping[str, Source]) -> Iterator[Finding]:
    """The headers that the build writes, and that stand in the package in another way as well."""
    names = {posixpath.basename(path) for path in files if path.endswith(_CODE)}
    for name, unknown in build.written.items():
        included = re.compile(rf'#[ \t]*include[ \t]*[<"](?:[^">]*/)?{re.escape(name)}[">]')
        if name in names and any(included.search(s.text) for s in files.values()):
            why = f"the build writes another {name}: which one is included is not known"
            yield Finding(Grade.UNREADABLE, unknown.source, unknown.span, why, _HINT)
