"""Texts of code and launch files as facts have them: without layout, and from tags around them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

_LAYOUT = re.compile(r" ?([^\w \"]) ?")


def joined(found: re.Match[str]) -> str:
    """A name or literal in one piece; what follows it keeps its place."""
    whole = found[0]
    parts = re.split(r"\s*::\s*", whole) if whole[0] != '"' else re.split(r'"\s*"', whole)
    return ("::" if whole[0] != '"' else "").join(parts).ljust(len(whole))


def squeezed(text: str) -> str:
    """A text without layout."""
    return _LAYOUT.sub(r"\1", " ".join(text.split()))


def space(tags: Sequence[Mapping[str, str]]) -> str:
    """The namespace that tags of a launch file around something make together."""
    return "/".join(filter(None, (tag.get("ns") for tag in tags)))


def conditions(tags: Sequence[Mapping[str, str]]) -> str:
    """What of `if` and `unless` of these tags an argument or the machine decides."""
    told = ((key, tag.get(key, "")) for tag in tags for key in ("if", "unless"))
    return " and ".join(f"{key} {value}" for key, value in told if "$(" in value)


def is_of_package(said: str, package: str) -> bool:
    """Whether what is said of a file is of the package itself, where extraction reads it."""
    beside = ("$(dirname)", "ThisLaunchFileDir", "__file__")
    if f"$(find {package})" in said or any(word in said for word in beside):
        return True
    # formatters choose the quotes and the lines
    return re.search(rf"""\(\s*(["']){re.escape(package)}\1\s*,?\s*\)""", said) is not None
