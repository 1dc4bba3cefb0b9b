"""Exhaustive matching over closed unions (`typing.assert_never` begins with Python 3.11)."""

from __future__ import annotations

from typing import NoReturn


def assert_never(value: NoReturn) -> NoReturn:
    """The type checker proves that no call of this is reached."""
    raise AssertionError(f"unexpected {value!r}")
