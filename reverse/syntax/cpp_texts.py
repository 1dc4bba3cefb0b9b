"""What stands between the quotes of characters and texts of C++ ([lex.ccon], [lex.string])."""

from __future__ import annotations

import re

_SIMPLE = {
    **{"n": 10, "t": 9, "r": 13, "a": 7, "b": 8, "f": 12, "v": 11, "e": 27},  # `\e` is GNU's
    **{"\\": 92, "'": 39, '"': 34, "?": 63},
}
_ESCAPE = re.compile(r"\\(x[0-9a-fA-F]+|u[0-9a-fA-F]{4}|U[0-9a-fA-F]{8}|[0-7]{1,3}|.)", re.DOTALL)
_ASCII = 128


def unescaped(text: str) -> str | None:
    """What escapes in a text stand for; None for one that is not known.

    A byte by its number that is not ASCII is a part of a character: it has none of its own.
    """
    try:
        return _ESCAPE.sub(_escape, text.replace("\\\n", ""))
    except (KeyError, ValueError):
        return None


def _escape(match: re.Match[str]) -> str:
    inner = match[1]
    if inner[0] in "uU" and len(inner) > 1:
        return chr(int(inner[1:], 16))
    if inner[0] in "x01234567":
        code = int(inner[1:], 16) if inner[0] == "x" else int(inner, 8)
        if code >= _ASCII:
            raise ValueError(inner)
        return chr(code)
    return chr(_SIMPLE[inner])
