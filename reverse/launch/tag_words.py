"""Texts in launch files of ROS 2 in XML and YAML: `$(var x)`, `$(find-pkg-share x)`, and others."""

from __future__ import annotations

import re

from rebsync.reverse.launch.ros2_words import (
    Computed,
    Environment,
    Here,
    LaunchVariable,
    Share,
    Word,
    Words,
    Worked,
)
from rebsync.reverse.launch.ros2_worked import WORDS
from rebsync.source import Span

_NAME = re.compile(r"\s*([\w-]+)\s*")
_DEEPEST = 30
_ESCAPED = re.compile(r"\\(['\"\\])")


def tag_words(text: str, span: Span) -> Words:
    """A text with each `$(...)` as what it stands for."""
    parts, _ = _parts(text, 0, span, 0)
    return Words(tuple(parts), span)


def _parts(text: str, at: int, span: Span, depth: int) -> tuple[list[Word], int]:
    """The parts up to the end, or to the parenthesis that closes what is around it."""
    found: list[Word] = []
    start = at
    while at < len(text):
        if text.startswith("$(", at) and depth < _DEEPEST:
            found.append(text[start:at])
            word, at = _substitution(text, at + 2, span, depth + 1)
            found.append(word)
            start = at
        elif text[at] == ")" and depth:
            break
        else:
            at += 1
    found.append(text[start:at])
    return [p for p in found if p != ""], at


def _substitution(text: str, at: int, span: Span, depth: int) -> tuple[Word, int]:
    """What stands between `$(` and `)`, and where it ends."""
    name = _NAME.match(text, at)
    begin = name.end() if name is not None else at
    inner, end = _parts(text, begin, span, depth)
    if end >= len(text):
        return Computed("a substitution that is not closed"), len(text)
    return _word(name[1] if name is not None else "", inner, span), end + 1


def _word(name: str, inner: list[Word], span: Span) -> Word:
    arguments = _split(inner, span)
    first = arguments[0] if arguments else None
    match name:
        case "var" if first is not None:
            return LaunchVariable(first)
        case "env" | "optenv" if first is not None:
            default = arguments[1] if len(arguments) > 1 else None
            return Environment(first, default)
        case "find-pkg-share" if first is not None:
            return Share(first)
        case "dirname":
            return Here(True)
        case "filename":
            return Here(False)
        case "eval":
            return Worked(name, (Words(tuple(_unquoted(inner)), span),))
        case _ if name in WORDS and arguments:
            return Worked(name, tuple(arguments))
        case _:
            return Computed(f"`$({name} ...)` is worked out when the file runs")


def _unquoted(inner: list[Word]) -> list[Word]:
    """An expression without the quotes around it, those within as they are meant."""
    first, last = (inner[0], inner[-1]) if inner else ("", "")
    if not isinstance(first, str) or not isinstance(last, str):
        return inner
    quote = first.lstrip()[:1]
    if quote not in ("'", '"') or not last.rstrip().endswith(quote):
        return inner
    parts = [*inner]
    parts[0] = first.lstrip()[1:]
    end = parts[-1]
    parts[-1] = end.rstrip()[:-1] if isinstance(end, str) else end
    return [_ESCAPED.sub(r"\1", p) if isinstance(p, str) else p for p in parts]


def _split(inner: list[Word], span: Span) -> list[Words]:
    """The arguments of a substitution: at blanks, but not within quotes or other substitutions."""
    found: list[list[Word]] = [[]]
    for part in inner:
        if not isinstance(part, str):
            found[-1].append(part)
            continue
        pieces = re.split(r"\s+", part)
        for number, piece in enumerate(pieces):
            if number:
                found.append([])
            if piece:
                found[-1].append(piece.strip("'\""))
    return [Words(tuple(parts), span) for parts in found if parts]
