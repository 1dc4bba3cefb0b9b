"""Which files of a package its build makes programs of: what no target compiles is no code of it.

A copy of a source in a folder of its own, or beside the source under another name, says nothing of
what the robot does. Where it is not known all that the build compiles, everything counts.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Mapping
from fnmatch import fnmatchcase

from rebsync.records import dataclass
from rebsync.reverse.build.built_python import unbuilt_python
from rebsync.reverse.build.cmake import read_build
from rebsync.reverse.build.cmake_targets import Folder
from rebsync.reverse.files.packages import CODE, HEADERS
from rebsync.source import Source

BUILD = "CMakeLists.txt"
_HEADERS = tuple(sorted(HEADERS))
_SOURCES = tuple(sorted(CODE - HEADERS))
_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:<([^>\n]*)>|"([^"\n]*)"|(\w+))', re.M)
_DEFINED = re.compile(r"\b(\w+)\s*::\s*(~?\w+)\s*\(")
_LAUNCHES = (".launch", ".launch.py", ".launch.xml", ".launch.yaml")
_CLASS = re.compile(r"\b(?:class|struct)\s+(?:[A-Z_]+\s+)?(\w+)[^;{()]*\{")


@dataclass(frozen=True, slots=True)
class Unbuilt:
    """The files of code that the build of a package is known to leave out, by their paths in it.

    Of these `needed` define what classes of the package lack otherwise, or are programs that a
    launch file starts: what they say is meant, and nobody knows what the robot does.
    """

    left: frozenset[str]
    needed: frozenset[str] = frozenset()


def unbuilt(files: Mapping[str, Source]) -> Unbuilt:
    """What the build leaves out; `files` are those of a package that were read, by their paths."""
    of_cpp = _unbuilt_cpp(files)
    return Unbuilt(of_cpp.left | unbuilt_python(files), of_cpp.needed)


# --- C++ ----------------------------------------------------------------------------------------


def _unbuilt_cpp(files: Mapping[str, Source]) -> Unbuilt:
    """Sources of no target, and headers that say anew what one says that a target includes."""
    compiled = _compiled(files)
    reached, waiting = set(compiled), list(compiled)
    while waiting:
        included = _included(waiting.pop(), files)
        if included is None:
            return Unbuilt(frozenset())
        fresh = included - reached
        reached |= fresh
        waiting += fresh
    if not compiled:
        return Unbuilt(frozenset())
    declared = {name for p in reached for name in _CLASS.findall(files[p].text)}
    others = [p for p in files if p not in reached]
    headers = (p for p in others if p.endswith(_HEADERS))
    again = (p for p in headers if not declared.isdisjoint(_CLASS.findall(files[p].text)))
    sources = frozenset(p for p in others if p.endswith(_SOURCES))
    needed = frozenset(p for p in sources if _is_needed(p, files, reached, declared))
    return Unbuilt(sources.union(again), needed)


def _is_needed(
    path: str, files: Mapping[str, Source], reached: Collection[str], declared: Collection[str]
) -> bool:
    """Whether a source that is not built defines what is nowhere else, or a launch file runs it."""
    has = {found for p in reached for found in _DEFINED.findall(files[p].text)}
    own = {d for d in _DEFINED.findall(files[path].text) if d[0] in declared}
    if not own <= has:
        return True
    stem = _stem(path)
    if stem in map(_stem, reached):
        return False
    launches = (s.text for p, s in files.items() if p.endswith(_LAUNCHES))
    return any(re.search(rf"\b{re.escape(stem)}\b", text) for text in launches)


def _stem(path: str) -> str:
    return posixpath.splitext(posixpath.basename(path))[0]


def _compiled(files: Mapping[str, Source]) -> frozenset[str]:
    """The sources that targets compile; empty where these are not all known."""
    if BUILD not in files:
        return frozenset()
    build = read_build(files[BUILD], Folder(files.get, lambda pattern: glob(files, pattern)))
    if not build.is_closed:
        return frozenset()
    return frozenset(s for t in build.targets for s in t.sources if s in files)


def glob(files: Mapping[str, Source], pattern: str) -> list[str]:
    """The files that a pattern of CMake finds; `**/` stands for any folders, or none."""
    folder, deep, last = pattern.partition("**/")
    if not deep:
        folder, last = posixpath.split(pattern)
        return [p for p in files if posixpath.dirname(p) == folder and _fits(p, last)]
    return [p for p in files if p.startswith(folder) and _fits(p, last)]


def _fits(path: str, last: str) -> bool:
    return fnmatchcase(posixpath.basename(path), last)


def _included(path: str, files: Mapping[str, Source]) -> set[str] | None:
    """The files of a package that a file includes; None where a macro says which."""
    found = set[str]()
    for match in _INCLUDE.finditer(files[path].text):
        if match[3]:
            return None
        name = posixpath.normpath(match[1] or match[2])
        beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
        if match[2] and beside in files:
            found.add(beside)
        else:
            found |= {p for p in files if p == name or p.endswith(f"/{name}")}
    return found
