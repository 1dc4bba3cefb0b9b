"""Users' own blocks in generated code, which no model describes, by their markers."""

from __future__ import annotations

import re
from functools import lru_cache

from rebsync.source import Span

_MARKER = re.compile(r"^[ \t]*(?://|#)[ \t]*rebsync:[ \t]*(user[ \t]+\S+|end\b)", re.MULTILINE)


@lru_cache(maxsize=8)
def user_blocks(text: str) -> tuple[Span, ...]:
    """What stands between `rebsync: user NAME` and `rebsync: end`."""
    found, start = [], None
    for marker in _MARKER.finditer(text):
        if marker[1] != "end":
            start = marker.end()
        elif start is not None:
            found.append(Span(start, marker.start()))
            start = None
    return tuple(found)
