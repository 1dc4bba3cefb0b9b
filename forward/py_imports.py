"""What a module of Python imports: the names that its text uses, and no others."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

_NOT_CODE = re.compile(r'#[^\n]*|"(?:\\.|[^"\\\n])*"')
_WORD = re.compile(r"(?<![\w.])(?<!def )[^\W\d]\w*")


def words_of(lines: Iterable[str]) -> set[str]:
    """The names that code uses, attributes apart."""
    return set(_WORD.findall(_NOT_CODE.sub("", "\n".join(lines))))


def imports(
    used: Iterable[str], modules: Mapping[str, Iterable[str]], indent: str = ""
) -> list[str]:
    """The statements that import what is used of the modules, in the order of these."""
    lines: list[str] = []
    for module, names in modules.items():
        found = sorted(set(names).intersection(used), key=_order)
        if found:
            lines.append(f"{indent}from {module} import {', '.join(found)}")
    return lines


def _order(name: str) -> tuple[int, list[tuple[int, str]]]:
    """Constants, classes, functions, numbers in them by their value: as ruff sorts them."""
    kind = 0 if name.isupper() and len(name) > 1 else 1 if name[0].isupper() else 2
    parts = re.split(r"(\d+)", name)
    return kind, [(int(p), "") if p.isdigit() else (-1, p.lower()) for p in parts]
