"""The layout of generated Python: that of `ruff format` and `black` with the package's settings.

Whoever formats a package that was generated shall find nothing to change. The writers give each
statement in one line; lines are broken here alone, by `black`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache

LINE_LENGTH = 100
INDENT = "    "

_MARKED = re.compile(r"( *)(\S.*?)  (# rebsync: .*)")
# What the writers do not lay out: lines that are too long, and parentheses around what needs none.
_ASKS = re.compile(rf"^.{{{LINE_LENGTH + 1},}}$|(?:= |return |if |while )\(", re.MULTILINE)


def indented(lines: Iterable[str]) -> list[str]:
    """The lines, those with text moved to the right."""
    return [INDENT + line if line else line for line in lines]


def formatted(files: Mapping[str, str]) -> dict[str, str]:
    """The files of a package by path, those of Python in their layout."""
    return {p: _formatted(t) if _is_python(p, t) else t for p, t in files.items()}


def _is_python(path: str, text: str) -> bool:
    return path.endswith(".py") or text.startswith("#!/usr/bin/env python")


@lru_cache(maxsize=1024)  # a sync writes most files of a package more than once
def _formatted(text: str) -> str:
    if not _ASKS.search(text):
        return text
    from black import format_str
    from black.mode import Mode, TargetVersion

    mode = Mode(target_versions={TargetVersion.PY38}, line_length=LINE_LENGTH)
    return format_str("\n".join(_above(text.split("\n"))), mode=mode)


def _above(lines: Iterable[str]) -> Iterator[str]:
    """The lines; a marker that makes one too long stands above it."""
    for line in lines:
        marked = _MARKED.fullmatch(line) if len(line) > LINE_LENGTH else None
        if marked is not None:
            yield f"{marked[1]}{marked[3]}"
            yield f"{marked[1]}{marked[2]}"
        else:
            yield line
