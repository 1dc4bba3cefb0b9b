"""The facts that join generated nodes: topics, remaps, fields of messages, programs.

They are read from each file alone, whatever the model says.
"""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Mapping
from contextlib import suppress
from functools import lru_cache
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import BOM, read_bytes, read_source
from rebsync.reverse.files.compiled_text import compiled_text
from rebsync.reverse.files.python_files import is_python
from rebsync.reverse.launch.xml_tree import text_below
from rebsync.reverse.scaffold.build_file import facts_of_build
from rebsync.reverse.scaffold.cpp import facts_in_cpp
from rebsync.reverse.scaffold.fact import PARAMETERS, Fact, Facts
from rebsync.reverse.scaffold.launch_python import facts_of_python_launch
from rebsync.reverse.scaffold.launch_xml import facts_of_launch, facts_of_settings
from rebsync.reverse.scaffold.others import Load, facts_of_others, is_launch
from rebsync.reverse.scaffold.settings import (
    facts_of_message,
    facts_of_other_package,
    facts_of_parameters,
    facts_of_setup,
)
from rebsync.source import Source


def package_name(path: str) -> str:
    """The name of a package by its `package.xml`; empty where that does not tell."""
    with suppress(RebsyncError):
        return (text_below(read_source(path), "name") or "").strip()
    return ""


def facts_of(paths: Mapping[str, str], package: str = "") -> Facts:
    """The facts in files of a package of that name, by their keys; `paths` are by names inside."""
    found: Facts = {}
    launches: list[Source] = []

    def load(path: str) -> Source | None:
        path = posixpath.normpath(path)
        inside = path.removeprefix("/")
        # of two packages that are one output, each is in a folder of its own
        found = (p for n, p in paths.items() if p == path or f"/{n}".endswith(f"/{inside}"))
        at = next(found, None)
        with suppress(RebsyncError):
            return Source(at, _text(read_bytes(at))) if at is not None else None
        return None

    for name, path in sorted(paths.items()):
        with suppress(RebsyncError):  # what cannot be read, extraction lists
            source = Source(path, compiled_text(name, _text(read_bytes(path))))
            for fact in _told(name, source, package, _beside(name, paths)):
                found.setdefault(fact.key, []).append(fact)
            launches += [source] if is_launch(name) else []
            for fact in _with_others(name, source, package, load):
                found.setdefault(fact.key, []).append(fact)
    for fact in facts_of_others(launches, load, package):
        found.setdefault(fact.key, []).append(fact)
    return found


def _with_others(name: str, source: Source, package: str, load: Load) -> Iterable[Fact]:
    """The facts of a launch file together with the files that it loads and includes."""
    if name.endswith(".launch"):
        return facts_of_settings(source, load)
    is_python = name.endswith(".launch.py")
    return facts_of_python_launch(source, package, load) if is_python else ()


@lru_cache(maxsize=256)  # most texts are there as they were and as they are, and asked for again
def _told(name: str, source: Source, package: str, beside: tuple[str, ...]) -> tuple[Fact, ...]:
    return tuple(_of_file(name, source, package, beside))


def _beside(name: str, paths: Iterable[str]) -> tuple[str, ...]:
    """The files in the folder of a `setup.py`, which may look for them; none for other files."""
    folder, _, last = name.rpartition("/")
    if last != "setup.py":
        return ()
    inside = f"{folder}/" if folder else ""
    return tuple(sorted(p.removeprefix(inside) for p in paths if p.startswith(inside)))


def _text(data: bytes) -> str:
    """The text of a file; an odd byte, which extraction lists, changes only what it is in."""
    return data.removeprefix(BOM).decode("utf-8", "replace").replace("\r\n", "\n")


def _of_file(name: str, source: Source, package: str, beside: tuple[str, ...]) -> Iterable[Fact]:
    match name.rpartition("/")[2]:
        case last if last.endswith((".msg", ".srv", ".action")):
            return facts_of_message(source, package)
        case last if last.endswith(".yaml"):
            return facts_of_parameters(source) if name.endswith(PARAMETERS) else ()
        case last if last.endswith("package.xml"):
            return facts_of_other_package(source, package)
        case last if last.endswith((".xml", ".yml")):
            return ()  # what launch files load and include counts as they do
        case last if last.endswith(".cfg"):
            return facts_of_setup(source)
        case last if last.endswith(".txt"):
            return facts_of_build(source, package)
        case last if last.endswith(".launch.py"):
            return ()  # what it says depends on other files
        case last if last.endswith(".launch"):
            return facts_of_launch(source, package)
        case _ if is_python(name, source):
            from rebsync.reverse.scaffold.python import facts_in_python

            return facts_in_python(name, source, package, beside)
        case last:
            return facts_in_cpp(Path(last).stem, source)
