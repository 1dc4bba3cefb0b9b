"""New headers that are included in place of what generated code means by a name.

A quoted include looks beside the file that it is in first, and then, as all do, in `include`,
before the folders of other packages and of generated messages ([cpp.include], GCC's -I).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
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
    new = [n for n in now.changed if n not in record.files and _is_header(n)]
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
    of_others = tuple(f"{_FOLDER}{folder}/" for folder in others - own - {""})
    meant = _meant_by(paths)
    for header in new:
        name = beside.get(header, header.removeprefix(_FOLDER))
        is_unknown = header not in meant and name.partition("/")[0] not in own
        is_instead = name in names or is_unknown or bool(_OF_C.fullmatch(name))
        is_instead = header.startswith((*of_others, *([_FOLDER] if is_instead else ())))
        if header in paths and (is_instead or header in beside):
            message = f'this is included in place of what generated code means by "{name}"'
            yield finding(read_source(paths[header]), NOWHERE, message)


def _is_header(name: str) -> bool:
    """Whether a file may be included: in `include`, whatever its name ends with."""
    return suffix_of(name) in HEADERS or name.startswith(_FOLDER)


def _meant_by(paths: Mapping[str, str]) -> set[str]:
    """The headers that code of a package includes: of others it is not known who means them."""
    code = ((n, path) for n, path in paths.items() if suffix_of(n) in CODE)
    asked = {(dirname(n), name) for n, path in code for _, name in _includes(path)}
    return {normpath(join(f, name)) for of, name in asked for f in (of, _FOLDER)}


def _meant_by(paths: Mapping[str, str]) -> set[str]:
    """The headers that code of a package includes: of others it is not known who means them."""
    code = ((n, path) for n, path in paths.items() if suffix_of(n) in CODE)
    asked = {(dirname(n), name) for n, path in code for _, name in _includes(path)}
    return {normpath(join(f, name)) for of, name in asked for f in (of, _FOLDER)}


def _includes(path: str) -> list[tuple[str, str]]:
    with suppress(RebsyncError):
        return _INCLUDE.findall(read_source(path).text)
    return []
