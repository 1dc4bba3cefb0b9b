"""Lines of C++ that do not grow too long."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

LINE_LENGTH = 100
CONTINUATION = "    "


def call_lines(head: str, arguments: Sequence[str], tail: str, indent: str = "") -> list[str]:
    """`head(a, b)tail`, broken behind commas where one line is too long."""
    whole = f"{indent}{head}({', '.join(arguments)}){tail}"
    if len(whole) <= LINE_LENGTH:
        return [whole]
    lines = [f"{indent}{head}("]
    for i, argument in enumerate(arguments):
        piece = argument + (", " if i < len(arguments) - 1 else f"){tail}")
        if len(lines[-1]) + len(piece.rstrip()) > LINE_LENGTH and not lines[-1].endswith("("):
            lines[-1] = lines[-1].rstrip()
            lines.append(indent + CONTINUATION)
        lines[-1] += piece
    return lines


def statement_lines(head: str, arguments: Sequence[str], tail: str) -> list[str]:
    """The same for a statement of a body, which will stand further to the right."""
    return [line[2:] for line in call_lines(head, arguments, tail, "  ")]


def with_trailing_comments(lines: Iterable[tuple[str, str]]) -> list[str]:
    """Each line with its comment, the comments in one column."""
    pairs = list(lines)
    width = max((len(code) for code, comment in pairs if comment), default=0)
    return [f"{code:<{width}}  // {comment}" if comment else code for code, comment in pairs]


def indented(lines: Iterable[str], by: str = "  ") -> list[str]:
    """The lines, those with text moved to the right."""
    return [by + line if line else line for line in lines]
