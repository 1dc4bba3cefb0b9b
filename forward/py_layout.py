"""Lines of Python that do not grow too long, laid out as ruff does."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

LINE_LENGTH = 100
INDENT = "    "


def call_lines(head: str, arguments: Sequence[str], tail: str = ")", indent: str = "") -> list[str]:
    """`head(a, b)`, in several lines where one is too long; `head` ends with its bracket."""
    whole = f"{indent}{head}{', '.join(arguments)}{tail}"
    if len(whole) <= LINE_LENGTH or not arguments:
        return [whole]
    inner = f"{indent}{INDENT}{', '.join(arguments)}"
    if len(inner) <= LINE_LENGTH:
        return [f"{indent}{head}", inner, f"{indent}{tail}"]
    own = [f"{indent}{INDENT}{a}," for a in arguments]
    return [f"{indent}{head}", *own, f"{indent}{tail}"]


def indented(lines: Iterable[str]) -> list[str]:
    """The lines, those with text moved to the right."""
    return [INDENT + line if line else line for line in lines]
