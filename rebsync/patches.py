"""Changes of texts as unified diffs that `git apply` and `patch` read."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import unified_diff

_ODD = re.compile(
    r'[\x00-\x1f"\\\x7f-\x9f\u200b-\u200f\u2028-\u202e\u2060-\u206f\ud800-\udfff\ufeff]'
)
_SHORT = {"\t": r"\t", "\n": r"\n", "\r": r"\r", '"': r"\"", "\\": r"\\"}


def patch(old: str, new: str, before: str, after: str) -> str:
    """The change of one text; `before` and `after` are the names that the patch has for it."""
    return "".join(_lines(old, new, before, after))


def _lines(old: str, new: str, before: str, after: str) -> Iterator[str]:
    for line in unified_diff(_split(old), _split(new), quoted(before), quoted(after)):
        yield line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


def _split(text: str) -> list[str]:
    """Lines that end in LF; others than that end no line of a patch."""
    lines = text.split("\n")
    return [f"{line}\n" for line in lines[:-1]] + lines[-1:] * bool(lines[-1])


def quoted(name: str) -> str:
    """The name of a file as git writes it: quoted where it holds what is not printed."""
    if not _ODD.search(name):
        return name
    return f'"{_ODD.sub(_octal, name)}"'


def _octal(match: re.Match[str]) -> str:
    data = match[0].encode("utf-8", "surrogateescape")
    return _SHORT.get(match[0]) or "".join(f"\\{byte:03o}" for byte in data)
