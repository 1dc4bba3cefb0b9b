"""Components of ROS 2: classes that a container, or a program that CMake makes, runs as nodes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from rebsync.reverse.build.cmake import BUILD
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.source import Source

_COMMENT = re.compile(r"#[^\n]*")
_PROJECT = re.compile(r"\bproject\s*\(\s*(\w+)")


def components(code: Code) -> list[str]:
    """The classes that are registered as components, in the order of the files."""
    macros = libraries.registering()
    words = frozenset(macro.encode() for macro in macros)
    texts = (cpp.source.text for cpp in code.files if words & cpp.words)
    macro = re.compile(rf"^[ \t]*(?:{'|'.join(macros)})\s*\(\s*([\w:]+)\s*\)", re.MULTILINE)
    names = (m[1].rpartition("::")[2] for text in texts for m in macro.finditer(text))
    return [name for name in dict.fromkeys(names) if name in code.classes]


def executables(files: Mapping[str, Source]) -> dict[str, frozenset[str]]:
    """By class the programs that run it alone, and the names by which containers load it."""
    found: dict[str, set[str]] = {}
    for plugin, program in _registered(files[BUILD].text if BUILD in files else ""):
        names = found.setdefault(plugin.rpartition("::")[2], set())
        names.update(n for n in (plugin, program) if n)
    return {class_: frozenset(names) for class_, names in found.items()}


def _registered(text: str) -> Iterator[tuple[str, str]]:
    """The components that a build file registers, each with its program, if it has one."""
    plain = _COMMENT.sub("", text)
    project = _PROJECT.search(plain)
    if project is not None:
        plain = plain.replace("${PROJECT_NAME}", project[1])
    commands = "|".join(libraries.registering_in_builds())
    for call in re.finditer(rf"\b(?:{commands})\s*\(([^()]*)\)", plain):
        words = [w.strip('"') for w in call[1].split()]
        given = dict(zip(words[1::2], words[2::2], strict=False))
        if "PLUGIN" in given:
            yield given["PLUGIN"], given.get("EXECUTABLE", "")
        else:
            yield from ((word, "") for word in words[1:])
