"""Merges the names that imports bring from one module, as sets."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import libcst as cst
from libcst import matchers as m


def merged_imports(ours: str, base: str, theirs: str) -> str | None:
    """The lines of one import: what either side brings, without what one of them has left out.

    The layout is that of the side that brings most. None: there are remarks in them, or no names.
    """
    if any("#" in text for text in (ours, base, theirs)):
        return None
    lines = [cst.parse_module(textwrap.dedent(text)) for text in (ours, base, theirs)]
    mine, old, new = (_names(line) for line in lines)
    wanted = _merged(list(mine), list(old), list(new))
    line = lines[0] if len(mine) >= len(new) else lines[2]
    found = m.findall(line, m.ImportFrom())
    if not wanted or len(found) != 1:
        return None
    names = _laid_out([(mine | new)[name] for name in wanted], _aliases(line))
    merged = line.deep_replace(found[0], found[0].with_changes(names=names))
    indent = ours[: len(ours) - len(ours.lstrip(" \t"))]
    return textwrap.indent(merged.code, indent) if isinstance(merged, cst.Module) else None


def _aliases(line: cst.Module) -> list[cst.ImportAlias]:
    found = m.findall(line, m.ImportAlias())
    return [each for each in found if isinstance(each, cst.ImportAlias)]


def _names(line: cst.Module) -> dict[str, cst.ImportAlias]:
    """What an import brings, by its text."""
    plain = (a.with_changes(comma=cst.MaybeSentinel.DEFAULT) for a in _aliases(line))
    return {line.code_for_node(alias): alias for alias in plain}


def _merged(ours: list[str], base: list[str], theirs: list[str]) -> list[str]:
    """What is left of ours, and what they add, each behind what it is behind there."""
    found = [n for n in ours if n in theirs or n not in base]
    for number, name in enumerate(theirs):
        if name not in ours and name not in base:
            before = [n for n in theirs[:number] if n in found]
            found.insert(found.index(before[-1]) + 1 if before else 0, name)
    return found


def _laid_out(
    names: Sequence[cst.ImportAlias], like: Sequence[cst.ImportAlias]
) -> list[cst.ImportAlias]:
    """Names with the commas of an import: between them those behind its first."""
    comma: cst.Comma | cst.MaybeSentinel = cst.Comma(whitespace_after=cst.SimpleWhitespace(" "))
    if len(like) > 1:
        comma = like[0].comma
    found = [name.with_changes(comma=comma) for name in names[:-1]]
    return [*found, names[-1].with_changes(comma=like[-1].comma)]
