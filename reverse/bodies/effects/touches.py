"""What code does to the model, raised where its effects are looked for."""

from __future__ import annotations

from rebsync.reverse.findings import Unread


class Touches(Unread):
    """What a piece of code does to the model.

    `at` are the bytes that do it, if they do whatever stands for the names of other locals. `texts`
    are the variables of texts that it changes, by their names in the model.
    """

    at: tuple[int, int] | None = None
    texts: frozenset[str] = frozenset()
