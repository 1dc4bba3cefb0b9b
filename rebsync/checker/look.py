"""Looks at the bounds, now and then, by what takes long."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

Look: TypeAlias = Callable[[], None]  # called now and then; raises Stopped


class Stopped(Exception):
    """A bound was reached; the text says which."""


def unwatched() -> None:
    """Looks at nothing: there are no bounds."""
