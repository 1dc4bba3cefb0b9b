"""Which files of a package its build makes programs of: what no target compiles is no code of it.

A copy of a source in a folder of its own, or beside the source under another name, says nothing of
what the robot does. Where it is not known all that the build compiles, everything counts.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Container, Iterable, Iterator, Mapping, Sequence

from rebsync.records import dataclass
from rebsync.reverse.build.built_python import unbuilt_python
from rebsync.reverse.build.cmake import build_of
from rebsync.reverse.files.packages import BESIDE, CODE, HEADERS
from rebsync.reverse.files.python_files import is_launch
from rebsync.source import Source

_HEADERS = tuple(sorted(HEADERS))
_SOURCES = tuple(sorted(CODE - HEADERS))
_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:<([^>\n]*)>|"([^"\n]*)"|(\w+))', re.M)
_DEFINED = re.compile(r"\b(\w+)\s*::\s*(~?\w+)\s*\(")
_WORD = re.compile(r"\w+")
_CLASS = re.compile(r"\b(?:class|struct)\s+(?:[A-Z_]+\s+)?(\w+)[^;{()]*\{")


@dataclass(frozen=True, slots=True)
class Unbuilt:
    """The files of code that the build of a package is known to leave out, by their paths in it.

    Of these `needed` define what classes of the package lack otherwise, or are programs that a
    launch file starts: what they say is meant, and nobody knows what the robot does. Others are of
    `tests`, of which the build makes programs too.
    """

    left: frozenset[str]
    needed: frozenset[str] = frozenset()
    tests: frozenset[str] = frozenset()


_NOTHING = Unbuilt(frozenset())


def unbuilt(files: Mapping[str, Source]) -> Unbuilt:
    """What the build leaves out; `files` are those of a package that were read, by their paths."""
    of_cpp = _unbuilt_cpp(files)
    return Unbuilt(of_cpp.left | unbuilt_python(files), of_cpp.needed, of_cpp.tests)


# --- C++ ----------------------------------------------------------------------------------------


def _unbuilt_cpp(files: Mapping[str, Source]) -> Unbuilt:
    """Sources of no target, and headers that say anew what one says that a target includes."""
    build = build_of(files)
    if build is None or not build.is_closed:
        return _NOTHING
    compiled = {s for t in build.targets for s in t.sources if s in files}
    reached = _reached(compiled, files)
    if not reached:
        return _NOTHING
    reached |= {path for path in files if path.startswith(BESIDE)}
    others = [p for p in files if p not in reached and p.endswith((*_SOURCES, *_HEADERS))]
    if not others:
        return _NOTHING
    declared = {name for p in reached for name in _CLASS.findall(files[p].text)}
    headers = (p for p in others if p.endswith(_HEADERS))
    again = (p for p in headers if not declared.isdisjoint(_CLASS.findall(files[p].text)))
    sources = frozenset(p for p in others if p.endswith(_SOURCES))
    needed = frozenset(_needed(sources, files, reached, declared))
    return Unbuilt(sources.union(again), needed, build.tests & sources - needed)


def _needed(
    sources: Iterable[str],
    files: Mapping[str, Source],
    reached: Collection[str],
    declared: Collection[str],
) -> Iterator[str]:
    """Those of the sources that define what is nowhere else, or that a launch file runs."""
    has = {found for p in reached for found in _DEFINED.findall(files[p].text)}
    started = {word for p in files if is_launch(p) for word in _WORD.findall(files[p].text)}
    started -= set(map(_stem, reached))
    for path in sources:
        own = {d for d in _DEFINED.findall(files[path].text) if d[0] in declared}
        if not own <= has or _stem(path) in started:
            yield path


def _stem(path: str) -> str:
    return posixpath.splitext(posixpath.basename(path))[0]


def _reached(compiled: Iterable[str], files: Mapping[str, Source]) -> set[str]:
    """Sources, and all that they include of a package; nothing where a macro says what."""
    by_name: dict[str, list[str]] = {}
    for path in files:
        by_name.setdefault(posixpath.basename(path), []).append(path)
    reached = set(compiled)
    waiting = list(reached)
    while waiting:
        path = waiting.pop()
        for match in _INCLUDE.finditer(files[path].text):
            if match[3]:
                return set()
            fresh = set(_included(path, match, files, by_name)) - reached
            reached |= fresh
            waiting += fresh
    return reached


def _included(
    path: str, match: re.Match[str], files: Container[str], by_name: Mapping[str, Sequence[str]]
) -> Sequence[str]:
    """The files that an include in a file may mean."""
    name = posixpath.normpath(match[1] or match[2])
    beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
    if match[2] and beside in files:
        return [beside]
    near = by_name.get(posixpath.basename(name), ())
    return [p for p in near if p == name or p.endswith(f"/{name}")]
