"""How much of a text is read at all: its words and signs are counted before anything else."""

from __future__ import annotations

import re
from itertools import islice

from rebsync.diagnostics import Diagnostic
from rebsync.source import Span

MOST_PARTS = 250_000
_PART = re.compile(r'//[^\n]*|/\*.*?(?:\*/|\Z)|"[^"\n]*|\w+|\S', re.DOTALL)


def too_large(text: str) -> Diagnostic | None:
    """The mistake of a model or property file with more words and signs than are read, if it is.

    It takes milliseconds, where reading would take minutes and gigabytes.
    """
    if len(text) <= MOST_PARTS:
        return None
    last = next(islice(_PART.finditer(text), MOST_PARTS, None), None)
    if last is None:
        return None
    message = f"there are more than {MOST_PARTS:,} words and signs here, and no more are read"
    return Diagnostic("RS115", Span(*last.span()), message)
