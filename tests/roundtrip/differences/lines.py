"""Differences as lines, as the expected ones of cases have them."""

from __future__ import annotations

from rebsync.roundtrip.diff.difference import Difference, explain


def line_of(difference: Difference) -> str:
    """The whole difference on one line, with both places; `-` where there is none."""
    left, right = (str(p) if p is not None else "-" for p in (difference.left, difference.right))
    return f"{left} {right} {difference.element}: {explain(difference)}"
