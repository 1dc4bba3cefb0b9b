"""New headers that are included in place of what other code means by a name.

A quoted include looks beside the file that it is in first, and then, as all do, in `include`,
before the folders of other packages and of generated messages ([cpp.include], GCC's -I). Headers
of libraries find there what nothing in the package includes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from posixpath import dirname, join, normpath

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.files import read_source
from rebsync.reverse.files.packages import CODE, HEADERS, suffix_of
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.package.state import PackageState
from rebsync.roundtrip.verdict.missing_definitions import finding
from rebsync.source import NOWHERE

_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', re.MULTILINE)
_FOLDER = "include/"
# What headers of the C++ library include themselves.
_OF_C = re.compile(
    r"(?:assert|ctype|endian|errno|features|fenv|float|inttypes|limits|locale|math|pthread|sched|"
    r"setjmp|signal|std\w+|string|tgmath|time|uchar|unistd|wchar|wctype)\.h"
)


def included_instead(
    package: ManagedPackage, record: Record, now: PackageState
) -> Iterator[Findings]:
    """The headers that the files that were generated include in place of others."""
    paths = now.listing.files
    new = [n for n in now.changed if n not in record.files and suffix_of(n) in HEADERS]
    if not new:
        return
    beside: dict[str, str] = {}
    names: set[str] = set()
    for user in (n for n in record.files if suffix_of(n) in CODE):
        for quote, name in _includes(f"{package.root}/{BASE}{user}"):
            names.add(name)
            if quote == '"':
                beside[normpath(join(dirname(user), name))] = name
    others = {dirname(n) for n in names if f"{_FOLDER}{n}" not in record.files}
    own = {dirname(n) for n in names if f"{_FOLDER}{n}" in record.files}
    of_own = tuple(f"{folder}/" for folder in own - {""})
    of_others = tuple(f"{_FOLDER}{folder}/" for folder in others - own - {""})
    meant = {path for n, at in paths.items() if suffix_of(n) in CODE for path in _meant(n, at)}
    for header in new:
        name = beside.get(header, header.removeprefix(_FOLDER))
        is_of_libraries = bool(_OF_C.fullmatch(name)) or header not in meant
        is_own = name not in names and (name.startswith(of_own) or not is_of_libraries)
        is_instead = header.startswith(_FOLDER) and not is_own
        if header in paths and (is_instead or header in beside or header.startswith(of_others)):
            message = f'this is included in place of what other code means by "{name}"'
            yield finding(read_source(paths[header]), NOWHERE, message)


def _meant(name: str, path: str) -> Iterator[str]:
    """The headers that a file of the package may include."""
    for _, header in _includes(path):
        yield from (f"{_FOLDER}{header}", normpath(join(dirname(name), header)))


def _includes(path: str) -> list[tuple[str, str]]:
    with suppress(RebsyncError):
        return _INCLUDE.findall(read_source(path).text)
    return []
